#include <gtest/gtest.h>

#include <random>
#include <string>

#include "common/core/failure.hpp"
#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

/// Damages a case file the way people and editors do: characters, words and lines lost, doubled or swapped.
class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string mutate(std::string text) {
    const int count = pick(1, 4);
    for (int k = 0; k < count && !text.empty(); ++k) mutate_once(text);
    return text;
  }

 private:
  std::mt19937 random_;

  int pick(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  std::size_t position(const std::string& text) {
    return static_cast<std::size_t>(pick(0, static_cast<int>(text.size()) - 1));
  }

  void mutate_once(std::string& text) {
    static const std::string characters = "[]{}:,#&*!|>'\"%@`-?~ \n\t0123456789.xyrst()+/^=<\\_\x01\xc3\xff";
    const std::size_t at = position(text);
    const auto length = static_cast<std::size_t>(pick(1, 30));
    switch (pick(0, 6)) {
      case 0:
        text[at] = characters[position(characters)];
        break;
      case 1:
        text.insert(at, 1, characters[position(characters)]);
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(position(text), text.substr(at, length));
        break;
      case 4:
        text.erase(at);
        break;
      case 5: {
        const std::size_t begin = text.rfind('\n', at) == std::string::npos ? 0 : text.rfind('\n', at);
        text.erase(begin, text.find('\n', at) - begin);
        break;
      }
      default:
        text.insert(at, characters.substr(position(characters), 3));
        break;
    }
  }
};

/// The case on its coarsest grids: overlaps are checked for every damaged one.
std::string coarse(std::string text) {
  for (const char* factor : {"factor: 2", "factor: 4"}) {
    const std::size_t place = text.find(factor);
    if (place != std::string::npos) text.replace(place, std::string(factor).size(), "factor: 1");
  }
  return text;
}

TEST(DamagedCase, IsAMistakeOrFineButNeverACrash) {
  constexpr int damages = 100;
  unsigned seed = 1;
  int mistakes = 0, all = 0;
  for (const std::string& path : tests::config_paths()) {
    const std::string text = coarse(tests::text_of(path));
    const tests::TemporaryFolder folder;
    for (int k = 0; k < damages; ++k, ++all) {
      const std::string damaged = Mutator(seed++).mutate(text);
      try {
        load_case(folder.write("case_" + std::to_string(k) + ".yaml", damaged));
      } catch (const UserMistake& mistake) {
        ++mistakes;
        const std::string message = mistake.what();
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_LT(message.size(), 1000U) << message;
      } catch (const std::exception& error) {
        ADD_FAILURE() << path << ", seed " << seed - 1 << ": " << error.what();
      }
    }
  }
  EXPECT_GT(mistakes, all / 3);
}

}  // namespace
}  // namespace fsi
