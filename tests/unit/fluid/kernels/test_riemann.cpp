/// Approximate Riemann solvers against what the exact one must do.

#include <gtest/gtest.h>

#include <cmath>
#include <variant>
#include <vector>

#include "fluid_solver/kernels/riemann/every_riemann.hpp"

namespace fsi::fluid {
namespace {

constexpr double gamma = 1.4;
constexpr double round_off = 1e-13;  // a few dozen operations on numbers of order ten

double energy(const FaceState& q) {
  return q.p / (gamma - 1) + 0.5 * q.rho * (q.u * q.u + q.v * q.v);
}

/// Flux of the Euler equations of one state through a face that moves with g_n.
FaceFlux euler_flux(const FaceState& q, double g_n) {
  const double w = q.u - g_n;
  return {q.rho * w, q.rho * w * q.u + q.p, q.rho * w * q.v, energy(q) * w + q.p * q.u};
}

void expect_equal(const FaceFlux& a, const FaceFlux& b, double tolerance) {
  EXPECT_NEAR(a.mass, b.mass, tolerance);
  EXPECT_NEAR(a.normal, b.normal, tolerance);
  EXPECT_NEAR(a.tangential, b.tangential, tolerance);
  EXPECT_NEAR(a.energy, b.energy, tolerance);
}

/// States on both sides of a shock that moves with `speed`
/// through gas `ahead` on its right, at Mach number M.
struct Shock {
  FaceState behind, ahead;
  double speed;
};

Shock shock_into(const FaceState& ahead, double M) {
  const double a = std::sqrt(gamma * ahead.p / ahead.rho);
  return {.behind = {ahead.rho * (gamma + 1) * M * M / ((gamma - 1) * M * M + 2),
                     ahead.u + 2 * a / (gamma + 1) * (M - 1 / M), ahead.v,
                     ahead.p * (1 + 2 * gamma / (gamma + 1) * (M * M - 1))},
          .ahead = ahead,
          .speed = ahead.u + M * a};
}

template <class Solver>
class Eq1RiemannSolver : public testing::Test {
 protected:
  Solver solve = Solver::with({.gamma = gamma, .entropy_fix = 0.1});
};
template <class Variant>
struct TypesOf;
template <class... Solvers>
struct TypesOf<std::variant<Solvers...>> {
  using type = testing::Types<Solvers...>;
};
using EverySolver = TypesOf<AnyRiemann>::type;
TYPED_TEST_SUITE(Eq1RiemannSolver, EverySolver);

TYPED_TEST(Eq1RiemannSolver, GivesTheFluxOfTheStateWhenBothSidesAgree) {
  for (const double g_n : {-3.0, -0.4, 0.0, 0.7, 2.5}) {
    for (const double u : {-2.0, 0.0, 0.3, 1.9}) {
      const FaceState q{1.3, u, -0.6, 0.8};
      expect_equal(this->solve(q, q, g_n), euler_flux(q, g_n), round_off);
    }
  }
}

TYPED_TEST(Eq1RiemannSolver, KeepsAContactThatMovesWithTheFaceSharp) {
  const FaceState L{1.0, 0.4, 0.2, 1.1}, R{0.2, 0.4, -0.7, 1.1};
  const FaceFlux flux = this->solve(L, R, 0.4);
  EXPECT_NEAR(flux.mass, 0, round_off);
  EXPECT_NEAR(flux.normal, 1.1, round_off);
  EXPECT_NEAR(flux.tangential, 0, round_off);
  EXPECT_NEAR(flux.energy, 1.1 * 0.4, round_off);
}

TYPED_TEST(Eq1RiemannSolver, TakesTheSideAContactComesFrom) {
  const FaceState L{1.0, 0.4, 0.2, 1.1}, R{0.2, 0.4, -0.7, 1.1};
  expect_equal(this->solve(L, R, 0.1), euler_flux(L, 0.1), round_off);
  expect_equal(this->solve(L, R, 0.6), euler_flux(R, 0.6), round_off);
}

TYPED_TEST(Eq1RiemannSolver, IsExactForASingleShock) {
  for (const double M : {1.1, 1.3, 2.0, 4.0}) {
    const Shock shock = shock_into({1, -0.3, 0.5, 0.9}, M);
    expect_equal(
        this->solve(shock.behind, shock.ahead, shock.speed - 1e-3),
        euler_flux(shock.behind, shock.speed - 1e-3),
        // the sonic-point fix rounds the shock's own speed off: half its width times the jump at most
        std::is_same_v<TypeParam, RiemannRoe> ? 0.05 * M * M * M * shock.behind.p : 1e-12 * shock.behind.p);
  }
}

TEST(Eq1RiemannRoe, IsExactForASingleShockWithoutSonicPointFix) {
  const RiemannRoe solve{.gamma = gamma, .entropy_fix = 0};
  for (const double M : {1.1, 1.3, 2.0, 4.0}) {
    const Shock shock = shock_into({1, -0.3, 0.5, 0.9}, M);
    for (const double offset : {-0.2, -1e-3, 1e-3, 0.2}) {
      const double g_n = shock.speed + offset;
      expect_equal(solve(shock.behind, shock.ahead, g_n),
                   euler_flux(offset < 0 ? shock.behind : shock.ahead, g_n), 1e-12 * shock.behind.p);
    }
  }
}

TYPED_TEST(Eq1RiemannSolver, IsPureUpwindWhenEverythingLeavesTheFaceBehind) {
  const FaceState L{1.0, 4.0, 0.2, 1.1}, R{0.8, 4.2, -0.7, 0.9};
  expect_equal(this->solve(L, R, 0), euler_flux(L, 0), 1e-12);
  expect_equal(this->solve(L, R, 9), euler_flux(R, 9), 1e-12);
}

TYPED_TEST(Eq1RiemannSolver, DoesNotCareWhoWatches) {  // Galilean invariance: boost u, v and the face
  const FaceState L{1.0, 0.4, 0.2, 1.1}, R{0.5, -0.2, -0.7, 0.6};
  const double U = 0.83, W = -0.37;
  const FaceFlux rest = this->solve(L, R, 0.15);
  const FaceFlux boosted =
      this->solve({L.rho, L.u + U, L.v + W, L.p}, {R.rho, R.u + U, R.v + W, R.p}, 0.15 + U);
  EXPECT_NEAR(boosted.mass, rest.mass, round_off);
  EXPECT_NEAR(boosted.normal, rest.normal + U * rest.mass, round_off);
  EXPECT_NEAR(boosted.tangential, rest.tangential + W * rest.mass, round_off);
  EXPECT_NEAR(boosted.energy,
              rest.energy + U * rest.normal + W * rest.tangential + 0.5 * (U * U + W * W) * rest.mass,
              round_off);
}

TYPED_TEST(Eq1RiemannSolver, MirrorsItsFluxWithItsStates) {
  const FaceState L{1.0, 0.4, 0.2, 1.1}, R{0.5, -0.2, -0.7, 0.6};
  const FaceFlux flux = this->solve(L, R, 0.15);
  const FaceFlux mirrored = this->solve({R.rho, -R.u, R.v, R.p}, {L.rho, -L.u, L.v, L.p}, -0.15);
  EXPECT_NEAR(mirrored.mass, -flux.mass, round_off);
  EXPECT_NEAR(mirrored.normal, flux.normal, round_off);
  EXPECT_NEAR(mirrored.tangential, -flux.tangential, round_off);
  EXPECT_NEAR(mirrored.energy, -flux.energy, round_off);
}

/// Entropy produced per unit of time by the waves of the approximate solution around a face at rest.
TEST(Eq1RiemannRoe, OpensASonicRarefactionOnlyWithTheSonicPointFix) {
  // A stationary expansion shock: the mirror image of a stationary shock satisfies the jump conditions but
  // not the second law.
  const double a = std::sqrt(gamma * 0.9);
  const Shock shock = shock_into({1, -1.5 * a, 0, 0.9}, 1.5);
  const FaceState L{shock.ahead.rho, -shock.ahead.u, 0, shock.ahead.p},
      R{shock.behind.rho, -shock.behind.u, 0, shock.behind.p};
  ASSERT_NEAR(shock.speed, 0, 1e-14);
  const FaceState from{R.rho, -R.u, 0, R.p},
      to{L.rho, -L.u, 0, L.p};  // gas expands from `from` to `to` through a jump
  const FaceFlux frozen = RiemannRoe{.gamma = gamma, .entropy_fix = 0}(to, from, 0);
  const FaceFlux opened = RiemannRoe{.gamma = gamma, .entropy_fix = 0.3}(to, from, 0);
  EXPECT_NEAR(frozen.mass, from.rho * from.u, 1e-12);
  EXPECT_GT(std::fabs(opened.mass - from.rho * from.u), 1e-2);
}

TYPED_TEST(Eq1RiemannSolver, KeepsTwoStreamsThatPartFromMakingNegativeGas) {
  // One first-order step of two cells at CFL 1/2: densities and pressures must stay positive.
  for (const double u : {1.0, 2.0, 4.0, 8.0}) {
    const FaceState L{1, -u, 0, 0.4}, R{1, u, 0, 0.4};
    const FaceFlux flux = this->solve(L, R, 0), out = euler_flux(L, 0);
    const double ratio = 0.5 / (u + std::sqrt(gamma * 0.4));
    const double rho = 1 - ratio * (flux.mass - out.mass), m = -u - ratio * (flux.normal - out.normal);
    const double E = energy(L) - ratio * (flux.energy - out.energy);
    EXPECT_GT(rho, 0);
    EXPECT_GT(E - 0.5 * m * m / rho, 0);
  }
}

}  // namespace
}  // namespace fsi::fluid
