#include "coupler/exchange/checked_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "common/core/component_major.hpp"
#include "common/core/failure.hpp"
#include "common/core/types.hpp"
#include "common/wire/entries.hpp"

namespace fsi::coupler {

namespace {

Place place_of(const Moment& moment, const wire::PredictedInterface& state) {
  return {.step = moment.step, .t = moment.t, .program = state.from, .interface = state.interface};
}

bool all_finite(std::span<const double> values) {
  unsigned broken = 0;
#pragma omp simd reduction(| : broken)
  for (std::size_t k = 0; k < values.size(); ++k)  // NOLINT(modernize-loop-convert): simd counts
    broken |= std::isfinite(values[k]) ? 0U : 1U;
  return broken == 0;
}

}  // namespace

void throw_broken(const Moment& moment, const wire::PredictedInterface& state, std::size_t k,
                  const std::string& what) {
  Place place = place_of(moment, state);
  place.point = {static_cast<int>(k)};
  const std::size_t points = state.x.size() / 2;
  if (k < points) place.position = {state.x[k], state.x[points + k]};
  throw Diverged(what, std::move(place));
}

void check_values(const Moment& moment, const wire::PredictedInterface& state, const char* quantity,
                  std::span<const double> values, std::size_t expected, std::size_t points,
                  const std::string& remedy) {
  if (values.size() != expected) {
    throw PeerLost(fmt::format("\"{}\" sent {} numbers for {} of interface \"{}\", not {}", state.from,
                               values.size(), quantity, state.interface, expected));
  }
  if (all_finite(values)) return;
  for (std::size_t k = 0; k < expected; ++k) {
    if (!std::isfinite(values[k]))
      throw_broken(moment, state, k % points,
                   fmt::format("{} is {}{}{}", quantity, values[k], remedy.empty() ? "" : ": ", remedy));
  }
}

void check_entries(const Moment& moment, const wire::PredictedInterface& state, const char* quantity,
                   const wire::SparseMatrix& matrix, const MatrixSize& size) {
  if (!wire::fits(matrix, size.rows, size.columns)) {
    throw PeerLost(
        fmt::format("\"{}\" sent entries for {} of interface \"{}\" that do not make a matrix of {} x {}",
                    state.from, quantity, state.interface, size.rows, size.columns));
  }
  if (all_finite(matrix.value)) return;
  for (std::size_t e = 0; e < matrix.value.size(); ++e) {
    if (std::isfinite(matrix.value[e])) continue;
    throw Diverged(
        fmt::format("entry ({}, {}) of {} is {}", matrix.row[e], matrix.column[e], quantity, matrix.value[e]),
        place_of(moment, state));
  }
}

void check_resistance(const wire::PredictedInterface& solid) {
  const wire::SparseMatrix& S = solid.modal.S;
  for (std::size_t e = 0; e < S.value.size(); ++e) {
    if (S.row[e] != S.column[e] || S.value[e] >= 0) continue;
    throw PeerLost(
        fmt::format("\"{}\" sent S({}, {}) = {:.6g} in its modal response on interface \"{}\": a body that "
                    "gives way to its own motion; S q' = g + dt f has the mass on the left, and f pushes it",
                    solid.from, S.row[e], S.column[e], S.value[e], solid.interface));
  }
}

void check_mode_vectors(const wire::PredictedInterface& solid, const ModeVelocities& velocities,
                        double sound) {
  constexpr double tolerance = 0.3, round_off = 1e-9;
  double apart = 0, moving = 0, length = 0;
  std::size_t worst = 0;
  const auto difference = [&](std::size_t k) { return std::abs(velocities.v_n[k] - velocities.of_modes[k]); };
  for (std::size_t k = 0; k < velocities.ds.size(); ++k) {
    apart += velocities.ds[k] * difference(k) * difference(k);
    moving += velocities.ds[k] * vector_at(solid.v, k).squaredNorm();
    length += velocities.ds[k];
    if (difference(k) > difference(worst)) worst = k;
  }
  const auto most = [&](double share, double of) { return share * share * of; };
  if (apart <= most(tolerance, moving) || apart <= most(round_off * sound, length)) return;
  throw PeerLost(fmt::format(
      "\"{}\" moves point {} of interface \"{}\" with n.v = {:.6g}, but its modes with N q_dot = "
      "{:.6g}: N must have the velocity along the outward normal of each point for a unit of each "
      "q_dot, at the time and place of its x and v",
      solid.from, worst, solid.interface, velocities.v_n[worst], velocities.of_modes[worst]));
}

void check_start(const wire::PredictedInterface& solid, std::span<const double> x) {
  constexpr double share = 0.5;  // of the distance of two points
  const std::size_t n = x.size() / 2;
  double length = 0, apart = 0;
  std::size_t worst = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (k > 0) length += (vector_at(x, k) - vector_at(x, k - 1)).norm();
    const double way = (vector_at(solid.x, k) - vector_at(x, k)).norm();
    if (way > apart) worst = k;
    apart = std::max(apart, way);
  }
  if (apart <= share * length / static_cast<double>(n - 1)) return;
  const Vec2 begins = vector_at(solid.x, worst), hello = vector_at(x, worst);
  throw PeerLost(fmt::format(
      "\"{}\" begins with point {} of interface \"{}\" at ({:.6g}, {:.6g}), but its hello has it at "
      "({:.6g}, {:.6g}), where the grid of the gas begins; send the same positions, in the same "
      "order and in the units of the case",
      solid.from, worst, solid.interface, begins.x(), begins.y(), hello.x(), hello.y()));
}

void check_impedance(const wire::PredictedInterface& solid, std::span<const double> normals) {
  constexpr double times = 4;  // a body that starts strained has another Z than at rest
  const std::size_t n = normals.size() / 2;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double x = normals[k], y = normals[n + k];
    const double z = x * x * solid.Z[k] + 2 * x * y * solid.Z[n + k] + y * y * solid.Z[2 * n + k];
    least = std::min(least, z);
    most = std::max(most, z);
  }
  if (solid.z_p * times >= least && solid.z_p <= times * most) return;
  throw PeerLost(
      fmt::format("\"{}\" sent z_p = {:.6g} for interface \"{}\", but n.Z.n from {:.6g} to {:.6g}: both are "
                  "the impedance rho c_p along the normal, z_p that at rest",
                  solid.from, solid.z_p, solid.interface, least, most));
}

}  // namespace fsi::coupler
