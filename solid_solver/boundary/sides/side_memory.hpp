#pragma once
/// What the conditions know of each point of the sides, and what a later stage or step needs again.

#include <array>
#include <span>
#include <vector>

#include "common/core/archive.hpp"
#include "common/core/types.hpp"
#include "solid_solver/boundary/sides/sides.hpp"

namespace fsi::solid {

class SideMemory {
 public:
  explicit SideMemory(const Sides& sides);

  /// Nominal traction n0^T P of loaded sides [pressure], and its rate.
  Vec2& T(Side side, int k) { return of(T_, side, k); }
  const Vec2& T(Side side, int k) const { return of(T_, side, k); }
  Vec2& T_rate(Side side, int k) { return of(T_rate_, side, k); }
  const Vec2& T_rate(Side side, int k) const { return of(T_rate_, side, k); }
  /// What motion that is given changed of the predicted velocity.
  Vec2& v_change(Side side, int k) { return of(v_change_, side, k); }
  const Vec2& v_change(Side side, int k) const { return of(v_change_, side, k); }

  void archive(Archive& archive);
  /// What `archive` has of points in these rows, one point after the other.
  std::vector<double> scattered(const Sides& sides, const grid::RowRange& rows) const;
  /// Puts it in its place; returns what follows it.
  std::span<const double> gather_scattered(const Sides& sides, const grid::RowRange& rows,
                                           std::span<const double> values);

 private:
  using Lists = std::array<std::vector<Vec2>, 4>;

  static Vec2& of(Lists& lists, Side side, int k) {
    return lists[Sides::index(side)][static_cast<std::size_t>(k)];
  }
  static const Vec2& of(const Lists& lists, Side side, int k) {
    return lists[Sides::index(side)][static_cast<std::size_t>(k)];
  }

  Lists T_, T_rate_, v_change_;
};

}  // namespace fsi::solid
