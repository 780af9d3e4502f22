#include "common/bus/lengths.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/core/failure.hpp"
#include "common/wire/entries.hpp"

namespace fsi::bus {

namespace {

constexpr std::int32_t most_dimensions = 3;
constexpr std::int32_t most_modes = 20000;
constexpr std::size_t longest_name = 256;
constexpr std::size_t most_samples_in_all = 1 << 18;  ///< of a picture

/// Compares lengths, remembering whose message it is.
class Lengths {
 public:
  Lengths(std::string from, std::string interface)
      : from_(std::move(from)), interface_(std::move(interface)) {}

  template <class Vector>
  void check(const char* array, const Vector& values, std::size_t expected) const {
    if (values.empty() || values.size() == expected) return;
    throw PeerLost(fmt::format("{} sent {} values of {} instead of {} for interface '{}'", from_,
                               values.size(), array, expected, interface_));
  }
  void check_count(const char* what, std::int32_t count, std::int32_t lowest, std::int32_t highest) const {
    if (count >= lowest && count <= highest) return;
    throw PeerLost(fmt::format("{} sent {} = {} for interface '{}', not {} to {}", from_, what, count,
                               interface_, lowest, highest));
  }

  /// Every entry has a row, a column and a value, and lies within a matrix of `rows` x `columns`.
  void check_entries(const std::string& array, const wire::SparseMatrix& matrix, std::size_t rows,
                     std::size_t columns) const {
    const std::size_t entries = matrix.value.size();
    if (matrix.row.size() != entries || matrix.column.size() != entries) {
      throw PeerLost(fmt::format("{} sent {} rows, {} columns and {} values of {} for interface '{}'", from_,
                                 matrix.row.size(), matrix.column.size(), entries, array, interface_));
    }
    if (wire::fits(matrix, rows, columns)) return;
    const auto outside = [](std::int32_t index, std::size_t end) {
      return index < 0 || static_cast<std::size_t>(index) >= end;
    };
    for (std::size_t e = 0; e < entries; ++e) {
      if (!outside(matrix.row[e], rows) && !outside(matrix.column[e], columns)) continue;
      throw PeerLost(fmt::format("{} sent an entry ({}, {}) of {}, which is {} x {}, for interface '{}'",
                                 from_, matrix.row[e], matrix.column[e], array, rows, columns, interface_));
    }
  }

 private:
  std::string from_, interface_;
};

}  // namespace

InterfaceSize size_of(const wire::InterfaceInfo& info, const std::string& from) {
  const Lengths lengths(from, info.name);
  lengths.check_count("dimension", info.dimension, 1, most_dimensions);
  const auto dimension = static_cast<std::size_t>(info.dimension);
  const InterfaceSize size{.points = info.x.size() / dimension, .dimension = dimension};
  lengths.check("x", info.x, size.points * dimension);
  lengths.check("n", info.n, size.points * dimension);
  return size;
}

void check_lengths(const wire::PredictedInterface& m, InterfaceSize size) {
  const Lengths lengths(m.from, m.interface);
  const std::size_t vectors = size.dimension * size.points;
  lengths.check("x", m.x, vectors);
  lengths.check("v", m.v, vectors);
  lengths.check("a", m.a, vectors);
  lengths.check("w", m.w, vectors);
  lengths.check("p", m.p, size.points);
  lengths.check("z_f", m.z_f, size.points);
  lengths.check("rho", m.rho, size.points);
  lengths.check("gamma", m.gamma, size.points);
  lengths.check("Z", m.Z, size.points * size.dimension * (size.dimension + 1) / 2);
  lengths.check("fixed", m.fixed, size.points);
  lengths.check_count("modal.modes", m.modal.modes, 0, most_modes);
  const auto modes = static_cast<std::size_t>(m.modal.modes);
  lengths.check("modal.g", m.modal.g, modes);
  lengths.check("modal.q_dot", m.modal.q_dot, modes);
  lengths.check_entries("modal.S", m.modal.S, modes, modes);
  lengths.check_entries("modal.N", m.modal.N, modes, size.points);
}

void check_lengths(const wire::ProjectedInterface& m, InterfaceSize size) {
  const Lengths lengths("coupler", m.interface);
  const std::size_t vectors = size.dimension * size.points;
  lengths.check("n", m.n, vectors);
  lengths.check("v_n", m.v_n, size.points);
  lengths.check("w_n", m.w_n, size.points);
  lengths.check("v", m.v, vectors);
  lengths.check("a", m.a, vectors);
  lengths.check("z_f", m.z_f, size.points);
  lengths.check("robin_r", m.robin_r, m.robin_t.size() * size.points);
  lengths.check("x_next", m.x_next, vectors);
}

bool is_sound(const wire::Picture& m) {
  if (!std::isfinite(m.t) || !std::isfinite(m.low) || !std::isfinite(m.high) || m.high < m.low) return false;
  if (m.grids.size() > wire::Picture::most_grids || m.from.size() > longest_name ||
      m.quantity.size() > longest_name)
    return false;
  std::size_t samples = 0;
  return std::ranges::all_of(m.grids, [&samples](const wire::Picture::Grid& grid) {
    samples += grid.level.size();
    const std::size_t n1 = grid.n1, n2 = grid.n2, most = wire::Picture::most_samples;
    return samples <= most_samples_in_all && n1 >= 1 && n2 >= 1 && n1 <= most && n2 <= most &&
           grid.level.size() == n1 * n2 && grid.x.size() == (grid.straight ? n1 + n2 : 2 * n1 * n2) &&
           grid.name.size() <= longest_name &&
           std::ranges::all_of(grid.x, [](float value) { return std::isfinite(value); });
  });
}

}  // namespace fsi::bus
