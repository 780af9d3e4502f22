#pragma once
/// Words that stand for a whole boundary in a case file.

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "common/case/schema/boundary_facts.hpp"

namespace fsi::schema {

/// Those kinds of a section that need no key of their own, or none that the reference solution could not say.
template <const auto& variants>
constexpr auto words_said() {
  constexpr auto is_word = [](const Variant& variant) { return is_said_by_a_word(variant.keys); };
  std::array<std::string_view, static_cast<std::size_t>(std::ranges::count_if(variants, is_word))> words{};
  std::size_t next = 0;
  for (const Variant& variant : variants)
    if (is_word(variant)) words[next++] = variant.kind;
  return words;
}

}  // namespace fsi::schema
