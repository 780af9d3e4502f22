// The fine solution of the rotating disk against limits that have closed solutions, conservation laws and the
// plot bounds of the paper's figure 10 as an independent solution gives them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/core/failure.hpp"
#include "common/exact/root.hpp"
#include "tests/unit/reference_disk/disk_samples.hpp"

namespace fsi::reference {
namespace {

class DiskOfLaw : public testing::TestWithParam<const char*> {};

TEST_P(DiskOfLaw, Eq50DifferenceOfTwoRunsFallsFourfoldWhenBothAreRefined) {
  const auto disk = with_law(papers_disk(1, 0.1, {0.5}), GetParam());
  const auto a = solve_disk(disk, 100).back(), b = solve_disk(disk, 200).back();
  const auto c = solve_disk(disk, 400).back();
  const Difference coarse = compare(b, a), fine = compare(c, b);
  for (const auto quantity : differences) {
    EXPECT_NEAR(coarse.*quantity / (fine.*quantity), 4, 0.6);  // 4 in the limit of many points
  }
}

TEST_P(DiskOfLaw, KeepsItsEnergyToTheOrderOfTheScheme) {
  const auto change = [&](int points) {
    const auto out = solve_disk(with_law(papers_disk(1, 0.5, {0, 0.7}), GetParam()), points);
    return std::abs(out[1].totals.energy() / out[0].totals.energy() - 1);
  };
  const double coarse = change(100), fine = change(200);
  EXPECT_LT(fine, 1.0 / (200 * 200));
  EXPECT_GT(std::log2(coarse / fine), 1.8);
}

TEST_P(DiskOfLaw, AtRestNothingMoves) {
  const auto out = solve_disk(with_law(papers_disk(0.1, 0, {1}), GetParam()), 50).back();
  for (std::size_t k = 0; k < out.r_bar.size(); ++k) EXPECT_LT(std::hypot(out.u1[k], out.u2[k]), 1e-13);
  for (const double p : out.p) EXPECT_NEAR(p, 10, 1e-11);
}

/// Wave number between a and b where `f` of it is zero.
template <class Function>
double zero_of(const Function& f, double a, double b) {
  const auto with_slope = [&](double k) { return std::pair{f(k), (f(k + 1e-6) - f(k - 1e-6)) / 2e-6}; };
  return exact::root_between(with_slope, a, b, 0.5 * (a + b));
}

TEST_P(DiskOfLaw, SmallTwistIsABesselModeOfTheLinearWaveEquation) {
  // rho w_tt = mu (w'' + w' / r - w / r^2) with a free rim, w' - w / r = -k J2(k r) = 0 at r = 1.
  const double k = zero_of([](double x) { return std::cyl_bessel_j(2.0, x); }, 4, 6), amplitude = 1e-6;
  DiskProblem disk = with_law(papers_disk(1, 0, {1}), GetParam());
  disk.material.rho_bar = 2;
  disk.material.mu = 0.5;
  const double frequency = k * 0.5;  // sqrt(mu / rho)
  disk.v_theta = [=](double r) { return amplitude * frequency * std::cyl_bessel_j(1.0, k * r); };
  const auto out = solve_disk(disk, 100).back();
  for (std::size_t i = 0; i < out.r_bar.size(); ++i) {
    const double mode = amplitude * std::cyl_bessel_j(1.0, k * out.r_bar[i]);
    // Second order, wave number 5: (k h)^2 / 24 per radian of phase, both directions of error bounded by it.
    EXPECT_NEAR(out.u2[i], mode * std::sin(frequency), 5e-4 * amplitude);
    EXPECT_NEAR(out.v2[i], mode * frequency * std::cos(frequency), 1e-3 * amplitude);
    EXPECT_NEAR(out.u1[i], 0, 1e-10);  // the centrifugal force is of second order
  }
}

TEST_P(DiskOfLaw, SmallBreathingInAThinGasIsABesselModeOfTheLinearWaveEquation) {
  // Free rim: (lambda + 2 mu) u' + lambda u / r = 0 at r = 1 for u = J1(k r).
  DiskProblem disk = with_law(papers_disk(1, 0, {1}), GetParam());
  disk.rho_0 = disk.p_0 = disk.p_e = 1e-10;
  disk.material.lambda = 2;
  const double M = disk.material.lambda + 2 * disk.material.mu;
  const double k = zero_of(
      [&](double x) {
        const double J1 = std::cyl_bessel_j(1.0, x);
        return M * (x * std::cyl_bessel_j(0.0, x) - J1) + disk.material.lambda * J1;
      },
      1, 3.5);
  const double amplitude = 1e-6, frequency = k * std::sqrt(M);
  disk.v_r = [=](double r) { return amplitude * frequency * std::cyl_bessel_j(1.0, k * r); };
  const auto out = solve_disk(disk, 100).back();
  for (std::size_t i = 0; i < out.r_bar.size(); ++i) {
    const double mode = amplitude * std::cyl_bessel_j(1.0, k * out.r_bar[i]);
    EXPECT_NEAR(out.u1[i], mode * std::sin(frequency), 5e-4 * amplitude);  // second order, as above
    EXPECT_EQ(out.u2[i], 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, DiskOfLaw,
                         testing::Values("linear_elastic", "saint_venant_kirchhoff", "neo_hookean"));

TEST(RotatingDisk, Eq50AnObjectiveLawKeepsTheAngularMomentumThroughALargeRotation) {
  for (const char* law : {"saint_venant_kirchhoff", "neo_hookean"}) {
    DiskProblem disk = with_law(papers_disk(0.5, 0.1, {0, 3}), law);
    disk.v_theta = [](double r) { return 0.5 * r + r * exact::angular_velocity(0.2, r); };
    const auto out = solve_disk(disk, 100);
    EXPECT_GT(std::atan2(out[1].u2.back(), 1 + out[1].u1.back()), 1.0) << law;  // radians turned
    EXPECT_NEAR(out[1].totals.angular_momentum / out[0].totals.angular_momentum, 1, 1e-12)
        << law;  // round-off
  }
}

TEST(RotatingDisk, Eq50GivesThePlotBoundsOfFigure10) {
  // The bounds of an independent fine solution, to half a unit of their last printed digit.
  const auto out = solve_disk(papers_disk(0.1, 0.1, {0.5}), 400).back();
  double v_bar = 0, v = 0;
  for (std::size_t k = 0; k < out.r_bar.size(); ++k)
    v_bar = std::max(v_bar, std::hypot(out.v1[k], out.v2[k]));
  for (const double v_r : out.v) v = std::max(v, std::abs(v_r));
  EXPECT_NEAR(v_bar, 5.041e-2, 0.5e-5);
  EXPECT_NEAR(v, 6.11e-5, 0.5e-7);
  EXPECT_NEAR(*std::ranges::min_element(out.p), 9.99917, 0.5e-5);
  EXPECT_NEAR(*std::ranges::max_element(out.p), 10.00075, 0.5e-5);
}

TEST(RotatingDisk, Eq12TheRimFeelsThePressureOfTheGasAndNoFriction) {
  DiskProblem disk = papers_disk(1, 0, {0.6});
  disk.v_theta = [](double r) { return 0.8 * r; };  // flies apart: the rim moves far
  const auto out = solve_disk(disk, 800).back();
  const double c = 1 + out.u1.back(), s = out.u2.back(), a = std::hypot(c, s);
  const double along = (out.P11.back() * c + out.P12.back() * s) / a;
  const double across = (out.P12.back() * c - out.P11.back() * s) / a;
  // Stresses of order one, extrapolated to the rim at second order: some h^2 = 1.6e-6.
  EXPECT_NEAR(across, 0, 1e-5);
  EXPECT_NEAR(along, -(out.p.front() - 1) * a, 1e-5);
  EXPECT_GT((a - 1) * std::abs(along), 1e-3);  // so that present and reference area are told apart
  EXPECT_NEAR(out.v.front(), (out.v1.back() * c + out.v2.back() * s) / a, 1e-14);
  EXPECT_NEAR(out.r.front(), a, 1e-14);
}

TEST(RotatingDisk, FeelsAWallOnlyWhenAWaveHasComeBackFromIt) {
  DiskProblem walled = papers_disk(1, 0.5, {0.38, 1.2});
  walled.b = 1.2;  // the gas has sound speed 1
  DiskProblem endless = walled;
  endless.b = 0;
  const auto in_walls = solve_disk(walled, 200), in_space = solve_disk(endless, 200);
  const auto radial = [](const DiskOutput& out) { return out.u1.back(); };
  EXPECT_NEAR(radial(in_walls[0]), radial(in_space[0]), 1e-10);
  EXPECT_GT(std::abs(radial(in_walls[1]) - radial(in_space[1])), 1e-4);
}

TEST(RotatingDisk, LoadsOfBothConfigurationsMeetLikeTheSquareOfTheAmplitude) {
  // Small-strain theory of the load: p - p_e is of second order in omega_0 here, its lever of first and more.
  const auto difference = [](double omega_0) {
    DiskProblem disk = with_law(papers_disk(0.1, omega_0, {0.8}), "linear_elastic");
    const auto current = solve_disk(disk, 100).back();
    disk.load_on_reference = true;
    return compare(current, solve_disk(disk, 100).back()).u_bar;
  };
  const double large = difference(0.2), small = difference(0.1);
  EXPECT_GT(large, 1e-9);
  EXPECT_GT(std::log2(large / small), 1.9);
}

TEST(RotatingDisk, RefusesALawItDoesNotKnow) {
  EXPECT_THROW(solve_disk(with_law(papers_disk(1, 0.1, {0.1}), "rubber"), 50), UserMistake);
}

TEST(RotatingDisk, SaysWhereTheSolidFolds) {
  DiskProblem disk = with_law(papers_disk(1, 0, {1}), "linear_elastic");
  disk.v_r = [](double r) { return -20 * r * (1 - r); };
  try {
    solve_disk(disk, 50);
    FAIL() << "a folded solid must be noticed";
  } catch (const Diverged& broke) {
    EXPECT_NE(std::string(broke.what()).find("r_bar"), std::string::npos);
  }
}

}  // namespace
}  // namespace fsi::reference
