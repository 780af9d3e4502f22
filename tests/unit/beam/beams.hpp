#pragma once
/// Beams for the tests.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "solid_solver/beam/motion.hpp"

namespace fsi::beam::testing {

using std::numbers::pi;

inline constexpr std::array cantilever{End::clamped, End::free}, hinged{End::pinned, End::pinned},
    guided{End::guided, End::guided}, loose{End::free, End::free};

/// Notes in the test's XML what docs/results.md shows. @param coarse error with half the resolution, where there is an order
inline void note(const std::string& what, double error, double coarse = 0) {
  const std::string order = coarse > 0 ? fmt::format("{:.2f}", std::log2(coarse / error)) : "-";
  ::testing::Test::RecordProperty(what, fmt::format("{:.1e} {}", error, order));
}

/// A beam whose stretch and shear are of the order of 1e-8.
inline Section slender(double mass = 0) {
  return {.EA = 1e8, .GA = 1e8, .EI = 1, .mass = mass, .inertia = 0};
}

/// Of length 1 along x.
inline BeamModel straight(const Section& section, int elements) {
  return {straight_line({0, 0}, {1, 0}, elements),
          std::vector<Section>(static_cast<std::size_t>(elements), section)};
}

inline BeamModel ring(const Section& section, double radius, int elements) {
  Line line{.x = {}, .alpha = {}, .closed = true};
  for (int k = 0; k < elements; ++k) {
    const double angle = 2 * pi * k / elements;
    line.x.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    line.alpha.push_back(angle + pi / 2);
  }
  return {line, std::vector<Section>(static_cast<std::size_t>(elements), section)};
}

/// Equilibrium of a beam without mass under a load on its degrees of freedom, brought up in `steps`.
inline BeamMotion at_rest(const BeamModel& model, const std::array<End, 2>& ends, const Eigen::VectorXd& load,
                          int steps = 1) {
  BeamMotion motion(model, ends);
  for (int k = 1; k <= steps; ++k) motion.advance(1, (static_cast<double>(k) / steps) * load, nullptr);
  return motion;
}

/// One load on one degree of freedom of the last node.
inline Eigen::VectorXd on_tip(const BeamModel& model, int freedom, double load) {
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(model.freedoms());
  loads[model.freedoms() - 3 + freedom] = load;
  return loads;
}

}  // namespace fsi::beam::testing
