#include "solid_solver/program/body.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "common/case/grids/block.hpp"
#include "common/case/grids/composite_from_case.hpp"
#include "common/grid/geometry/interface_geometry.hpp"
#include "common/program/grid_from_case.hpp"
#include "common/wire/messages.hpp"

namespace fsi::solid {

namespace {

LawNumbers numbers_of(const SolidSpec& spec) {
  return {.lambda = spec.lambda, .mu = spec.mu, .own = spec.data};
}

}  // namespace

SolidBody::SolidBody(const Setup& setup, const SolidSpec& spec, const LawKind& law)
    : data_(setup, spec, law.law(numbers_of(spec))),
      solver_(law.solver(data_.parts(), bodies_of(fitted_grids(spec)), numbers_of(spec), data_.options())) {
  if (is_block(spec)) {
    find_outline(spec);
  } else {
    find_interface(spec, 0, spec.boundary);
    for (const BodyFittedSpec& fitted : spec.body_fitted) find_interface(spec, 1, fitted.boundary);
  }
  if (const VectorFunction force = data_.body_force()) solver_->set_body_force(force);
  if (const auto solution = data_.chosen_solution()) solver_->choose(*solution);
  if (const StateFunction initial = data_.initial_state()) {
    solver_->assign_initial_conditions(initial);
  } else {
    solver_->assign_initial_conditions(data_.initial_displacement(), data_.initial_velocity());
  }
}

void SolidBody::apply_bcs(double t, std::span<const Answer> answers) {
  values_.clear();
  for (std::size_t k = 0; k < answers.size(); ++k) {
    const auto& [n, v_n, w_n, gas] = answers[k];
    tell(meetings_[k], {.n = n, .v_n = v_n, .w_n = w_n});
  }
  solver_->apply_solid_bcs(t, values_);
}

void SolidBody::advance(double t, double dt, int substeps, std::span<const Answer> answers, const Lap& lap) {
  const double dt_sub = dt / substeps;
  for (int k = 0; k < substeps; ++k) {
    const double t_k = t + k * dt_sub;
    const bool last = k + 1 == substeps;
    solver_->advance_solid(t_k, dt_sub, last ? Look::all : Look::soundness);
    if (last) break;
    lap(io::Work::advance);
    close_substep(t_k + dt_sub, answers);
    lap(io::Work::boundary);
  }
}

void SolidBody::show(const Meeting& meeting, SolidInterface& state) const {
  if (meeting.is_side()) return solver_->interface_state(meeting.side(), state, meeting.grid);
  const std::span<const Stretch> stretches = meeting.along.stretches();
  sides_.resize(stretches.size());
  for (std::size_t k = 0; k < stretches.size(); ++k)
    solver_->interface_state(stretches[k].side, sides_[k], meeting.grid);
  meeting.along.join(sides_, state);
}

std::vector<double> SolidBody::reference_points(const Meeting& meeting) const {
  const grid::MovingGrid& grid = solver_->grid(meeting.grid);
  if (meeting.is_side()) return grid.side_points(meeting.side());
  std::vector<std::vector<double>> x;
  for (const Stretch& stretch : meeting.along.stretches()) x.push_back(grid.side_points(stretch.side));
  std::vector<double> all(2 * meeting.along.points());
  meeting.along.put_together(std::vector<std::span<const double>>(x.begin(), x.end()), all);
  return all;
}

SideLoad SolidBody::load(const Meeting& meeting) const {
  const std::span<const Stretch> stretches = meeting.along.stretches();
  SideLoad sum = solver_->side_load(stretches.front().side, meeting.grid);
  for (const Stretch& stretch : stretches.subspan(1)) sum += solver_->side_load(stretch.side, meeting.grid);
  return sum;
}

std::vector<double> SolidBody::normals(const Meeting& meeting, std::span<const double> x,
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

void SolidBody::find_interface(const SolidSpec& spec, int grid, const std::array<BoundarySpec, 4>& boundary) {
  for (const Side side : all_sides) {
    if (boundary[static_cast<std::size_t>(side)].kind != BoundaryKind::interface) continue;
    const std::string& fluid = boundary[static_cast<std::size_t>(side)].fluid;
    const int points = solver_->grid(grid).side_size(side);
    meetings_.push_back(
        {.along = {{{.side = side}}, {points}, false}, .grid = grid, .name = interface_name(spec, fluid)});
  }
}

void SolidBody::find_outline(const SolidSpec& spec) {
  const BodyFittedSpec& outline = spec.body_fitted.front();
  const BoundarySpec& condition = outline.boundary[static_cast<std::size_t>(outline.side)];
  if (condition.kind != BoundaryKind::interface) return;
  std::vector<Stretch> stretches;
  std::vector<int> points;
  for (const Side side : sides_along(outline.curve)) {
    stretches.push_back({.side = side, .against = runs_against_outline(side)});
    points.push_back(solver_->grid(0).side_size(side));
  }
  meetings_.push_back({.along = {std::move(stretches), points, outline.curve.closed()},
                       .grid = 0,
                       .name = interface_name(spec, condition.fluid)});
}

std::vector<double> SolidBody::unturned_normals(const Meeting& meeting, std::span<const double> x) const {
  if (meeting.is_side()) {
    const grid::Curve curve = curve_along(solver_->grid(meeting.grid), meeting.side());
    return grid::normals(x, curve, grid::outward(meeting.side()));
  }
  constexpr double to_the_right = 1;
  return grid::normals(x, meeting.along.closed() ? grid::Curve::closed : grid::Curve::open, to_the_right);
}

Vec2 SolidBody::along_wall(const Meeting& meeting, bool first) const {
  const Stretch& stretch = first ? meeting.along.stretches().front() : meeting.along.stretches().back();
  const bool at_begin = first != stretch.against;
  const int k = at_begin ? 0 : solver_->grid(meeting.grid).side_size(stretch.side) - 1;
  return solver_->along_wall(stretch.side, k, meeting.grid);
}

void SolidBody::tell(Meeting& meeting, InterfaceValues values) {
  values.grid = meeting.grid;
  values.side = meeting.side();
  if (meeting.is_side()) {
    values_.push_back(values);
  } else {
    meeting.along.split(values, values_);
  }
}

bool SolidBody::shows(const Meeting& meeting) const {
  return !meeting.is_side() || solver_->shows(meeting.side(), meeting.grid);
}

void SolidBody::close_substep(double t, std::span<const Answer> answers) {
  std::vector<std::vector<double>> normal(answers.size());
  std::vector<ClosedInterface> closed(answers.size());
  values_.clear();
  solver_->together().attempt([&] {
    for (std::size_t k = 0; k < answers.size(); ++k) {
      Meeting& meeting = meetings_[k];
      if (!shows(meeting)) continue;
      show(meeting, interface_);
      normal[k] = normals(meeting, interface_.x, interface_.fixed);
      closed[k] = close_with_robin(answers[k].gas, t, normal[k], interface_);
      tell(meeting, {.n = normal[k], .v_n = closed[k].v_n, .w_n = closed[k].w_n});
    }
  });
  solver_->apply_solid_bcs(t, values_);
}

}  // namespace fsi::solid
