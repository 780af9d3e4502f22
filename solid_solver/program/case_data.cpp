#include "solid_solver/program/case_data.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "common/case/scales.hpp"
#include "common/core/failure.hpp"
#include "common/program/grid_from_case.hpp"
#include "common/program/reference_from_case.hpp"
#include "solid_solver/boundary/every_boundary.hpp"
#include "solid_solver/boundary/side_data.hpp"

namespace fsi::solid {

namespace {

VectorFunction function_of(const VectorExpressions& vector) {
  return [vector](double x, double y, double t) { return Vec2(vector.c1(x, y, t), vector.c2(x, y, t)); };
}

TensorFunction function_of(const TensorExpressions& P) {
  return [P](double x, double y, double t) -> Tensor2 {
    return {P.c11(x, y, t), P.c12(x, y, t), P.c21(x, y, t), P.c22(x, y, t)};
  };
}

VectorFunction at_rest() {
  return [](double, double, double) -> Vec2 { return Vec2::Zero(); };
}

}  // namespace

grid::Curve curve_along(const grid::MovingGrid& grid, Side side) {
  return grid.periodic(1 - direction_of(side)) ? grid::Curve::closed : grid::Curve::open;
}

CaseData::CaseData(const Setup& setup, const SolidSpec& spec, AnyLaw law)
    : spec_(spec),
      crossing_time_(crossing_time_of(spec)),
      cfl_(setup.problem.time.cfl),
      solution_(reference_from_case(setup.problem, setup.run_dir)) {
  const ReferenceSpec& reference = setup.problem.reference;
  if (reference.u) {
    ChosenFields fields{.u = function_of(*reference.u)};
    if (reference.v) fields.v = function_of(*reference.v);
    if (reference.P) fields.P = function_of(*reference.P);
    manufactured_ =
        std::make_shared<Manufactured>(std::move(fields), std::move(law), spec.rho, size_of(spec.grid));
    if (reference.kind == ReferenceKind::manufactured) {
      chosen_ = reference.v || reference.P || reference.fluid;
      forced_ = !chosen_;
    }
  } else if (reference.in_formulas()) {
    solution_ = nullptr;  // formulas for the gas only
  }
}

std::vector<SolidPart> CaseData::parts() const {
  std::vector<SolidPart> all;
  all.push_back(part(grid_from_case(spec_.grid, false), spec_.boundary));
  for (const BodyFittedSpec& fitted : fitted_grids(spec_))
    all.push_back(part(grid_from_case(fitted), fitted.boundary));
  return all;
}

SolidOptions CaseData::options() const {
  const SolidScheme& scheme = spec_.scheme;
  const auto beta = [](const fsi::Beta& b) { return Beta{.rate = b.rate, .scaled = b.scaled}; };
  return {.rho = spec_.rho,
          .limiter = scheme.limiter,
          .tangential_stress = beta(scheme.tangential_stress),
          .displacement = beta(scheme.displacement),
          .relaxation = beta(scheme.relaxation),
          .bulk_diffusion = scheme.bulk_diffusion,
          .cfl = cfl_};
}

StateFunction CaseData::reference_state() const {
  if (manufactured_) {
    return [m = manufactured_](double x, double y, double t) { return m->state(x, y, t); };
  }
  if (!solution_) return {};
  return [s = solution_](double x, double y, double t) {
    const exact::SolidState q = s->solid(x, y, t);
    return SolidState{.u = q.u, .v = q.v, .P = {q.P(0, 0), q.P(0, 1), q.P(1, 0), q.P(1, 1)}};
  };
}

StateFunction CaseData::initial_state() const {
  return spec_.initial_from_reference ? reference_state() : StateFunction{};
}

VectorFunction CaseData::initial_displacement() const {
  return spec_.initial_u ? function_of(*spec_.initial_u) : at_rest();
}

VectorFunction CaseData::initial_velocity() const {
  return spec_.initial_v ? function_of(*spec_.initial_v) : at_rest();
}

std::optional<ChosenSolution> CaseData::chosen_solution() const {
  if (!chosen_) return std::nullopt;
  const auto& m = manufactured_;
  return ChosenSolution{.state = reference_state(),
                        .source = [m](double x, double y, double t) { return m->source(x, y, t); },
                        .offset = [m](double x, double y, double t) { return m->offset(x, y, t); }};
}

VectorFunction CaseData::body_force() const {
  if (chosen_) return {};
  if (forced_) {
    return [m = manufactured_](double x, double y, double t) { return m->body_force(x, y, t); };
  }
  return spec_.body_force ? function_of(*spec_.body_force) : VectorFunction{};
}

SolidPart CaseData::part(grid::GridDescription description, const std::array<BoundarySpec, 4>& specs) const {
  SolidPart result{.grid = grid::MovingGrid(std::move(description), 0), .boundaries = {}};
  for (const Side side : all_sides) {
    const auto k = static_cast<std::size_t>(side);
    result.boundaries[k] = boundary(specs[k], side, result.grid);
  }
  return result;
}

Boundary CaseData::boundary(const BoundarySpec& spec, Side side, const grid::MovingGrid& grid) const {
  SideData data{.from_reference = spec.from_reference,
                .time_scale = crossing_time_,
                .numbers = spec.numbers,
                .exact = [&] { return required_reference(side); },
                .exact_traction = [&] { return reference_traction(spec, side, grid); }};
  if (spec.vector) data.value = function_of(*spec.vector);
  if (spec.velocity) data.velocity = function_of(*spec.velocity);
  for (const auto& [key, vector] : spec.vectors) data.vectors[key] = function_of(vector);
  for (const auto& [key, field] : spec.fields)
    data.fields[key] = [field](double x, double y, double t) { return field(x, y, t); };
  std::optional<Boundary> result = boundary_from(spec.kind, data);
  if (!result)
    throw UserMistake(
        fmt::format("solid \"{}\": boundary {} has a condition for gases", spec_.name, name_of(side)));
  result->load = spec.load;
  return *std::move(result);
}

StateFunction CaseData::required_reference(Side side) const {
  StateFunction exact = reference_state();
  if (!exact) {
    throw UserMistake(
        fmt::format("solid \"{}\": boundary {} takes its data from the reference, but the case has none; "
                    "add a section reference",
                    spec_.name, name_of(side)));
  }
  return exact;
}

/// Traction of the reference solution per unit current area:
/// eta n0^T P with eta = 1 / |F t0|, paper eq. (13).
VectorFunction CaseData::reference_traction(const BoundarySpec& spec, Side side,
                                            const grid::MovingGrid& grid) const {
  if (!manufactured_)
    throw UserMistake(
        fmt::format("solid \"{}\": traction from the reference needs its displacement u", spec_.name));
  auto x = grid.side_points(side);
  auto n = grid::normals(x, curve_along(grid, side), grid::outward(side));
  const bool on_reference = spec.load == LoadConfiguration::reference;
  return [=, m = manufactured_, x = std::move(x), n = std::move(n)](double x1, double x2, double t) -> Vec2 {
    const std::size_t count = x.size() / 2;
    std::size_t nearest = 0;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < count; ++k) {
      const double d1 = x[k] - x1, d2 = x[count + k] - x2, squared = d1 * d1 + d2 * d2;
      if (squared < best) {
        best = squared;
        nearest = k;
      }
    }
    const double n1 = n[nearest], n2 = n[count + nearest];
    const Tensor2 F = m->deformation_gradient(x1, x2, t);
    const Tensor2 P = m->stress(x1, x2, t);
    const double stretch = std::hypot(-F.a11 * n2 + F.a12 * n1, -F.a21 * n2 + F.a22 * n1);
    const double eta = on_reference ? 1 : 1 / stretch;
    return {eta * (n1 * P.a11 + n2 * P.a21), eta * (n1 * P.a12 + n2 * P.a22)};
  };
}

}  // namespace fsi::solid
