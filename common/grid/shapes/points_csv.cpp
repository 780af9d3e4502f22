#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>

#include "common/core/failure.hpp"
#include "common/grid/shapes/spline.hpp"

namespace fsi::grid {

namespace {

constexpr std::string_view separators = " \t,;\r";

/// Reads the next number of a line from position `at` on, which moves behind it.
/// @returns false where no number stands there
bool next_number(std::string_view line, std::size_t& at, double& number) {
  at = std::min(line.find_first_not_of(separators, at), line.size());
  const char* const begin = line.data() + at + (at < line.size() && line[at] == '+' ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, line.data() + line.size(), number);
  const bool ends_well = end == line.data() + line.size() || separators.find(*end) != std::string_view::npos;
  if (error != std::errc() || !ends_well || !std::isfinite(number)) return false;
  at = static_cast<std::size_t>(end - line.data());
  return true;
}

/// Spreadsheets mark text as UTF-8 by these three bytes before it.
std::string_view without_mark(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

/// A word, not a number that is written wrongly.
bool is_word(std::string_view line, std::size_t first) {
  return first < line.size() && std::string_view("+-.0123456789").find(line[first]) == std::string_view::npos;
}

bool is_empty(std::string_view line) {
  const std::size_t first = line.find_first_not_of(separators);
  return first == std::string_view::npos || line[first] == '#';
}

}  // namespace

std::vector<Vec2> points_from_csv(std::string_view file, const std::string& name) {
  const std::string_view text = without_mark(file);
  std::vector<Vec2> points;
  bool heading_allowed = true;
  for (std::size_t number = 1, from = 0; from < text.size(); ++number) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    const std::string_view line = text.substr(from, to - from);
    from = to + 1;
    if (is_empty(line)) continue;
    std::size_t at = 0;
    double x = 0, y = 0;
    const bool read = next_number(line, at, x) && next_number(line, at, y);
    if (read && line.find_first_not_of(separators, at) == std::string_view::npos) {
      points.emplace_back(x, y);
    } else if (const std::size_t first = line.find_first_not_of(separators);
               !(heading_allowed && !read && at == first && is_word(line, first))) {
      at = std::min(line.find_first_not_of(separators, at), line.size());
      throw UserMistake(
          fmt::format("{}:{}:{}: write two numbers, x and y, separated by a comma", name, number, at + 1));
    }
    heading_allowed = false;
  }
  if (points.empty()) throw UserMistake(fmt::format("{}:1:1: no points; write x, y on a line each", name));
  return points;
}

}  // namespace fsi::grid
