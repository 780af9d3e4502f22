#pragma once
/// Velocity and acceleration of a side that goes with its grid, from the positions of its points.

#include <array>
#include <vector>

#include "common/core/archive.hpp"
#include "fluid_solver/boundary/side_points.hpp"

namespace fsi::fluid {

/// Per point of a side, vectors component-major.
struct WallMotion {
  std::vector<double> normal;        ///< unit normal into the grid
  std::vector<double> velocity;      ///< at the newest level
  std::vector<double> acceleration;  ///< at the newest level
  std::vector<double> mid_velocity;  ///< first divided difference over the last step
  std::vector<double> bend;          ///< second divided difference over the last two steps

  void archive(Archive& archive);
};

/// Lengths of the last steps, the newest first; 0 where a level
/// coincides with the next (a start with known motion).
struct StepHistory {
  double dt = 0, before = 0, earlier = 0;  ///< [time]
  int order = 1;  ///< differences that can be formed: 1 positions two levels, 2 three, 3 four
};

/// Room for the points of a side, at rest.
WallMotion wall_at_rest(std::size_t points);

/// Motion from the displacement of the last step: derivatives at the newest level of the polynomial through
/// the last levels, up to the third degree.
void advance_motion(WallMotion& wall, ConstFieldView x, ConstFieldView x_before, const SidePoints& side,
                    const StepHistory& history);

/// Motion at a start from the positions at t, t + delta, t + 2 delta, t + 3 delta.
void start_motion(WallMotion& wall, const std::array<std::vector<double>, 4>& x, double delta);

/// Normals from the grid's points.
void measure_normals(WallMotion& wall, ConstFieldView x, const SidePoints& side);

}  // namespace fsi::fluid
