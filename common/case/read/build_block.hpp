#pragma once
/// A solid whose one grid lies between the four straight sides of its outline: `grid: {kind: block, points: [.., ..]}`.

#include "common/case/read/build_domain.hpp"

namespace fsi {

/// A solid with a `shape` whose `grid` has points and neither corners nor a kind: most likely they are meant from corner
/// to corner. @throws NoGridsFit which proposes that
void refuse_points_of_no_rectangle(const config::Node& root);

/// The `grid` of a solid. @throws UserMistake
GridSpec build_solid_grid(const Reader& reader, const Owner& owner);

/// The outline of a block gets the points of its grid, and the sides of the grid the conditions of the outline; other
/// solids stay as they are. @throws UserMistake for keys of a grid along the outline, which a block has not
void complete_block(const config::Node& node, const std::string& path, SolidSpec& solid);

}  // namespace fsi
