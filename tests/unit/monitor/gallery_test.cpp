/// The pictures for browsers: who wishes gets what is new, once.

#include "monitor/web/gallery.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <future>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fsi::monitor {
namespace {

constexpr std::chrono::milliseconds at_once{0};
constexpr std::chrono::minutes long_time{5};

wire::Picture picture(const std::string& role, const std::string& quantity, std::uint64_t step = 1) {
  wire::Picture result;
  result.from = role == "solid" ? "beam" : role;
  result.role = role;
  result.quantity = quantity;
  result.step = step;
  result.grids = {{.name = "g", .n1 = 3, .n2 = 1, .straight = true, .x = {1, 2, 3, 4}, .level = {5, 6, 7}}};
  return result;
}

/// Headers of the pictures, as a browser takes them apart.
std::vector<nlohmann::json> headers(const std::string& bytes) {
  std::vector<nlohmann::json> all;
  for (std::size_t place = 0; place < bytes.size();) {
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + place, sizeof length);
    all.push_back(nlohmann::json::parse(bytes.substr(place + 4, length)));
    EXPECT_EQ(length % 4, 0U);
    float first = 0;
    std::memcpy(&first, bytes.data() + place + 4 + length, sizeof first);
    EXPECT_EQ(first, 1);
    place += 4 + length + 4 * 4 + 8;  // four positions; three levels, filled up
  }
  return all;
}

TEST(Gallery, GivesEachPictureOnceToThoseWhoWishForIt) {
  Gallery gallery;
  gallery.hang(picture("fluid", "pressure"));
  gallery.hang(picture("solid", "speed"));
  gallery.hang(picture("coupler", "outline"));
  const Hanging first = gallery.wait(0, {"fluid.pressure"}, at_once);
  const auto seen = headers(first.bytes);
  ASSERT_EQ(seen.size(), 2U);  // what was wished for, and the outlines
  EXPECT_EQ(seen[0]["quantity"], "pressure");
  EXPECT_EQ(seen[1]["quantity"], "outline");
  EXPECT_EQ(gallery.wait(first.version, {"fluid.pressure"}, at_once).bytes, "");
  gallery.hang(picture("fluid", "pressure", 2));
  const auto next = headers(gallery.wait(first.version, {"fluid.pressure"}, at_once).bytes);
  ASSERT_EQ(next.size(), 1U);
  EXPECT_EQ(next[0]["step"], 2);
}

TEST(Gallery, KeepsAllMomentsThatArePastBesideTheNewest) {
  Gallery gallery;
  for (const std::uint64_t step : {3U, 1U, 2U}) gallery.keep(picture("fluid", "pressure", step));
  for (const std::uint64_t step : {8U, 9U}) gallery.hang(picture("fluid", "pressure", step));
  std::vector<int> steps;
  for (const auto& one : headers(gallery.wait(0, {"fluid.pressure"}, at_once).bytes))
    steps.push_back(one["step"].get<int>());
  EXPECT_EQ(steps, (std::vector<int>{3, 1, 2, 9}));
}

TEST(Gallery, GivesMuchInSeveralAnswersAndNothingTwice) {
  Gallery gallery;
  wire::Picture large = picture("fluid", "pressure");
  large.grids = {
      {.name = "g", .n1 = 256, .n2 = 256, .straight = true, .x = std::vector<float>(512, 1), .level = {}}};
  large.grids[0].level.assign(std::size_t{256} * 256, 1);
  constexpr std::uint64_t many = 100;  // 13 MB
  for (large.step = 1; large.step <= many; ++large.step) gallery.keep(large);
  std::uint64_t after = 0, answers = 0, bytes = 0;
  for (Hanging one = gallery.wait(0, {"fluid.pressure"}, at_once); !one.bytes.empty();
       one = gallery.wait(after, {"fluid.pressure"}, at_once)) {
    after = one.version;
    bytes += one.bytes.size();
    ++answers;
  }
  EXPECT_EQ(after, many);
  EXPECT_GT(answers, 2U);
  EXPECT_GT(bytes, many * 256 * 256 * 2);
  EXPECT_LT(bytes, many * (256 * 256 * 2 + 4096));
}

TEST(Gallery, WhoWaitsHearsOfANewPictureAndOfTheEnd) {
  Gallery gallery;
  auto waiting = std::async(std::launch::async, [&] { return gallery.wait(0, {"solid.speed"}, long_time); });
  while (gallery.wishes().empty()) continue;
  gallery.hang(picture("fluid", "pressure"));  // nobody's wish
  gallery.hang(picture("solid", "speed"));
  EXPECT_EQ(headers(waiting.get().bytes).size(), 1U);
  auto last = std::async(std::launch::async, [&] { return gallery.wait(9, {"solid.speed"}, long_time); });
  gallery.close();
  EXPECT_EQ(last.get().bytes, "");
}

TEST(Gallery, KnowsWhatIsLookedAtNow) {
  Gallery gallery;
  EXPECT_TRUE(gallery.wishes().empty());
  gallery.wait(0, {"fluid.speed", "solid.stress", std::string(1000, 'x')}, at_once);
  EXPECT_EQ(gallery.wishes(), (std::vector<std::string>{"fluid.speed", "solid.stress"}));
}

}  // namespace
}  // namespace fsi::monitor
