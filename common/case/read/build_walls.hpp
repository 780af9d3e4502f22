#pragma once
/// Where the ends of an open curve stand: on sides of the gas's rectangle, or on the wall of another grid.

#include <string>

#include "common/case/case.hpp"
#include "common/case/document/reader.hpp"

namespace fsi {

/// Reads `walls` of a shape: two sides, or twice the name
/// of a grid of the gas along a wall. @throws UserMistake
void read_walls(const config::Node& shape, const std::string& path, CurveSpec& curve);

/// Completes a curve that stands on a wall: the wall's direction where its ends are, and the side it stands
/// for. @throws UserMistake where there is no such wall, an end is off it, or it is not straight from one end
/// to the other
void stand_on_wall(const Reader& reader, const config::Node& shape, const std::string& path,
                   CurveSpec& curve);

}  // namespace fsi
