#pragma once
/// The key of those sides of a solid that carry a load.

#include "common/case/schema/schema.hpp"
#include "common/core/choices.hpp"

namespace fsi::schema {

inline constexpr Key load_key{
    .name = "load",
    .type = Type::word,
    .meaning =
        "configuration whose area (13) and normal the load belongs to; `reference` is small-strain theory",
    .fallback = name_of(LoadConfiguration::current),
    .words = words_of<LoadConfiguration>};

}  // namespace fsi::schema
