#pragma once
/// One component grid of the gas domain with everything that belongs to it.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/core/field.hpp"
#include "common/core/types.hpp"
#include "common/grid/moving_grid.hpp"
#include "fluid_solver/gas_options.hpp"
#include "fluid_solver/kernels/workspace.hpp"

namespace fsi::fluid {

/// Projected values of one interface side, n points; vectors component-major (component c of point k at [c * n + k]).
struct InterfaceValues {
  Side side = Side::left;
  std::span<const double> n;    ///< unit normal from the solid into the gas, 2 n
  std::span<const double> v_n;  ///< v_n^I, n
  std::span<const double> w_n;  ///< w_n^I = p_e - p^I, n
  std::span<const double> v;    ///< velocity of the wall points, 2 n
  std::span<const double> a;    ///< acceleration of the wall points, 2 n
};

/// A named piece of state, to be written to a checkpoint or overwritten from one.
struct CheckpointArray {
  std::string name;
  std::span<double> values;
};

/// Motion of a wall that goes with the grid, from the positions of its points at the last three levels.
struct WallMotion {
  std::vector<double> velocity;      ///< at the newest level, 2 n
  std::vector<double> acceleration;  ///< 2 n
  std::vector<double> mid_velocity;  ///< mean over the last step, 2 n
};

class Component {
 public:
  Component(grid::MovingGrid grid, std::array<Boundary, 4> boundaries);

  const grid::MovingGrid& grid() const { return grid_; }
  ConstFieldView state() const { return state_.view(); }
  FieldView state() { return state_.view(); }
  const std::array<Boundary, 4>& boundaries() const { return boundaries_; }
  const Boundary& boundary(Side side) const { return boundaries_[static_cast<std::size_t>(side)]; }
  const WallMotion& wall(Side side) const { return walls_[static_cast<std::size_t>(side)]; }

  void move(double t_new, double dt, std::span<const grid::SideCommand> commands);
  /// One step of the sweep: state() becomes the predicted state.
  void advance(double dt, const GasOptions& options);
  /// Fills the wave rates of all rows from the present state.
  void measure_rates(const GasOptions& options);
  std::vector<CheckpointArray> checkpoint_arrays();

 private:
  grid::MovingGrid grid_;
  std::array<Boundary, 4> boundaries_;
  Field state_;  ///< rho, v1, v2, p
  Field next_;
  Workspace workspace_;
  std::array<WallMotion, 4> walls_;
};

}  // namespace fsi::fluid
