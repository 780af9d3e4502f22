#pragma once
/// Sets of points of a coarse lattice, and of the fine points in their control volumes.
///
///     |   o   o   o   |   o   o   o   |      coarse point I is fine point 3 I; its control volume is exactly
///     |       O       |       O       |      that of the fine points 3 I - 1, 3 I, 3 I + 1

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/grid/intervals.hpp"

namespace fsi::fluid {

/// Spacing of a level in spacings of the next finer one. Odd, so that control volumes around vertices tile.
inline constexpr int refinement_ratio = 3;

/// The coarse point in whose control volume a fine point lies.
inline int coarse_index(int fine) {
  return (fine + 1) / refinement_ratio;
}

/// Shape of a lattice: points, and the directions in which the last point is the first one of the next period.
struct LatticeShape {
  int n1 = 0, n2 = 0;
  std::array<bool, 2> periodic{};
};

class CellMask {
 public:
  CellMask() = default;
  explicit CellMask(const LatticeShape& shape)
      : shape_(shape), in_(static_cast<std::size_t>(shape.n1) * static_cast<std::size_t>(shape.n2), 0) {}

  const LatticeShape& shape() const { return shape_; }
  /// Points beyond an end are those of the next period, or not in the set.
  bool contains(int i, int j) const {
    return wrap(i, shape_.n1, shape_.periodic[0]) && wrap(j, shape_.n2, shape_.periodic[1]) &&
           in_[at(i, j)] != 0;
  }
  /// Of a point of the lattice.
  void set(int i, int j, bool value = true) { in_[at(i, j)] = value ? 1 : 0; }
  void set_all(bool value) { in_.assign(in_.size(), value ? 1 : 0); }
  std::uint8_t* row(int j) { return in_.data() + at(0, j); }
  const std::uint8_t* row(int j) const { return in_.data() + at(0, j); }

  void add(const CellMask& other);
  void add(const grid::RowSets& rows);
  void remove(const CellMask& other);
  void intersect(const CellMask& other);
  /// All points within `reach` of the set in both directions.
  void grow(int reach);
  /// Points of a row with members on both sides, no more than so many between two of them.
  void fill_gaps(int most);
  /// Both ends of a period agree; on other sides a point next to the side takes the point on it along, so
  /// that no rim lies between them.
  void close_ends();
  grid::RowSets rows() const;
  bool operator==(const CellMask& other) const { return in_ == other.in_; }

 private:
  LatticeShape shape_;
  std::vector<std::uint8_t> in_;

  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(shape_.n1) + static_cast<std::size_t>(i);
  }
  static bool wrap(int& k, int n, bool periodic) {
    if (k >= 0 && k < n) return true;
    if (!periodic) return false;
    k = (k % (n - 1) + n - 1) % (n - 1);
    return true;
  }
};

/// The points of a fine lattice of n1 x n2 points in the control volumes of a set.
grid::RowSets refined(const grid::RowSets& coarse, int n1, int n2);

/// The points of rows of n1 points that are not in a set.
grid::RowSets gaps_of(const grid::RowSets& set, int n1);

/// The points of a set that are not in another one with as many rows.
grid::RowSets difference(const grid::RowSets& from, const grid::RowSets& without);

/// Marks the points in whose control volumes the points of fine rows lie.
void mark_coarse(const grid::RowSets& fine, CellMask& mask);

}  // namespace fsi::fluid
