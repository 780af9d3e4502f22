#include "monitor/web/gallery.hpp"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

namespace fsi::monitor {

namespace {

/// A browser that has not asked for this time looks elsewhere.
constexpr std::chrono::seconds patience_with_browsers{3};
constexpr std::size_t most_wishes = 16, longest_wish = 32;
/// More than the programs of a run have quantities: anybody may send pictures under any name.
constexpr std::size_t most_frames = 256;

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
  const std::size_t place = bytes.size(), length = values.size() * sizeof(T);
  bytes.resize(place + length);
  if (length > 0) std::memcpy(bytes.data() + place, values.data(), length);
}

void fill_up(std::string& bytes, char filler) {
  while (bytes.size() % sizeof(float) != 0) bytes += filler;
}

std::string encoded(const wire::Picture& picture) {
  nlohmann::json grids = nlohmann::json::array();
  for (const auto& grid : picture.grids)
    grids.push_back({{"name", grid.name}, {"n1", grid.n1}, {"n2", grid.n2}, {"straight", grid.straight}});
  const nlohmann::json header = {
      {"from", picture.from}, {"role", picture.role}, {"quantity", picture.quantity}, {"step", picture.step},
      {"t", picture.t},       {"low", picture.low},   {"high", picture.high},         {"grids", grids}};
  std::string text = header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  fill_up(text, ' ');
  std::string bytes;
  append(bytes, std::vector{static_cast<std::uint32_t>(text.size())});
  bytes += text;
  for (const auto& grid : picture.grids) {
    append(bytes, grid.x);
    append(bytes, grid.level);
    fill_up(bytes, '\0');
  }
  return bytes;
}

}  // namespace

void Gallery::hang(const wire::Picture& picture) {
  auto bytes = std::make_shared<const std::string>(encoded(picture));
  {
    const std::scoped_lock lock(mutex_);
    const std::pair place(picture.from, picture.quantity);
    if (!frames_.contains(place) && frames_.size() >= most_frames) return;
    frames_[place] = {.version = ++version_, .role = picture.role, .bytes = std::move(bytes)};
  }
  changed_.notify_all();
}

Hanging Gallery::wait(std::uint64_t after, const std::vector<std::string>& wishes,
                      std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  for (const std::string& wish : wishes) {
    const bool known = wishes_.contains(wish);
    if (known || (wish.size() <= longest_wish && wishes_.size() < most_wishes)) wishes_[wish] = Clock::now();
  }
  Hanging found;
  changed_.wait_for(lock, patience, [&] {
    found = newer(after, wishes);
    return closed_ || !found.bytes.empty();
  });
  return found;
}

Hanging Gallery::newer(std::uint64_t after, const std::vector<std::string>& wishes) const {
  Hanging found{.version = version_, .bytes = {}};
  for (const auto& [place, frame] : frames_) {
    const bool wished = std::ranges::find(wishes, frame.role + "." + place.second) != wishes.end();
    if (frame.version > after && (wished || frame.role == "coupler")) found.bytes += *frame.bytes;
  }
  return found;
}

std::vector<std::string> Gallery::wishes() {
  const std::scoped_lock lock(mutex_);
  const auto now = Clock::now();
  std::erase_if(wishes_, [now](const auto& wish) { return now - wish.second > patience_with_browsers; });
  std::vector<std::string> all;
  for (const auto& [wish, asked_at] : wishes_) all.push_back(wish);
  return all;
}

void Gallery::close() {
  {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

}  // namespace fsi::monitor
