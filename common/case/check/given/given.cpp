#include "common/case/check/given/given.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "common/case/check/check_ends.hpp"
#include "common/case/document/node_at.hpp"
#include "common/case/schema/law_numbers.hpp"

namespace fsi {

namespace {

/// Whether P(F) of the solid's law is finite.
bool has_stress(const SolidSpec& solid, const Mat2& F) {
  bool finite = true;
  schema::for_every_law([&]<class L>() {
    if (L::name != solid.law) return;
    const L law = solid::law_with<L>(solid.lambda, solid.mu, solid.data);
    const auto P = law.P({.a11 = F(0, 0), .a12 = F(0, 1), .a21 = F(1, 0), .a22 = F(1, 1)});
    finite = std::isfinite(P.a11 + P.a12 + P.a21 + P.a22);
  });
  return finite;
}

}  // namespace

int times_of_known_places(const FluidSpec& fluid, Side side) {
  const auto meets_solid = [&](Side other) {
    return fluid.boundary[static_cast<std::size_t>(other)].kind == BoundaryKind::interface;
  };
  return meets_solid(side) || std::ranges::any_of(sides_beside(side), meets_solid) ? 1 : looked_at_times;
}

int times_of_known_values(const FluidSpec& fluid, Side side, const GasExpressions& given) {
  const auto depends_on_place = [](const Expression* formula) {
    return formula->uses("x") || formula->uses("y") || formula->uses("r");
  };
  const std::array formulas{&given.rho, &given.v1, &given.v2, &given.p};
  return std::ranges::any_of(formulas, depends_on_place) ? times_of_known_places(fluid, side)
                                                         : looked_at_times;
}

std::vector<GivenOnCurve> given_on_curves(const FluidSpec& fluid, const config::Node& node) {
  std::vector<GivenOnCurve> given;
  for (std::size_t k = 0; k < fluid.body_fitted.size(); ++k) {
    const BodyFittedSpec& fitted = fluid.body_fitted[k];
    const BoundarySpec& spec = fitted.boundary[static_cast<std::size_t>(fitted.side)];
    if (!spec.from_reference && !spec.state && spec.fields.empty() && spec.vectors.empty()) continue;
    given.push_back({.spec = spec,
                     .node = node_at(node_at(node, {"body_fitted"}).items[k], {"boundary"}),
                     .path = fmt::format("{}.body_fitted[{}].boundary", fluid.path, k),
                     .points = curve_points(fluid, k)});
  }
  return given;
}

GivenVector given_by(const VectorExpressions& formulas) {
  return [formulas](const Vec2& x, double t) {
    return Vec2(formulas.c1(x[0], x[1], t), formulas.c2(x[0], x[1], t));
  };
}

std::shared_ptr<const exact::Solution> exact_reference(const ReferenceSpec& reference) {
  if (reference.kind == ReferenceKind::none || reference.in_formulas() || reference.computed())
    return nullptr;
  return exact::make_solution(reference.kind, reference.numbers, "");
}

GivenGas reference_gas(const ReferenceSpec& reference) {
  if (reference.fluid) {
    return [state = *reference.fluid](const Vec2& x, double t) {
      return exact::GasState{.rho = state.rho(x[0], x[1], t),
                             .v1 = state.v1(x[0], x[1], t),
                             .v2 = state.v2(x[0], x[1], t),
                             .p = state.p(x[0], x[1], t)};
    };
  }
  const auto solution = exact_reference(reference);
  if (!solution) return {};
  return [solution](const Vec2& x, double t) { return solution->gas(x[0], x[1], t); };
}

GivenVector reference_displacement(const ReferenceSpec& reference) {
  if (reference.u) return given_by(*reference.u);
  const auto solution = exact_reference(reference);
  if (!solution) return {};
  return [solution](const Vec2& x, double t) { return solution->solid(x[0], x[1], t).u; };
}

GivenVector initial_displacement(const Case& problem, const SolidSpec& solid) {
  if (solid.initial_from_reference) return reference_displacement(problem.reference);
  if (solid.initial_u) return given_by(*solid.initial_u);
  return [](const Vec2&, double) { return Vec2(Vec2::Zero()); };
}

Mat2 deformation_gradient(const BodyCell& cell, const GivenVector& u, double t) {
  Mat2 edges, moved;
  edges << cell.edge1, cell.edge2;
  const Vec2 u_0 = u(cell.x, t);
  moved << u(cell.x + cell.edge1, t) - u_0, u(cell.x + cell.edge2, t) - u_0;
  return Mat2::Identity() + moved * edges.inverse();
}

std::string unbearable(const SolidSpec& solid, const Mat2& F) {
  const double J = F.determinant();
  if (!(J > 0)) return fmt::format("turns the material inside out (det F = {:.3g})", J);
  if (has_stress(solid, F)) return "";
  return fmt::format(
      "strains the material more than the law `{}` bears (F = [{:.3g}, {:.3g}, {:.3g}, {:.3g}])", solid.law,
      F(0, 0), F(0, 1), F(1, 0), F(1, 1));
}

}  // namespace fsi
