// Growth per step of a block of 11 x 7 points: the largest eigenvalue of its whole step, sweep, dissipation, relaxation and sides,
// linearised about the block at rest or evenly squeezed: `bin/steps_of_solids`. Coefficients are the options' defaults, slopes are
// not limited.

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/convergence/solid/block_in_gas.hpp"

namespace {

using namespace fsi::solid;
using test::Surroundings;

struct Row {
  const char* sides;
  Surroundings around;
  double lambda;
  double f = 1;  ///< length over that at rest [-]
};

/// By central differences.
Eigen::MatrixXd jacobian(test::BlockInGas<NeoHookean>& block) {
  constexpr double shift = 1e-6;
  const std::vector<double> squeezed = block.unknowns();
  for (int k = 0; k < 3; ++k)
    block.stepped(squeezed, block.stable_step());  // the sweep has seen its pressure
  const double dt = block.stable_step();
  const auto count = static_cast<Eigen::Index>(squeezed.size());
  Eigen::MatrixXd A(count, count);
  std::vector<double> from = squeezed;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const auto stepped = [&](double by) {
      from[k] = squeezed[k] + by;
      return block.stepped(from, dt);
    };
    const std::vector<double> above = stepped(shift), below = stepped(-shift);
    from[k] = squeezed[k];
    for (std::size_t l = 0; l < from.size(); ++l)
      A(static_cast<Eigen::Index>(l), static_cast<Eigen::Index>(k)) = (above[l] - below[l]) / (2 * shift);
  }
  return A;
}

/// Largest modulus of the eigenvalues, less 1. Motions of the whole body have eigenvalues of 1, more than one of them to a
/// vector: differences are no nearer than that.
std::string growth(const Row& row, double aspect) {
  constexpr double resolved = 1e-4;
  const test::NoiseCase noise = {.F = {row.f, 0, 0, row.f},
                                 .lambda = row.lambda,
                                 .aspect = aspect,
                                 .beta_P = 0.5,
                                 .beta_u = 0.5,
                                 .beta_r = 0.2};
  test::BlockInGas<NeoHookean> block(noise, row.around);
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(jacobian(block), false);
  const double most = eigen.eigenvalues().cwiseAbs().maxCoeff() - 1;
  return most < resolved ? "0" : fmt::format("{:.1e}", most);
}

}  // namespace

int main() {
  using enum Surroundings::Gas;
  fmt::print(
      "| sides | lambda / mu | squeezed to | 4:1 | 1:1 | 1:4 | 1:8 |\n|---|---|---|---|---|---|---|\n");
  for (const Row& row : {Row{"gas, z_f / z_p = 0.002", {}, 1},
                         {"gas, z_f / z_p = 0.002", {}, 49},
                         {"gas, z_f / z_p = 0.002", {}, 499},
                         {"gas, z_f / z_p = 0.5", {.z_f = 0.5}, 1},
                         {"gas, z_f / z_p = 10", {.z_f = 10}, 1},
                         {"gas, z_f / z_p = 1000", {.z_f = 1000}, 1},
                         {"gas, z_f / z_p = 0.002", {}, 1, 0.8},
                         {"gas, z_f / z_p = 0.002", {}, 4, 0.85},
                         {"gas, z_f / z_p = 0.002", {}, 49, 0.95},
                         {"gas, z_f / z_p = 0.002, one free", {.gas = not_below}, 1},
                         {"gas, z_f / z_p = 0.002, one free", {.gas = not_below}, 49},
                         {"gas, z_f / z_p = 0.002, one free", {.gas = not_below}, 499},
                         {"free", {.gas = nowhere}, 1},
                         {"free", {.gas = nowhere}, 200},
                         {"free", {.gas = nowhere}, 499}}) {
    fmt::print("| {} | {:g} | {:g} |", row.sides, row.lambda, row.f);
    for (const double aspect : {0.25, 1.0, 4.0, 8.0}) fmt::print(" {} |", growth(row, aspect));
    fmt::print("\n");
    std::fflush(stdout);
  }
  return 0;
}
