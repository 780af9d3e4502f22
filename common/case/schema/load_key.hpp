#pragma once
/// The key of those sides of a solid that carry a load.

#include <array>
#include <string_view>

#include "common/case/schema/schema.hpp"

namespace fsi::schema {

inline constexpr std::array<std::string_view, 2> load_words{"current", "reference"};
inline constexpr Key load_key{
    .name = "load",
    .type = Type::word,
    .meaning =
        "configuration whose area (13) and normal the load belongs to; `reference` is small-strain theory",
    .fallback = "current",
    .words = load_words};

}  // namespace fsi::schema
