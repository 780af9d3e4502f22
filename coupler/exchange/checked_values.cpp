#include "coupler/exchange/checked_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "common/core/failure.hpp"

namespace fsi::coupler {

namespace {

/// Says where: "point 3 at (0.1, 0.2)", where the positions `x` are known.
std::string place_of(std::size_t k, std::span<const double> x) {
  if (x.size() / 2 <= k) return fmt::format("point {}", k);
  return fmt::format("point {} at ({:.4g}, {:.4g})", k, x[k], x[x.size() / 2 + k]);
}

}  // namespace

void throw_broken(const Moment& moment, const wire::PredictedInterface& state, std::size_t k,
                  const std::string& what) {
  throw NumbersBroke(fmt::format("step {}, t = {:.6g}: \"{}\" at interface \"{}\", {}: {}", moment.step,
                                 moment.t, state.from, state.interface, place_of(k, state.x), what));
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
    throw NumbersBroke(fmt::format(
        "step {}, t = {:.6g}: \"{}\" at interface \"{}\", entry ({}, {}): {} is {}", moment.step, moment.t,
        state.from, state.interface, matrix.row[e], matrix.column[e], quantity, matrix.value[e]));
  }
}

}  // namespace fsi::coupler
