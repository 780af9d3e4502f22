#pragma once
/// What a case says of solids that are no continuum: rigid bodies and beams.

#include <optional>
#include <string>
#include <string_view>

#include "common/case/case.hpp"
#include "common/case/document/reader.hpp"

namespace fsi {

/// What holds a rigid body. @throws UserMistake, also where another solid is held
MountingSpec build_mounting(const Reader& reader, const config::Node& solid, const std::string& path,
                            bool rigid);

/// The section `beam` of a solid. Empty where the solid has no such section. @throws UserMistake, also where a beam has none
std::optional<BeamSpec> build_beam(const Reader& reader, const config::Node& solid, std::string_view law,
                                   const std::string& path);

}  // namespace fsi
