#pragma once
/// Numbers as many languages write them, in braces.

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "common/core/failure.hpp"
#include "common/core/input/config.hpp"
#include "common/core/input/suggest.hpp"

namespace fsi::config {

/// {end: 0,0004}: to YAML `end` is 0, and 0004 another key, without a value. {rho: max(2, 1)} is max(2 and 1).
/// @param first, next  entries in braces, one after the other @throws UserMistake
inline void refuse_decimal_comma(const Entry& first, const Entry& next) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const std::string& text = first.value.text;
  if (next.value.kind != Node::Kind::null || text.empty() || next.key.empty()) return;
  if (std::ranges::count(text, '(') > std::ranges::count(text, ')'))
    throw UserMistake(
        fmt::format("{}: {}: in braces a comma ends a formula, here after {}: put the whole of it in quotes",
                    first.value.place, shown(first.key), shown(text)));
  if (!is_digit(text.back()) || !is_digit(next.key.front())) return;
  throw UserMistake(fmt::format("{}: {}: a decimal comma? Write a point, {}.{}", first.value.place,
                                shown(first.key), shown(text), shown(next.key)));
}

}  // namespace fsi::config
