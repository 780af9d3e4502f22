#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <regex>
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

/// Damaged files in all: a hundred of each case, or as many as FSI_DAMAGES says.
int wanted_damages(std::size_t cases) {
  const char* said = std::getenv("FSI_DAMAGES");  // NOLINT(concurrency-mt-unsafe)
  return said != nullptr ? std::stoi(said) : 100 * static_cast<int>(cases);
}

/// One line of a decent length that says where: file, line and column.
void expect_located(const std::string& message) {
  static const std::regex located("^[^\n]*case\\.yaml:[0-9]+:[0-9]+: [^\n]+$");
  EXPECT_TRUE(std::regex_match(message, located)) << message;
  EXPECT_LT(message.size(), 1000U) << message;
}

TEST(DamagedCase, IsAMistakeWithItsPlaceOrFineButNeverACrash) {
  const std::vector<std::string> paths = tests::config_paths();
  const int damages = wanted_damages(paths.size());
  int mistakes = 0;
  for (int seed = 1; seed <= damages; ++seed) {
    const std::string& path = paths[static_cast<std::size_t>(seed) % paths.size()];
    const tests::TemporaryFolder folder;
    const std::string damaged = Mutator(static_cast<unsigned>(seed)).mutate(coarse(tests::text_of(path)));
    try {
      load_case(folder.write("case.yaml", damaged));
    } catch (const UserMistake& mistake) {
      ++mistakes;
      expect_located(mistake.what());
    } catch (const std::exception& error) {
      ADD_FAILURE() << path << ", seed " << seed << ": " << error.what();
    }
  }
  fmt::print("{} damaged files of {} cases: {} refused with file, line and column, {} still right\n", damages,
             paths.size(), mistakes, damages - mistakes);
  EXPECT_GT(mistakes, damages / 3);
}

}  // namespace
}  // namespace fsi
