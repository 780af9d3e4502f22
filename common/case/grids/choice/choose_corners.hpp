#pragma once
/// Corners of polygons of which the file does not say how round they are.

#include <string>
#include <vector>

#include "common/case/document/reader.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Writes `radius: 0` for polygons of solids that have neither `radius` nor `sharpness`, where an edge between
/// two corners is shorter than two widths of the usual rounding: both corners would become one tight bend, whose
/// few small points the whole outline gets, and whose lines crowd beside it. Of convex outlines only, and of
/// elastic bodies those of four straight sides.
/// @param chosen gets a line for people for each of them
void choose_corners(config::Node& root, const Reader& reader, std::vector<std::string>& chosen);

}  // namespace fsi
