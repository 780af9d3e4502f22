#include "coupler/exchange/checked_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "common/core/failure.hpp"

namespace fsi::coupler {

namespace {

Place place_of(const Moment& moment, const wire::PredictedInterface& state) {
  return {.step = moment.step, .t = moment.t, .program = state.from, .interface = state.interface};
}

}  // namespace

void throw_broken(const Moment& moment, const wire::PredictedInterface& state, std::size_t k,
                  const std::string& what) {
  Place place = place_of(moment, state);
  place.point = {static_cast<int>(k)};
  const std::size_t points = state.x.size() / 2;
  if (k < points) place.position = {state.x[k], state.x[points + k]};
  throw NumbersBroke(what, std::move(place));
}

void check_values(const Moment& moment, const wire::PredictedInterface& state, const char* quantity,
                  std::span<const double> values, std::size_t expected, std::size_t points) {
  if (values.size() != expected) {
    throw PeerLost(fmt::format("\"{}\" sent {} numbers for {} of interface \"{}\", not {}", state.from,
                               values.size(), quantity, state.interface, expected));
  }
  for (std::size_t k = 0; k < expected; ++k) {
    if (!std::isfinite(values[k]))
      throw_broken(moment, state, k % points, fmt::format("{} is {}", quantity, values[k]));
  }
}

void check_entries(const Moment& moment, const wire::PredictedInterface& state, const char* quantity,
                   const wire::SparseMatrix& matrix, const MatrixSize& size) {
  const std::size_t entries = matrix.value.size();
  const auto within = [&](std::size_t e) {
    const auto is_below = [](std::int32_t index, std::size_t end) {
      return index >= 0 && static_cast<std::size_t>(index) < end;
    };
    return is_below(matrix.row[e], size.rows) && is_below(matrix.column[e], size.columns);
  };
  bool fits = matrix.row.size() == entries && matrix.column.size() == entries;
  for (std::size_t e = 0; fits && e < entries; ++e) fits = within(e);
  if (!fits) {
    throw PeerLost(
        fmt::format("\"{}\" sent entries for {} of interface \"{}\" that do not make a matrix of {} x {}",
                    state.from, quantity, state.interface, size.rows, size.columns));
  }
  for (std::size_t e = 0; e < entries; ++e) {
    if (std::isfinite(matrix.value[e])) continue;
    throw NumbersBroke(
        fmt::format("entry ({}, {}) of {} is {}", matrix.row[e], matrix.column[e], quantity, matrix.value[e]),
        place_of(moment, state));
  }
}

}  // namespace fsi::coupler
