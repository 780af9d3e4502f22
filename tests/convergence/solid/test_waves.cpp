// Plane waves of small amplitude in a stretched solid.

#include <gtest/gtest.h>

#include "solid_solver/boundary/every_boundary.hpp"
#include "tests/convergence/solid/errors_in_time.hpp"
#include "tests/convergence/solid/skewed_grid.hpp"
#include "tests/convergence/solid/solvers.hpp"

namespace fsi::solid::test {
namespace {

constexpr double amplitude = 1e-6;  // its square is below the truncation error
constexpr double wave_number = 6;
constexpr double density = 1.3;
constexpr Tensor2 stretched = {1.2, 0.0, 0.0, 0.95};

/// Wave along x with displacement along `axis` (0: p, 1: s) on top of a homogeneous stretch. Its speed
/// follows from the slope of the law's stress curve: rho c^2 = dP_1k / dF_k1.
template <class L>
StateFunction plane_wave(const L& law, int axis) {
  const double d = 1e-4;
  Tensor2 more = stretched, less = stretched;
  (axis == 0 ? more.a11 : more.a21) += d;
  (axis == 0 ? less.a11 : less.a21) -= d;
  const double slope = axis == 0 ? (law.P(more).a11 - law.P(less).a11) / (2 * d)
                                 : (law.P(more).a12 - law.P(less).a12) / (2 * d);
  const double c = std::sqrt(slope / density);
  return [=](double x, double y, double t) {
    const double phase = wave_number * (x - c * t), du = amplitude * wave_number * std::cos(phase);
    SolidState s;
    s.u = Vec2((stretched.a11 - 1) * x, (stretched.a22 - 1) * y);
    s.u[axis] += amplitude * std::sin(phase);
    s.v[axis] = -c * du;
    Tensor2 F = stretched;
    (axis == 0 ? F.a11 : F.a21) += du;
    s.P = law.P(F);
    return s;
  };
}

template <class L>
Errors run(int axis, int cells) {
  constexpr double t_end = 0.4;
  const L law{.lambda = 1.5, .mu = 0.8};
  const StateFunction exact = plane_wave(law, axis);
  Boundaries boundaries;
  for (Boundary& boundary : boundaries) {
    boundary.condition = Dirichlet::condition;
    boundary.state = exact;
  }
  SolidSolver<L> solver(unit_square(cells), law, {.rho = density}, boundaries, 0);
  solver.assign_initial_conditions(exact);
  double t = 0;
  advance_to(solver, t, t_end);
  return solver.errors(exact, t);
}

template <class L>
class Eq4PlaneWaves : public testing::Test {};
using Laws = testing::Types<LinearElastic, SaintVenantKirchhoff, NeoHookean>;
TYPED_TEST_SUITE(Eq4PlaneWaves, Laws);

TYPED_TEST(Eq4PlaneWaves, TravelThroughAStretchedSolidAtTheSpeedOfItsStressCurve) {
  for (const int axis : {0, 1}) {
    const Errors coarse = run<TypeParam>(axis, 24), fine = run<TypeParam>(axis, 48);
    EXPECT_GE(std::log2(coarse.v / fine.v), 1.9) << axis << " " << coarse.v << " " << fine.v;
    EXPECT_LT(fine.v, 0.02 * amplitude * wave_number);  // of a velocity of about c k amplitude
    EXPECT_LT(fine.u, 0.02 * amplitude);
  }
}

}  // namespace
}  // namespace fsi::solid::test
