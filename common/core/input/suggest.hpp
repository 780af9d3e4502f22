#pragma once
/// "Did you mean": the known word closest to a mistyped one.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fsi {

/// Edits (insert, delete, replace, swap of neighbours) that turn `a` into `b`.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate closest to `word`, or "" where none is near enough to be meant.
std::string closest(std::string_view word, std::span<const std::string> candidates);

/// "; did you mean `end`?", or "" where nothing is near.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

/// The user's own text in a message: one line, control characters as `?`, cut where it is long.
std::string shown(std::string_view text);

/// The same between backticks.
std::string in_ticks(std::string_view text);

}  // namespace fsi
