#include "coupler/exchange/checked_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "common/core/failure.hpp"
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

}  // namespace fsi::coupler
