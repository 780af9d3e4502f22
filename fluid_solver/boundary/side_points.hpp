#pragma once
/// Walking along a side of a grid and away from it.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/core/field.hpp"
#include "common/core/types.hpp"
#include "common/grid/intervals.hpp"
#include "common/ranks/rows/rank_rows.hpp"

namespace fsi::fluid {

/// Point k of a side, m lines into the grid (m < 0: ghost lines).
///
///     m  2  .  .  .  .
///        1  .  .  .  .
///        0  o--o--o--o   side, k = 0 .. n - 1
///       -1  .  .  .  .
class SidePoints {
 public:
  SidePoints(const Layout& layout, Side side)
      : layout_(layout), side_(side), n_(direction_of(side) == 0 ? layout.n2 : layout.n1) {}
  /// `live` says of each point whether its values and ghosts are needed; empty: all are. `rows`: those that this
  /// rank has. `valid`: points that have a value of their own.
  SidePoints(const Layout& layout, Side side, std::span<const std::uint8_t> live, const RankRows& rows,
             const grid::RowSets& valid)
      : SidePoints(layout, side) {
    live_ = live;
    rows_ = &rows;
    valid_ = &valid;
  }

  /// Of points beyond the ends that of the end.
  bool live(int k) const {
    return !elsewhere(k) && (live_.empty() || live_[static_cast<std::size_t>(k < 0    ? 0
                                                                             : k < n_ ? k
                                                                                      : n_ - 1)] != 0);
  }

  struct Index {
    int i, j;
  };
  Index at(int k, int m) const {
    switch (side_) {
      case Side::left:
        return {m, k};
      case Side::right:
        return {layout_.n1 - 1 - m, k};
      case Side::bottom:
        return {k, m};
      default:
        return {k, layout_.n2 - 1 - m};
    }
  }
  int n() const { return n_; }
  /// Whether point k is in a row that another rank has.
  bool elsewhere(int k) const { return rows_ != nullptr && !rows_->has(row(k)); }
  /// Whether what happens at point k is to be counted: it has a value of its own, and of all ranks that have it this
  /// one owns it.
  bool counts(int k) const {
    const auto [i, j] = at(k, 0);
    return (rows_ == nullptr || rows_->owns(row(k))) && (valid_ == nullptr || valid_->contains(i, j));
  }
  Side side() const { return side_; }
  /// Number of the last line away from the side.
  int depth() const { return (direction_of(side_) == 0 ? layout_.n1 : layout_.n2) - 1; }
  /// The sides this one meets at k = 0 and at k = n - 1.
  std::array<Side, 2> neighbours() const {
    return direction_of(side_) == 0 ? std::array{Side::bottom, Side::top}
                                    : std::array{Side::left, Side::right};
  }

 private:
  Layout layout_;
  Side side_;
  int n_;
  std::span<const std::uint8_t> live_;
  const RankRows* rows_ = nullptr;
  const grid::RowSets* valid_ = nullptr;

  int row(int k) const { return direction_of(side_) == 0 ? k : side_ == Side::bottom ? 0 : layout_.n2 - 1; }
};

/// Position of point k, m lines into the grid.
inline Vec2 position(ConstFieldView x, const SidePoints& side, int k, int m) {
  const auto [i, j] = side.at(k, m);
  return {x(0, i, j), x(1, i, j)};
}

/// Derivative of a function of k along a side with points 0 <= k < n: central, at open ends one-sided and
/// second order. `open_first`, `open_last`: whether value(-1), value(n) must not be asked.
template <class Value>
auto along_side(const Value& value, int k, int n, bool open_first, bool open_last) {
  using Result = decltype(value(k));
  if (k == 0 && open_first) return Result(-1.5 * value(0) + 2.0 * value(1) - 0.5 * value(2));
  if (k == n - 1 && open_last) return Result(1.5 * value(n - 1) - 2.0 * value(n - 2) + 0.5 * value(n - 3));
  return Result(0.5 * (value(k + 1) - value(k - 1)));
}

}  // namespace fsi::fluid
