#pragma once
/// The solid of a case as every rank has it: its solver, and what it does between two answers of the coupler.

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "common/case/grids/block.hpp"
#include "common/case/grids/composite_from_case.hpp"
#include "common/grid/geometry/interface_geometry.hpp"
#include "common/program/grid_from_case.hpp"
#include "common/wire/messages.hpp"
#include "solid_solver/boundary/joined_sides.hpp"
#include "solid_solver/boundary/robin.hpp"
#include "solid_solver/program/case_data.hpp"
#include "solid_solver/solid_solver.hpp"

namespace fsi::solid {

/// Where the solid meets a gas: along a side of a grid, or along several from corner to corner.
struct Meeting {
  JoinedSides along;
  int grid;          ///< component grid
  std::string name;  ///< of the interface

  bool is_side() const { return along.stretches().size() == 1; }
  Side side() const { return along.stretches().front().side; }
};

/// What the coupler says of an interface, as far as a solid goes by it.
struct Answer {
  std::span<const double> n, v_n, w_n;  ///< projected state, as in InterfaceValues
  RobinData gas;                        ///< for the steps within the next macro step
};

template <Law L>
class SolidBody {
 public:
  SolidBody(const Setup& setup, const SolidSpec& spec)
      : setup_(setup),
        law_(law_with<L>(spec.lambda, spec.mu, spec.data)),
        data_(setup, spec, law_),
        solver_(data_.parts(), bodies_of(fitted_grids(spec)), law_, data_.options(), 0) {
    if (is_block(spec)) {
      find_outline(spec);
    } else {
      find_interface(spec, 0, spec.boundary);
      for (const BodyFittedSpec& fitted : spec.body_fitted) find_interface(spec, 1, fitted.boundary);
    }
    if (const VectorFunction force = data_.body_force()) solver_.set_body_force(force);
    if (const auto solution = data_.chosen_solution()) solver_.choose(*solution);
    if (const StateFunction initial = data_.initial_state()) {
      solver_.assign_initial_conditions(initial);
    } else {
      solver_.assign_initial_conditions(data_.initial_displacement(), data_.initial_velocity());
    }
  }

  SolidSolver<L>& solver() { return solver_; }
  const SolidSolver<L>& solver() const { return solver_; }
  const CaseData<L>& data() const { return data_; }
  /// The interfaces, in the order of the hello.
  std::span<const Meeting> meetings() const { return meetings_; }

  void apply_bcs(double t, std::span<const Answer> answers) {
    values_.clear();
    for (std::size_t k = 0; k < answers.size(); ++k) {
      const auto& [n, v_n, w_n, gas] = answers[k];
      tell(meetings_[k], {.n = n, .v_n = v_n, .w_n = w_n});
    }
    solver_.apply_solid_bcs(t, values_);
  }

  /// From t to t + dt in equal steps, without interface conditions at the end. Calls lap(kind of work) after each kind
  /// but the last.
  template <class Lap>
  void advance(double t, double dt, int substeps, std::span<const Answer> answers, const Lap& lap) {
    const double dt_sub = dt / substeps;
    for (int k = 0; k < substeps; ++k) {
      const double t_k = t + k * dt_sub;
      const bool last = k + 1 == substeps;
      solver_.advance_solid(t_k, dt_sub, last ? Look::all : Look::soundness);
      if (last) break;
      lap(io::Work::advance);
      close_substep(t_k + dt_sub, answers);
      lap(io::Work::boundary);
    }
  }

  /// Predicted state of an interface; reuses the memory of `state`.
  void show(const Meeting& meeting, SolidInterface& state) const {
    if (meeting.is_side()) return solver_.interface_state(meeting.side(), state, meeting.grid);
    const std::span<const Stretch> stretches = meeting.along.stretches();
    sides_.resize(stretches.size());
    for (std::size_t k = 0; k < stretches.size(); ++k)
      solver_.interface_state(stretches[k].side, sides_[k], meeting.grid);
    meeting.along.join(sides_, state);
  }
  /// Reference positions of its points.
  std::vector<double> reference_points(const Meeting& meeting) const {
    const grid::MovingGrid& grid = solver_.grid(meeting.grid);
    if (meeting.is_side()) return grid.side_points(meeting.side());
    std::vector<std::vector<double>> x;
    for (const Stretch& stretch : meeting.along.stretches()) x.push_back(grid.side_points(stretch.side));
    std::vector<double> all(2 * meeting.along.points());
    meeting.along.put_together(std::vector<std::span<const double>>(x.begin(), x.end()), all);
    return all;
  }
  SideLoad load(const Meeting& meeting) const {
    const std::span<const Stretch> stretches = meeting.along.stretches();
    SideLoad sum = solver_.side_load(stretches.front().side, meeting.grid);
    for (const Stretch& stretch : stretches.subspan(1)) sum += solver_.side_load(stretch.side, meeting.grid);
    return sum;
  }

  /// Unit normals of an interface at these positions; of ends that slide along a wall, its direction.
  std::vector<double> normals(const Meeting& meeting, std::span<const double> x,
                              std::span<const std::uint8_t> freedom) const {
    std::vector<double> n = unturned_normals(meeting, x);
    const std::size_t points = freedom.size();
    for (const std::size_t k : {std::size_t{0}, points - 1}) {
      if (freedom[k] != wire::Freedom::slides) continue;
      const Vec2 along = along_wall(meeting, k == 0);
      n[k] = along.x();
      n[points + k] = along.y();
    }
    return n;
  }

 private:
  void find_interface(const SolidSpec& spec, int grid, const std::array<BoundarySpec, 4>& boundary) {
    for (const Side side : all_sides) {
      if (boundary[static_cast<std::size_t>(side)].kind != BoundaryKind::interface) continue;
      const std::string& fluid = boundary[static_cast<std::size_t>(side)].fluid;
      const int points = solver_.grid(grid).side_size(side);
      meetings_.push_back(
          {.along = {{{.side = side}}, {points}, false}, .grid = grid, .name = interface_name(spec, fluid)});
    }
  }

  void find_outline(const SolidSpec& spec) {
    const BodyFittedSpec& outline = spec.body_fitted.front();
    const BoundarySpec& condition = outline.boundary[static_cast<std::size_t>(outline.side)];
    if (condition.kind != BoundaryKind::interface) return;
    std::vector<Stretch> stretches;
    std::vector<int> points;
    for (const Side side : sides_along(outline.curve)) {
      stretches.push_back({.side = side, .against = runs_against_outline(side)});
      points.push_back(solver_.grid().side_size(side));
    }
    meetings_.push_back({.along = {std::move(stretches), points, outline.curve.closed()},
                         .grid = 0,
                         .name = interface_name(spec, condition.fluid)});
  }

  std::vector<double> unturned_normals(const Meeting& meeting, std::span<const double> x) const {
    if (meeting.is_side()) {
      const grid::Curve curve = curve_along(solver_.grid(meeting.grid), meeting.side());
      return grid::normals(x, curve, grid::outward(meeting.side()));
    }
    constexpr double to_the_right = 1;
    return grid::normals(x, meeting.along.closed() ? grid::Curve::closed : grid::Curve::open, to_the_right);
  }

  /// Direction in which an end of an interface slides along a wall.
  Vec2 along_wall(const Meeting& meeting, bool first) const {
    const Stretch& stretch = first ? meeting.along.stretches().front() : meeting.along.stretches().back();
    const bool at_begin = first != stretch.against;
    const int k = at_begin ? 0 : solver_.grid(meeting.grid).side_size(stretch.side) - 1;
    return solver_.along_wall(stretch.side, k, meeting.grid);
  }

  /// Adds what an interface is told to `values_`, side by side.
  void tell(Meeting& meeting, InterfaceValues values) {
    values.grid = meeting.grid;
    values.side = meeting.side();
    if (meeting.is_side()) {
      values_.push_back(values);
    } else {
      meeting.along.split(values, values_);
    }
  }

  /// Does a rank know the interface?
  bool shows(const Meeting& meeting) const {
    return !meeting.is_side() || solver_.shows(meeting.side(), meeting.grid);
  }

  /// The interfaces inside a macro step: the gas is known by its outgoing characteristic.
  void close_substep(double t, std::span<const Answer> answers) {
    std::vector<std::vector<double>> normal(answers.size());
    std::vector<ClosedInterface> closed(answers.size());
    values_.clear();
    solver_.attempt([&] {
      for (std::size_t k = 0; k < answers.size(); ++k) {
        Meeting& meeting = meetings_[k];
        if (!shows(meeting)) continue;
        show(meeting, interface_);
        normal[k] = normals(meeting, interface_.x, interface_.fixed);
        closed[k] = close_with_robin(answers[k].gas, t, normal[k], interface_);
        tell(meeting, {.n = normal[k], .v_n = closed[k].v_n, .w_n = closed[k].w_n});
      }
    });
    solver_.apply_solid_bcs(t, values_);
  }

  const Setup& setup_;
  L law_;
  CaseData<L> data_;
  SolidSolver<L> solver_;
  std::vector<Meeting> meetings_;
  SolidInterface interface_;                   ///< memory that is used again every step
  mutable std::vector<SolidInterface> sides_;  ///< the same
  std::vector<InterfaceValues> values_;        ///< the same
};

}  // namespace fsi::solid
