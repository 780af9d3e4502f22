#pragma once
/// Which grids fit an outline: numbers only, no case file.

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "common/case/case.hpp"

namespace fsi {

/// What is given of the grids of a body; the rest is chosen.
struct BodyWish {
  std::optional<int> lines;
  std::optional<double> line_spacing;        ///< [length]
  double growth = 1;                         ///< ratio of successive distances of lines [-]
  bool curve_is_given = false;               ///< the points along the outline
  std::optional<std::array<double, 4>> box;  ///< x_a, x_b, y_a, y_b of the core
};

/// Grids of a body.
struct BodyGrids {
  int outline_points = 0;
  int lines = 0;
  double line_spacing = 0;  ///< [length]
  GridSpec core;
};

/// An outline: seen closely, with many points evenly along it,
/// and with as many points as wanted, or as the case says.
struct Outline {
  CurveSpec closely;
  std::function<CurveSpec(std::optional<int> points)> with_points;
};

/// Grids inside an outline that connect: eight lines and a core h apart where the outline bends so gently
/// that they fit, closer ones where not. `outline_only`: of a
/// body without an inside (a rigid one), nothing is tried.
/// @throws UserMistake where they would take more points than there can be, with the place that asks for them
BodyGrids fit_body(const Outline& outline, double h, const BodyWish& wish, bool outline_only);

/// Lines of a grid of the gas.
struct RingGrid {
  int lines = 8;
  double spacing = 0;  ///< [length]

  bool operator==(const RingGrid&) const = default;
};

/// Grids of the gas around bodies.
struct GasGrids {
  double background = 0;        ///< distance of the background's points [length]
  std::vector<RingGrid> rings;  ///< those that were open
  bool lasting = false;         ///< they hold while the bodies move too
};

/// How the curve of a grid of the gas moves during a run.
enum class RingMotion { still, carried, deforming };

/// Lines for the grids `open` of the list, which share the background with the others: eight, as far apart as
/// the background's points, where there is room for them between bodies, to the rim and in bays; closer and
/// then fewer ones where not; where none connect and `finer` allows it, on a background of closer points. The
/// first ones that connect and are deep enough where they move, with sound cells where they deform (`motions`, of each
/// ring); the first ones that connect at t = 0 where there are none such; those of the room there is where none do
/// (check says then who is too near to whom).
GasGrids fit_rings(const GridSpec& background, const std::vector<BodyFittedSpec>& rings,
                   const std::vector<std::size_t>& open, const std::vector<RingMotion>& motions, bool finer);

}  // namespace fsi
