#pragma once
/// Does round-off grow? A uniformly strained body with noise in all unknowns, on cells of any aspect ratio:
/// the exact motion keeps its energy, so v and P may ring, but not grow.

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "solid_solver/boundary/every_boundary.hpp"
#include "tests/convergence/solid/solvers.hpp"

namespace fsi::solid::test {

struct NoiseCase {
  Tensor2 F = {1, 0, 0, 1};
  double lambda = 1;  ///< over mu
  double aspect = 1;  ///< height of a cell over its width
  double beta_P = 0, beta_u = 0, beta_r = 0;
  double cfl = 0.9;
  /// Sides under the stress of the strained body as a dead load; the others are held.
  std::array<bool, 4> loaded = {};
  double bend = 0;  ///< angle of the arc that the block's lower side is of; the body has to be at rest [rad]
  bool given = false;  ///< all of the strained body's state at sides and ghost points
};

inline constexpr int noise_cells = 12;

inline Boundaries noise_boundaries(const NoiseCase& noise, const Tensor2& P) {
  const Tensor2 F = noise.F;
  Boundaries boundaries;
  for (Boundary& boundary : boundaries) {
    if (noise.given) {
      boundary.condition = Dirichlet::condition;
      boundary.state = [F, P](double x, double y, double) {
        return SolidState{
            .u = {(F.a11 - 1) * x + F.a12 * y, F.a21 * x + (F.a22 - 1) * y}, .v = Vec2::Zero(), .P = P};
      };
      continue;
    }
    boundary.condition = Displacement::condition;
    boundary.vector = [F](double x, double y, double) -> Vec2 {
      return {(F.a11 - 1) * x + F.a12 * y, F.a21 * x + (F.a22 - 1) * y};
    };
  }
  const std::array<Vec2, 4> load = {Vec2(-P.a11, -P.a12), Vec2(P.a11, P.a12), Vec2(-P.a21, -P.a22),
                                    Vec2(P.a21, P.a22)};
  for (std::size_t side = 0; side < 4; ++side) {
    if (!noise.loaded[side]) continue;
    boundaries[side] = {.condition = Traction::condition, .load = LoadConfiguration::reference};
    boundaries[side].vector = [at = load[side]](double, double, double) { return at; };
  }
  return boundaries;
}

/// Largest deviation of v and P from the strained body at rest.
inline double deviation(ConstFieldView q, const Tensor2& P) {
  double largest = 0;
  for (int j = 0; j < q.layout.n2; ++j) {
    for (int i = 0; i < q.layout.n1; ++i) {
      const SolidState s = load(q, q.layout.at(i, j));
      for (const double d :
           {s.v.x(), s.v.y(), s.P.a11 - P.a11, s.P.a12 - P.a12, s.P.a21 - P.a21, s.P.a22 - P.a22}) {
        largest = std::isfinite(d) ? std::max(largest, std::abs(d)) : HUGE_VAL;
      }
    }
  }
  return largest;
}

/// Adds noise of the size 1e-9 in strain, velocity and stress,
/// far above round-off and far below what a law would notice.
inline void add_noise(FieldView q, double h) {
  std::mt19937_64 random(7);
  const auto draw = [&] { return 1e-9 * (2.0 * static_cast<double>(random() >> 11) * 0x1p-53 - 1.0); };
  for (int j = 1; j + 1 < q.layout.n2; ++j) {
    for (int i = 1; i + 1 < q.layout.n1; ++i) {
      for (int k = 0; k < plane::count; ++k) q(k, i, j) += draw() * (k <= plane::u2 ? h : 1.0);
    }
  }
}

/// Largest deviation of v and P after `steps` steps, relative to the largest in the first hundred; infinite
/// where the solution diverges.
template <class L>
double growth_of_noise(const NoiseCase& noise, int steps) {
  const L law{.lambda = noise.lambda, .mu = 1};
  const Tensor2 F = noise.F, P = law.P(F);
  const double h1 = 1.0 / noise_cells, h2 = noise.aspect * h1;
  SolidSolver<L> solver(grid::MovingGrid({.name = "body",
                                          .n1 = noise_cells + 1,
                                          .n2 = noise_cells + 1,
                                          .mapping = [height = noise.aspect, bend = noise.bend](
                                                         double r, double s, double) -> Vec2 {
                                            if (bend == 0) return {r, height * s};
                                            const double radius = 1.0 / bend + height * s, angle = bend * r;
                                            return {radius * std::sin(angle), radius * std::cos(angle)};
                                          }},
                                         0),
                        law,
                        {.rho = 1,
                         .tangential_stress = {.scaled = noise.beta_P},
                         .displacement = {.scaled = noise.beta_u},
                         .relaxation = {.scaled = noise.beta_r},
                         .cfl = noise.cfl},
                        noise_boundaries(noise, P), 0);
  solver.assign_initial_conditions([&](double x, double y, double) {
    return SolidState{
        .u = {(F.a11 - 1) * x + F.a12 * y, F.a21 * x + (F.a22 - 1) * y}, .v = Vec2::Zero(), .P = P};
  });
  add_noise(solver.state(), std::min(h1, h2));
  solver.apply_solid_bcs(0);
  double first = 0, last = 0, t = 0;
  try {
    for (int step = 0; step < steps; ++step) {
      const double dt = solver.compute_time_step().dt;
      solver.advance_solid(t, dt);
      t += dt;
      solver.apply_solid_bcs(t);
      if (step < 100) first = std::max(first, deviation(solver.state(), P));
      if (step >= steps - 100) last = std::max(last, deviation(solver.state(), P));
      if (step % 500 == 499 && deviation(solver.state(), P) > 1e4 * first) return HUGE_VAL;
    }
  } catch (const Diverged&) {
    return HUGE_VAL;
  }
  return last / first;
}

}  // namespace fsi::solid::test
