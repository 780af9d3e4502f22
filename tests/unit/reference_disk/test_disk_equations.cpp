// The fine solution put into the paper's equations (48), (49) and (50) as they stand (with the errata), by
// differences of the output. The chain itself solves none of them in this form.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/exact/disk_table.hpp"
#include "reference/disk_file.hpp"
#include "tests/unit/reference_disk/disk_samples.hpp"

namespace fsi::reference {
namespace {

constexpr double omega_0 = 0.5, t = 0.5, tau = 2e-3;
constexpr int points = 800;

/// Three outputs around t, enough for differences in time.
const std::vector<DiskOutput>& around_t() {
  static const auto outputs = solve_disk(papers_disk(0.1, omega_0, {t - tau, t, t + tau}), points);
  return outputs;
}

/// The paper's variables at one ring.
struct Polar {
  double u_r, u_theta, v_r, omega;
  double P11, P12, P21, P22;  // P~ = Rbar P R~^T
};

Polar polar(const DiskOutput& out, std::size_t k) {
  const double q1 = out.r_bar[k] + out.u1[k], q2 = out.u2[k], a = std::hypot(q1, q2);
  const double c = q1 / a, s = q2 / a;
  return {.u_r = a - out.r_bar[k],
          .u_theta = std::atan2(q2, q1),
          .v_r = c * out.v1[k] + s * out.v2[k],
          .omega = (c * out.v2[k] - s * out.v1[k]) / a,
          .P11 = out.P11[k] * c + out.P12[k] * s,
          .P12 = out.P12[k] * c - out.P11[k] * s,
          .P21 = out.P21[k] * c + out.P22[k] * s,
          .P22 = out.P22[k] * c - out.P21[k] * s};
}

/// Largest residuals of both equations of (50); `sign` is that of its last term.
struct Residual {
  double radial = 0, angular = 0;
};

Residual of_eq50(double sign) {
  const auto& outputs = around_t();
  const double h = 1.0 / points;
  Residual largest;
  for (std::size_t k = 40; k + 40 < outputs[1].r_bar.size(); ++k) {
    const Polar now = polar(outputs[1], k), before = polar(outputs[0], k), after = polar(outputs[2], k);
    const Polar in = polar(outputs[1], k - 1), out = polar(outputs[1], k + 1);
    const double r = outputs[1].r_bar[k], twist = (out.u_theta - in.u_theta) / (2 * h);
    const auto slope = [&](double Polar::*P) { return ((r + h) * out.*P - (r - h) * in.*P) / (2 * h); };
    const double a_r = (after.v_r - before.v_r) / (2 * tau),
                 a_theta = (after.omega - before.omega) / (2 * tau);
    const double radial = a_r - (r + now.u_r) * now.omega * now.omega -
                          (slope(&Polar::P11) - r * now.P12 * twist - now.P22) / r;
    const double angular = (r + now.u_r) * a_theta + 2 * now.v_r * now.omega -
                           (slope(&Polar::P12) + r * now.P11 * twist + sign * now.P21) / r;
    largest.radial = std::max(largest.radial, std::abs(radial));
    largest.angular = std::max(largest.angular, std::abs(angular));
  }
  return largest;
}

TEST(Eq50RotatingDisk, TheSolutionBalancesRadialForceAndTorque) {
  // Terms of order 10; differences over 2 h and 2 tau leave some 1e-4 of them.
  const Residual residual = of_eq50(+1);
  EXPECT_LT(residual.radial, 5e-3);
  EXPECT_LT(residual.angular, 5e-3);
}

TEST(Eq50RotatingDisk, ThePrintedSignOfTheLastTermWouldBreakTheTorqueBalance) {
  EXPECT_GT(of_eq50(-1).angular, 0.5);  // of accelerations that reach 1.6
}

TEST(Eq50RotatingDisk, RotatedStressHasThePrintedComponentsOfTheSaintVenantKirchhoffLaw) {
  const DiskOutput& out = around_t()[1];
  const double h = 1.0 / points;
  double largest = 0;
  for (std::size_t k = 40; k + 40 < out.r_bar.size(); ++k) {
    const Polar now = polar(out, k), in = polar(out, k - 1), next = polar(out, k + 1);
    const double r = out.r_bar[k];
    const double stretch = 1 + (next.u_r - in.u_r) / (2 * h), hoop = 1 + now.u_r / r;
    const double twist = r * (next.u_theta - in.u_theta) / (2 * h);
    const double E11 = 0.5 * (stretch * stretch + hoop * hoop * twist * twist - 1);
    const double E12 = 0.5 * hoop * hoop * twist, E22 = 0.5 * (hoop * hoop - 1);
    const double S11 = 3 * E11 + E22, S12 = 2 * E12, S22 = E11 + 3 * E22;  // lambda = mu = 1
    largest =
        std::max({largest, std::abs(now.P11 - stretch * S11), std::abs(now.P12 - hoop * (twist * S11 + S12)),
                  std::abs(now.P21 - stretch * S12), std::abs(now.P22 - hoop * (twist * S12 + S22))});
  }
  EXPECT_LT(largest, 1e-5);  // h^2 = 1.6e-6 of strains of order one
}

TEST(Eq48RotatingDisk, TheGasKeepsMassMomentumAndEnergyInSpace) {
  const auto& outputs = around_t();
  std::vector<exact::CubicTable> tables;
  tables.reserve(outputs.size());
  for (const auto& out : outputs) tables.emplace_back(out.r, std::vector{out.rho, out.v, out.p});
  // Conserved variables and fluxes of the first, second and third row.
  struct Row {
    double q[3], f[3], p, source[3];
  };
  const auto row = [&](std::size_t time, double r) {
    const auto w = tables[time](r);
    const double rho = w[0], v = w[1], p = w[2], E = p / 0.4 + 0.5 * rho * v * v;
    return Row{.q = {rho, rho * v, E},
               .f = {rho * v, rho * v * v + p, v * (E + p)},
               .p = p,
               .source = {rho * v / r, rho * v * v / r, v * (E + p) / r}};
  };
  const double dr = 2e-3;
  double largest[3] = {}, rate[3] = {};
  for (double r = 1.02; r < 1.5; r += 0.01) {
    const Row now = row(1, r), before = row(0, r), after = row(2, r), in = row(1, r - dr),
              out = row(1, r + dr);
    for (int k = 0; k < 3; ++k) {
      const double q_t = (after.q[k] - before.q[k]) / (2 * tau);
      largest[k] = std::max(largest[k], std::abs(q_t + (out.f[k] - in.f[k]) / (2 * dr) + now.source[k]));
      rate[k] = std::max(rate[k], std::abs(q_t));
    }
  }
  for (int k = 0; k < 3; ++k) EXPECT_LT(largest[k], 2e-4 * rate[k]) << "row " << k + 1;  // differences
}

TEST(Eq49RotatingDisk, TheSolidKeepsItsMomentumInCartesianComponentsAtEveryAngle) {
  const std::string path = testing::TempDir() + "fsi_disk_eq49.h5";
  write_disk_table(path, {.outputs = around_t(), .broke = ""}, std::vector<Difference>(3));
  const exact::DiskTable table(path);
  std::filesystem::remove(path);
  const double step = 2e-3;
  const auto at = [&](double r, double theta, double time) {
    return table.solid(r * std::cos(theta), r * std::sin(theta), time);
  };
  for (const double r : {0.05, 0.3, 0.5, 0.7, 0.9}) {
    for (const double theta : {0.0, 0.7, 2.5, 4.0}) {
      // r (P_1j cos + P_2j sin) and -P_1j sin + P_2j cos
      const auto across = [&](double r_bar) -> Vec2 {
        return r_bar * at(r_bar, theta, t).P.transpose() * Vec2(std::cos(theta), std::sin(theta));
      };
      const auto along = [&](double angle) -> Vec2 {
        return at(r, angle, t).P.transpose() * Vec2(-std::sin(angle), std::cos(angle));
      };
      const Vec2 force = (across(r + step) - across(r - step)) / (2 * step * r) +
                         (along(theta + step) - along(theta - step)) / (2 * step * r);
      const Vec2 a = (at(r, theta, t + tau).v - at(r, theta, t - tau).v) / (2 * tau);
      // Accelerations of order one by differences, divided by r at the centre.
      EXPECT_LT((a - force).norm(), 5e-5 / r) << "r " << r << " theta " << theta;
    }
  }
}

}  // namespace
}  // namespace fsi::reference
