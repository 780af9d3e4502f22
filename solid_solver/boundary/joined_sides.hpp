#pragma once
/// An interface that goes round the corners of a grid, along several of its sides.
///
///        side 2 (against)
///      o<--o<--o<--o<--o        At a corner two sides show one point. Their tractions and characteristics are added
///      |               ^        up as the forces on the two halves of the corner, per length of the chord between its
///      v     body      | side 1 neighbours, whose normal both gas and solid use there.
///      o-->o-->o-->o-->o
///        side 0 (along)

#include <cstddef>
#include <span>
#include <vector>

#include "solid_solver/boundary/interface.hpp"

namespace fsi::solid {

/// A side of the grid as part of an interface.
struct Stretch {
  Side side = Side::right;
  bool against = false;  ///< its index runs against the direction of the interface
};

class JoinedSides {
 public:
  /// @param points of each side, in the order of the interface  @param closed the last side ends where the first begins
  JoinedSides(std::vector<Stretch> stretches, const std::vector<int>& points, bool closed);

  std::span<const Stretch> stretches() const { return stretches_; }
  bool closed() const { return closed_; }
  /// Of the interface; a closed one has its first point again at the end.
  std::size_t points() const { return starts_.back() + 1; }

  /// Values of the points of the sides in the order of the interface; a corner gets those of the later side.
  /// @param sides component-major, as many components as `all` has
  void put_together(std::span<const std::span<const double>> sides, std::span<double> all) const;
  /// The interface as its sides show it.
  void join(std::span<const SolidInterface> sides, SolidInterface& whole) const;
  /// What the interface was told, for each side; reuses the memory of `sides`. `grid` is that of the sides.
  void split(const InterfaceValues& whole, std::vector<InterfaceValues>& sides);

 private:
  std::size_t count(std::size_t side) const { return starts_[side + 1] - starts_[side] + 1; }
  /// Index on a side of its m-th point along the interface.
  std::size_t at(std::size_t side, std::size_t m) const {
    return stretches_[side].against ? count(side) - 1 - m : m;
  }
  void join_corner(const SolidInterface& before, const SolidInterface& after, std::size_t side,
                   SolidInterface& whole) const;

  std::vector<Stretch> stretches_;
  bool closed_;
  std::vector<std::size_t> starts_;  ///< of the sides among the points of the interface, and the last point
  std::vector<std::vector<double>> values_;  ///< n, v_n, w_n of each side
};

}  // namespace fsi::solid
