#pragma once
/// SolidComponent: which point broke in a step, and why.

#include <cmath>
#include <optional>
#include <string>

#include "solid_solver/solid_component.hpp"

namespace fsi::solid {

template <Law L>
std::optional<Diverged> SolidComponent<L>::breakdown(double dt) const {
  const ConstFieldView x = grid_.x();
  for (int j = 0; j < layout().n2; ++j) {
    if (!rows_.owns(j)) continue;
    for (const auto& [begin, end] : points_.discretised(j)) {
      for (int i = begin; i < end; ++i) {
        const std::string what = breakdown_at(i, j, dt);
        if (what.empty()) continue;
        return Diverged(what, {.grid = grid_.name(),
                               .point = {i, j},
                               .position = {x(0, i, j), x(1, i, j)},
                               .of_reference = true});
      }
    }
  }
  return std::nullopt;
}

template <Law L>
std::string SolidComponent<L>::breakdown_at(int i, int j, double dt) const {
  const StateRows rows(q_.view(), j);
  const PointMetrics m = metrics_.at(i, j);
  const Pair d1 = displacement_difference(rows.u1, rows.v1, i, 0.5 * dt),
             d2 = displacement_difference(rows.u2, rows.v2, i, 0.5 * dt);
  const Tensor2 F = plus_dyad(plus_dyad({1.0, 0.0, 0.0, 1.0}, {d1.x, d2.x}, m.r1), {d1.y, d2.y}, m.r2);
  const Stiffness K = law_.K(F);
  const double J = determinant(F);
  const double phi_s = std::min(wave_eigenvalues(acoustic_matrix(K, m.r1.normalized())).y,
                                wave_eigenvalues(acoustic_matrix(K, m.r2.normalized())).y);
  if constexpr (requires { L::end_of_law; }) {
    if (std::isnan(J) || (J > 0 && std::isnan(law_.psi(F))))
      return fmt::format("det F = {:.4g}: {}", J, L::end_of_law);
  }
  if (!(J > 0)) return fmt::format("det F = {:.4g}", J);
  if (phi_s > 0) return {};
  const std::string lost = fmt::format("no longer hyperbolic, phi_s = {:.4g}", phi_s);
  if constexpr (Softens<L>) return fmt::format("{}: {}", lost, L::where_soft);
  return lost;
}

}  // namespace fsi::solid
