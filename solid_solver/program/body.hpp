#pragma once
/// The solid of a case as every rank has it: its solver, and what it does between two answers of the coupler.

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "common/case/grids/composite_from_case.hpp"
#include "common/grid/geometry/interface_geometry.hpp"
#include "common/program/grid_from_case.hpp"
#include "common/wire/messages.hpp"
#include "solid_solver/boundary/robin.hpp"
#include "solid_solver/program/case_data.hpp"
#include "solid_solver/solid_solver.hpp"

namespace fsi::solid {

/// Where the solid meets a gas.
struct Meeting {
  Side side;
  int grid;          ///< component grid
  std::string name;  ///< of the interface
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
        solver_(data_.parts(), bodies_of(spec.body_fitted), law_, data_.options(), 0) {
    find_interface(spec, 0, spec.boundary);
    for (const BodyFittedSpec& fitted : spec.body_fitted) find_interface(spec, 1, fitted.boundary);
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
      values_.push_back(
          {.side = meetings_[k].side, .n = n, .v_n = v_n, .w_n = w_n, .grid = meetings_[k].grid});
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

  /// Unit normals of an interface at these positions; of ends that slide along a wall, its direction.
  std::vector<double> normals(const Meeting& meeting, std::span<const double> x,
                              std::span<const std::uint8_t> freedom) const {
    const grid::Curve curve = curve_along(solver_.grid(meeting.grid), meeting.side);
    std::vector<double> n = grid::normals(x, curve, grid::outward(meeting.side));
    const std::size_t points = freedom.size();
    for (const std::size_t k : {std::size_t{0}, points - 1}) {
      if (freedom[k] != wire::Freedom::slides) continue;
      const Vec2 along = solver_.along_wall(meeting.side, static_cast<int>(k), meeting.grid);
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
      meetings_.push_back({.side = side, .grid = grid, .name = interface_name(spec, fluid)});
    }
  }

  /// The interfaces inside a macro step: the gas is known by its outgoing characteristic.
  void close_substep(double t, std::span<const Answer> answers) {
    std::vector<std::vector<double>> normal(answers.size());
    std::vector<ClosedInterface> closed(answers.size());
    values_.clear();
    solver_.attempt([&] {
      for (std::size_t k = 0; k < answers.size(); ++k) {
        const Meeting& meeting = meetings_[k];
        if (!solver_.shows(meeting.side, meeting.grid)) continue;
        solver_.interface_state(meeting.side, interface_, meeting.grid);
        normal[k] = normals(meeting, interface_.x, interface_.fixed);
        closed[k] = close_with_robin(answers[k].gas, t, normal[k], interface_);
        values_.push_back({.side = meeting.side,
                           .n = normal[k],
                           .v_n = closed[k].v_n,
                           .w_n = closed[k].w_n,
                           .grid = meeting.grid});
      }
    });
    solver_.apply_solid_bcs(t, values_);
  }

  const Setup& setup_;
  L law_;
  CaseData<L> data_;
  SolidSolver<L> solver_;
  std::vector<Meeting> meetings_;
  SolidInterface interface_;             ///< memory that is used again every step
  std::vector<InterfaceValues> values_;  ///< the same
};

}  // namespace fsi::solid
