// A clamped beam of a neo-Hookean solid, ten times longer than thick, against beam theory in plane strain:
//
//      | --> load          E' I w'''' + rho A w'' = 0 while it bends little,
//      |                   E' I theta'' = -load cos(theta), the elastica, under an end load of any size
//      |
//     ===  clamped at y = 0
//
// With lambda = mu, E' = E / (1 - nu^2) = 8/3 mu.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "solid_solver/boundary/every_boundary.hpp"
#include "tests/convergence/solid/solvers.hpp"

namespace fsi::solid::test {
namespace {

constexpr double thickness = 0.1, rho = 1, mu = 1;
constexpr double bending = 8.0 / 3.0 * mu * thickness * thickness * thickness / 12;
constexpr double beta = 1.8751040687, sigma = 0.7340955138;  // first mode of a clamped beam
const double omega = beta * beta * std::sqrt(bending / (rho * thickness));

/// Deflection of the mode, 1 at the end.
double mode(double y) {
  return 0.5 *
         (std::cosh(beta * y) - std::cos(beta * y) - sigma * (std::sinh(beta * y) - std::sin(beta * y)));
}
double mode_slope(double y) {
  return 0.5 * beta *
         (std::sinh(beta * y) + std::sin(beta * y) - sigma * (std::cosh(beta * y) - std::cos(beta * y)));
}

grid::MovingGrid upright(int cells_across) {
  return {{.name = "beam",
           .n1 = cells_across + 1,
           .n2 = 10 * cells_across + 1,
           .mapping = [](double r, double s, double) -> Vec2 {
             return {thickness * (r - 0.5), s};
           }},
          0};
}

/// Clamped at its bottom; `load` per unit area of the undeformed top.
Boundaries clamped(VectorFunction load = {}) {
  Boundaries boundaries;
  boundaries[static_cast<std::size_t>(Side::bottom)].condition = Displacement::condition;
  boundaries[static_cast<std::size_t>(Side::top)].vector = std::move(load);
  boundaries[static_cast<std::size_t>(Side::top)].load = LoadConfiguration::reference;
  return boundaries;
}

/// The scheme of configs/beam.yaml.
constexpr SolidOptions options = {.rho = rho,
                                  .tangential_stress = {.scaled = 0.5},
                                  .displacement = {.scaled = 0.5},
                                  .relaxation = {.scaled = 0.2}};

using Solver = SolidSolver<NeoHookean>;

Vec2 at_rest(double, double, double) {
  return {0, 0};
}

SolidState end_of(const Solver& solver, int cells) {
  return load(solver.state(), solver.state().layout.at(cells / 2, 10 * cells));
}

struct Swing {
  double omega;         ///< from the time at which the end turns round
  double energy_drift;  ///< until then, part of the initial energy
};

/// From the straight beam, with the velocity of the mode that brings its end to `amplitude`, until it stands still.
Swing swing(int cells, double amplitude = 1e-3, Limiter limiter = Limiter::none) {
  const double v_0 = amplitude * omega;
  SolidOptions limited = options;
  limited.limiter = limiter;
  Solver solver(upright(cells), {.lambda = mu, .mu = mu}, limited, clamped(), 0);
  solver.assign_initial_conditions(at_rest, [&](double x, double y, double) -> Vec2 {
    return {v_0 * mode(y), -v_0 * x * mode_slope(y)};
  });
  const double energy = solver.totals().energy();
  double t = 0, v_before = v_0, dt = 0;
  double v = v_0;
  while (v > 0) {
    v_before = v;
    dt = solver.compute_time_step().dt;
    solver.advance_solid(t, dt);
    t += dt;
    solver.apply_solid_bcs(t);
    v = end_of(solver, cells).v.x();
  }
  const double turn = t - dt * v / (v - v_before);
  return {.omega = 0.5 * std::numbers::pi / turn, .energy_drift = solver.totals().energy() / energy - 1};
}

/// Limit of a quantity with an error of second order, from two grids whose spacings are as 3 to 2.
double limit(double coarse, double fine) {
  return fine + (fine - coarse) / (1.5 * 1.5 - 1);
}

TEST(ClampedBeam, SwingsAtTheFrequencyOfBeamTheoryAndConvergesAtSecondOrder) {
  const Swing coarse = swing(4), middle = swing(6), fine = swing(9);
  const double rate = std::log((coarse.omega - middle.omega) / (middle.omega - fine.omega)) / std::log(1.5);
  EXPECT_NEAR(rate, 2, 0.25);
  EXPECT_NEAR(fine.omega, omega, 0.015 * omega);
  // Shear and rotary inertia slow a beam of this thickness by 0.4 %, the corners at the clamp by less.
  EXPECT_NEAR(limit(middle.omega, fine.omega), omega, 0.008 * omega);
  EXPECT_LT(std::abs(fine.energy_drift), 0.05);
  EXPECT_LT(std::abs(fine.energy_drift), 0.5 * std::abs(middle.energy_drift));  // second order: 0.44
}

/// A bent beam has a parabola across it, of the shear stress and of its own width; with four cells the top of it lies two points from
/// either side. When the beam turns, the parabolas lean.
TEST(ClampedBeam, SwingsWithALimiterAsFastAsWithout) {
  for (const double amplitude : {1e-3, 0.02, 0.05, 0.1}) {
    const double free = swing(4, amplitude).omega;
    EXPECT_NEAR(swing(4, amplitude, Limiter::mc).omega, free, 0.012 * free) << amplitude;
    EXPECT_NEAR(swing(4, amplitude, Limiter::minmod).omega, free, 0.03 * free) << amplitude;
  }
}

/// Deflection of the elastica's end for load L^2 / (E' I)
/// = alpha, by shooting for the curvature at the clamp.
Vec2 elastica(double alpha) {
  constexpr int steps = 2000;
  Vec2 end = Vec2::Zero();
  const auto curvature_at_end = [&](double start) {
    double theta = 0, curvature = start;
    end = Vec2(0, -1);
    for (int k = 0; k < steps; ++k) {
      const double ds = 1.0 / steps, half = theta + 0.5 * ds * curvature;
      const double mid = curvature - 0.5 * ds * alpha * std::cos(theta);
      theta += ds * mid;
      curvature -= ds * alpha * std::cos(half);
      end += ds * Vec2(std::sin(half), std::cos(half));
    }
    return curvature;
  };
  double low = 0, high = alpha;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (curvature_at_end(middle) < 0 ? low : high) = middle;
  }
  return end;
}

/// Takes a part of all velocities away.
void slow_down(FieldView q, double part) {
  for (const int k : {plane::v1, plane::v2}) {
    double* v = q.plane(k);
    for (std::size_t i = 0; i < q.layout.plane_size(); ++i) v[i] *= 1 - part;
  }
}

/// Deflection of the end at rest, by a drag with 0.9 of the critical damping of the first mode.
Vec2 deflection_on(double alpha, int cells) {
  const double traction = alpha * bending / thickness;
  Solver solver(upright(cells), {.lambda = mu, .mu = mu}, options,
                clamped([=](double, double, double) -> Vec2 {
                  return {traction, 0};
                }),
                0);
  solver.assign_initial_conditions(at_rest, at_rest);
  for (double t = 0; t < 6.5 / omega;) {
    const double dt = solver.compute_time_step().dt;
    solver.advance_solid(t, dt);
    t += dt;
    slow_down(solver.state(), 1.8 * omega * dt);
    solver.apply_solid_bcs(t);
  }
  return end_of(solver, cells).u;
}

TEST(ClampedBeam, BendsUnderASmallEndLoadAsBeamTheoryWithShearSays) {
  constexpr double alpha = 0.01, shear_area = 5.0 / 6.0 * thickness;
  const double expected = alpha / 3 + alpha * bending / (mu * shear_area);
  EXPECT_NEAR(deflection_on(alpha, 6).x(), expected, 0.02 * expected);
}

TEST(ClampedBeam, BendsUnderALargeEndLoadAsTheElastica) {
  constexpr double alpha = 2, shear_area = 5.0 / 6.0 * thickness;
  const Vec2 coarse = deflection_on(alpha, 4), fine = deflection_on(alpha, 6), expected = elastica(alpha);
  const double shear = alpha * bending / (mu * shear_area);
  EXPECT_GT(expected.x(), 0.4);  // as far as the beam in the gas
  EXPECT_NEAR(limit(coarse.x(), fine.x()), expected.x() + shear, 0.01 * expected.x());
  EXPECT_NEAR(limit(coarse.y(), fine.y()), expected.y(), 0.02 * std::abs(expected.y()));
}

}  // namespace
}  // namespace fsi::solid::test
