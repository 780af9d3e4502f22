#include "common/core/input/suggest.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace fsi {

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t width = b.size() + 1;
  std::vector<int> distance((a.size() + 1) * width);
  const auto at = [&](std::size_t i, std::size_t j) -> int& { return distance[i * width + j]; };
  for (std::size_t i = 0; i <= a.size(); ++i) at(i, 0) = static_cast<int>(i);
  for (std::size_t j = 0; j <= b.size(); ++j) at(0, j) = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replaced = at(i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0 : 1);
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
      }
    }
  }
  return distance.back();
}

std::string closest(std::string_view word, std::span<const std::string> candidates) {
  constexpr std::size_t longest_word = 64;  // longer is no typing mistake, and the distance costs its square
  if (word.empty() || word.size() > longest_word) return "";
  const int limit = static_cast<int>(std::max<std::size_t>(1, (word.size() + 2) / 3));
  int best = limit + 1;
  std::string found;
  for (const std::string& candidate : candidates) {
    const bool is_start = word.size() >= 3 && candidate.starts_with(word);
    const int distance = is_start ? 1 : edit_distance(word, candidate);
    if (distance < best && static_cast<std::size_t>(distance) < std::max(word.size(), candidate.size())) {
      best = distance;
      found = candidate;
    }
  }
  return found;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> candidates) {
  const std::string found = closest(word, candidates);
  return found.empty() ? "" : fmt::format("; did you mean `{}`?", found);
}

std::string shown(std::string_view text) {
  constexpr std::size_t longest_shown = 60;
  std::string result(text.substr(0, longest_shown));
  std::replace_if(
      result.begin(), result.end(), [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; },
      '?');
  return text.size() > longest_shown ? result + "..." : result;
}

std::string in_ticks(std::string_view text) {
  return fmt::format("`{}`", shown(text));
}

}  // namespace fsi
