#pragma once
/// The section `beam` of a solid.

#include <optional>
#include <string>
#include <string_view>

#include "common/case/case.hpp"
#include "common/case/document/reader.hpp"

namespace fsi {

/// Empty where the solid has no such section. @throws UserMistake, also where a beam has none
std::optional<BeamSpec> build_beam(const Reader& reader, const config::Node& solid, std::string_view law,
                                   const std::string& path);

}  // namespace fsi
