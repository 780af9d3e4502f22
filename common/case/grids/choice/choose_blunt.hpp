#pragma once
/// Corners of outlines too sharp for a grid are cut off (common/grid/shapes/blunted.hpp): as far as the file says, or
/// as is chosen here.

#include <string>
#include <vector>

#include "common/case/document/reader.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Writes `blunt` into the shapes of solids and of the gas's grids that leave it open and have such corners.
/// @param chosen a line for people for each corner: where, how wide the face in its place is, and what is missing
void choose_blunt(config::Node& root, const Reader& reader, std::vector<std::string>& chosen);

}  // namespace fsi
