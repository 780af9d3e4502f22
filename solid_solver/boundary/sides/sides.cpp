#include "solid_solver/boundary/sides/sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/core/failure.hpp"

namespace fsi::solid {

Sides::Sides(BoundaryGrid grid, Boundaries boundaries, Limiter limiter)
    : grid_(std::move(grid)),
      boundaries_(std::move(boundaries)),
      limiter_(limiter),
      lines_{SideIndex(layout(), Side::left), SideIndex(layout(), Side::right),
             SideIndex(layout(), Side::bottom), SideIndex(layout(), Side::top)} {
  for (const Side side : all_sides) {
    for (int k = 0; k < line(side).n; ++k)
      metrics_[index(side)].push_back(side_metrics(*grid_.metrics, layout(), side, k));
  }
  for (const Side side : all_sides) {
    Condition& own = conditions_[index(side)];
    own = boundary(side).condition;
    // Mirror images need a grid that continues as its mirror image; a wall alone says the same without them.
    if (own.mirrored() && !mirrors(side)) own.ghosts = Condition::Ghosts::extrapolated;
    if (own.has_state() && !boundary(side).state) {
      throw UserMistake(
          fmt::format("grid \"{}\": side {} is a dirichlet side without a state", grid_.name, name_of(side)));
    }
    find_points(side);
  }
  check_pairs();
}

void Sides::check_pairs() const {
  for (const auto& [one, other] : {std::pair(Side::left, Side::right), std::pair(Side::bottom, Side::top)}) {
    if (condition(one).repeated() != condition(other).repeated()) {
      throw UserMistake(fmt::format("grid \"{}\": sides {} and {} must both be periodic or neither",
                                    grid_.name, name_of(one), name_of(other)));
    }
  }
}

/// The grid goes on beyond the side as its mirror image.
bool Sides::mirrors(Side side) const {
  const SideIndex& points = line(side);
  double defect = 0, size = 0;
  const Vec2 n = at(side, 0).n0;
  const Vec2 origin = position(points.at(0, 0));
  for (int k = 0; k < points.n; ++k) {
    for (int m = 0; m <= Layout::ghosts; ++m) {
      const Vec2 inside = position(points.at(k, m)), image = inside - 2.0 * n * n.dot(inside - origin);
      defect = std::max(defect, (position(points.at(k, -m)) - image).norm());
      size = std::max(size, (inside - origin).norm());
    }
  }
  return defect < 1e-10 * size;
}

void Sides::find_points(Side side) {
  advanced_[index(side)].clear();
  interpolated_[index(side)].clear();
  for (int k = 0; k < line(side).n; ++k) {
    const GridPoint p = grid_point(layout(), side, k);
    if (grid_.points->is_discretised(p.i, p.j)) {
      advanced_[index(side)].push_back(k);
    } else if (grid_.points->is_valid(p.i, p.j)) {
      interpolated_[index(side)].push_back(k);
    }
  }
}

bool Sides::advanced(Side side, int k) const {
  const GridPoint p = grid_point(layout(), side, k);
  return held_.has(p.j) && grid_.points->is_discretised(p.i, p.j);
}

bool Sides::reads_interpolated_points() const {
  return std::ranges::any_of(all_sides, [&](Side side) {
    return !condition(side).open() && !condition(side).repeated() && !interpolated(side).empty();
  });
}

void Sides::take_rows(const RankRows& rows) {
  held_ = rows;
  for (const Side side : all_sides) {
    const auto elsewhere = [&](int k) { return !held_.has(grid_point(layout(), side, k).j); };
    find_points(side);
    std::erase_if(advanced_[index(side)], elsewhere);
    std::erase_if(interpolated_[index(side)], elsewhere);
    present_[index(side)] = false;
    for (int k = 0; k < line(side).n; ++k) present_[index(side)] = present_[index(side)] || !elsewhere(k);
  }
}

bool Sides::turns_near(Side side, int k) const {
  if (!condition(side).meets_gas()) return false;
  const auto turns = [&](bool last) { return condition(neighbour(side, last)).meets_gas(); };
  return (k <= 1 && turns(false)) || (k >= line(side).n - 2 && turns(true));
}

}  // namespace fsi::solid
