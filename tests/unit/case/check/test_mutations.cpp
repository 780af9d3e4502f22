#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <random>
#include <regex>
#include <string>

#include "common/case/report/memory.hpp"
#include "common/core/failure.hpp"
#include "tests/unit/case/cases.hpp"
#include "tests/unit/case/odd_files.hpp"

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

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int k = 0; k < count; ++k) all += text;
  return all;
}

/// One more line for every number below `count`, with its number for each #.
std::string numbered(const std::string& line, int count) {
  std::string all;
  for (int k = 0; k < count; ++k) all += std::regex_replace(line, std::regex("#"), std::to_string(k));
  return all;
}

/// Files that nobody writes by mistake: too deep, too long, too many, without an end, not text.
class Hostile {
 public:
  Hostile(unsigned seed, const tests::TemporaryFolder& folder) : random_(seed), folder_(folder) {}

  std::string mutate(const std::string& text) {
    switch (std::uniform_int_distribution<int>(0, 5)(random_)) {
      case 0:
        return deep(text);
      case 1:
        return many(text);
      case 2:
        return bytes(text);
      case 3:
        return points(text);
      case 4:
        return numbers(text);
      default:
        return aliases(text);
    }
  }

 private:
  std::mt19937 random_;
  const tests::TemporaryFolder& folder_;

  int pick(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  template <class T>
  T one_of(std::initializer_list<T> choices) {
    return *(choices.begin() + pick(0, static_cast<int>(choices.size()) - 1));
  }
  /// From a few to hundreds of thousands.
  int count() {
    return static_cast<int>(std::pow(10, std::uniform_real_distribution<double>(1, 5.4)(random_)));
  }

  std::string deep(const std::string& text) {
    const auto opening = one_of<std::string>({"[", "{a: ", "- ", "? ", "((", "sin("});
    const std::string open = repeated(opening, count());
    return one_of<std::string>({"title: ", "deep: ", "time: {end: ", ""}) + open + "\n" + text;
  }

  std::string many(const std::string& text) {
    switch (pick(0, 6)) {
      case 0:
        return "parameters:\n" + numbered("  a#: 1 + a#0\n", count()) + text;
      case 1: {
        const int n = count();
        std::string chain = "parameters:\n  a0: 1\n";
        for (int k = 1; k < n; ++k) chain += fmt::format("  a{}: a{} + 1\n", k, k - 1);
        return chain + std::regex_replace(text, std::regex("(^|\n)parameters:[^\n]*(\n[ #][^\n]*)*"), "");
      }
      case 2: {  // each of them twice the one before
        std::string laughs = "definitions:\n  a0: x\n";
        for (int k = 1; k < std::min(count(), 5000); ++k)
          laughs += fmt::format("  a{}: a{} + a{}\n", k, k - 1, k - 1);
        return laughs + text;
      }
      case 3:
        return numbered("key#: \"value\"\n", count()) + text;
      case 4:
        return "name: " + std::string(static_cast<std::size_t>(count()), 'n') + "\n" + text;
      case 5:
        return "title: " + std::string(static_cast<std::size_t>(10 * count()), 'x') + "\n" + text;
      default:
        return "output: {times: [" + repeated("0.1, ", count()) + "1]}\n" + text;
    }
  }

  std::string bytes(std::string text) {
    const auto junk = one_of<std::string>(
        {"\xff", "\xc3", "\xe2\x82", "\xed\xa0\x80", "\xf5\x80\x80\x80", std::string(1, '\0')});
    text.insert(static_cast<std::size_t>(pick(0, static_cast<int>(text.size()))),
                repeated(junk, pick(1, 1000)));
    return text;
  }

  /// A solid through points of a file that is none, or has too many.
  std::string points(const std::string& text) {
    auto name =
        one_of<std::string>({"/dev/zero", "/dev/null", "/dev/full", "/", "loop.csv", "pipe.csv", "many.csv"});
    if (name == "many.csv") folder_.write(name, numbered("#, #\n", count()));
    if (name == "loop.csv") tests::make_loop(folder_, name);
    if (name == "pipe.csv") tests::make_pipe(folder_, name);
    return std::regex_replace(text, std::regex("shape: *\\{[^}]*\\}"),
                              "shape: {kind: spline, file: " + name + "}") +
           (pick(0, 1) == 0 ? "" : "\n# " + name);
  }

  std::string numbers(const std::string& text) {
    const auto number =
        one_of<std::string>({"1e-300", "1e300", "1e9", "100000", "-1e300", "1e-9", "0", "1e6"});
    const auto key = one_of<std::string>({"points", "lines", "spacing", "factor", "end", "cfl", "growth",
                                          "rho", "x", "radius", "every", "dt", "semi_axes"});
    return std::regex_replace(
        text, std::regex("\\b" + key + ": *[^,}\n]*"), key + ": " + number,
        one_of({std::regex_constants::format_first_only, std::regex_constants::format_default}));
  }

  std::string aliases(const std::string& text) {
    std::string laughs = "a0: &a0 [x, x]\n";
    for (int k = 1; k < std::min(count(), 30); ++k)
      laughs += fmt::format("a{}: &a{} [*a{}, *a{}, *a{}]\n", k, k, k - 1, k - 1, k - 1);
    return laughs + text;
  }
};

/// Largest memory of this process so far [MB].
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
}

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
  static const std::regex located("^[^\n]*(case\\.yaml|many\\.csv):[0-9]+:[0-9]+: [^\n]+$");
  EXPECT_TRUE(std::regex_match(message, located)) << message;
  EXPECT_LT(message.size(), 1000U) << message;
}

/// What the damaged files came to.
struct Tally {
  int files = 0, mistakes = 0;
  double slowest = 0;  ///< processor time [s]

  /// Loads a damaged file: it must be fine, or a mistake with its place.
  void load(const std::string& path, const std::string& origin) {
    constexpr double most_memory = 500e6;  // of a run, so that no check builds more
    const double before = tests::processor_time();
    ++files;
    try {
      load_case_within(most_memory, path);
    } catch (const UserMistake& mistake) {
      ++mistakes;
      expect_located(mistake.what());
    } catch (const std::exception& error) {
      ADD_FAILURE() << origin << ": " << error.what();
    }
    const double time = tests::processor_time() - before;
    if (time > slowest) {
      slowest = time;
      slowest_file = origin;
    }
  }
  std::string slowest_file{};
};

TEST(DamagedCase, IsAMistakeWithItsPlaceOrFineButNeverACrash) {
  const std::vector<std::string> paths = tests::config_paths();
  const int damages = wanted_damages(paths.size());
  Tally tally;
  for (int seed = 1; seed <= damages; ++seed) {
    const std::string& path = paths[static_cast<std::size_t>(seed) % paths.size()];
    const tests::TemporaryFolder folder;
    const std::string text = coarse(tests::text_of_file(path));
    const std::string damaged = seed % 3 == 0 ? Hostile(static_cast<unsigned>(seed), folder).mutate(text)
                                              : Mutator(static_cast<unsigned>(seed)).mutate(text);
    tally.load(folder.write("case.yaml", damaged), fmt::format("{}, seed {}", path, seed));
  }
  fmt::print(
      "{} damaged files of {} cases: {} refused with file, line and column, {} still right; at most {:.2f} s "
      "of "
      "processor time for one ({}), {:.0f} MB\n",
      tally.files, paths.size(), tally.mistakes, tally.files - tally.mistakes, tally.slowest,
      tally.slowest_file, peak_memory());
  EXPECT_GT(tally.mistakes, damages / 3);
#ifndef __SANITIZE_ADDRESS__  // which keeps what was given back
  EXPECT_LT(peak_memory(), 500);
  constexpr double most_processor_time_s = 5;
  EXPECT_LT(tally.slowest, most_processor_time_s) << tally.slowest_file;
#endif
}

}  // namespace
}  // namespace fsi
