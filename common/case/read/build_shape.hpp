#pragma once
/// Curves and the grids fitted to them.

#include <optional>
#include <string>
#include <vector>

#include "common/case/read/build_domain.hpp"

namespace fsi {

/// Puts the points of files that shapes name in their place, so that a case needs no other file; paths are
/// relative to `folder`. @throws UserMistake
void inline_point_files(config::Node& root, const std::string& folder);

/// `blunt` of a shape that gives none, in parts of h [-]: a face of one cell, half as wide as others.
inline constexpr double usual_blunt = 0.5;

/// Points of the curve under `shape`, as many as it says or `points` of them. @throws UserMistake
CurveSpec build_curve(const Reader& reader, const config::Node& shape, const std::string& path,
                      std::optional<int> points = {});

/// The grid along the outline of a solid; none where it has no `shape`. @throws UserMistake
std::vector<BodyFittedSpec> build_outline_grid(const Reader& reader, const Owner& owner,
                                               const std::array<BoundarySpec, 4>& boundary);

/// The body-fitted grids of the gas. @throws UserMistake
std::vector<BodyFittedSpec> build_fitted_grids(const Reader& reader, const Owner& owner,
                                               const std::array<BoundarySpec, 4>& boundary,
                                               const std::vector<SolidSpec>& solids);

}  // namespace fsi
