#pragma once
/// SolidBoundary, fourth part: the sides of a body that several ranks share. A rank sets the conditions in its rows and
/// in its halo, from what it was brought, so nothing more is sent for them.

#include <algorithm>
#include <span>
#include <vector>

#include "solid_solver/boundary/solid_boundary.hpp"

namespace fsi::solid {

template <Law L>
bool SolidBoundary<L>::advanced(Side side, int k) const {
  const GridPoint p = grid_point(layout(), side, k);
  return held_.has(p.j) && grid_.points->is_discretised(p.i, p.j);
}

template <Law L>
void SolidBoundary<L>::take_rows(const RankRows& rows) {
  held_ = {};
  for (const Side side : all_sides) {
    advanced_[index(side)].clear();
    interpolated_[index(side)].clear();
    find_points(side);
    if (loaded(side)) lay_out_rows(side);
  }
  held_ = rows;
  for (const Side side : all_sides) {
    const auto elsewhere = [&](int k) { return !held_.has(grid_point(layout(), side, k).j); };
    std::erase_if(advanced_[index(side)], elsewhere);
    std::erase_if(interpolated_[index(side)], elsewhere);
    present_[index(side)] = false;
    for (int k = 0; k < line_of(side).n; ++k) present_[index(side)] = present_[index(side)] || !elsewhere(k);
  }
}

/// Calls action(numbers of a point) for the points of all sides in these rows.
template <Law L>
template <class Action>
void SolidBoundary<L>::each_scattered(const grid::RowRange& rows, const Action& action) const {
  for (const Side side : all_sides) {
    for (int k = 0; k < line_of(side).n; ++k) {
      if (rows.contains(grid_point(layout(), side, k).j)) action(index(side), static_cast<std::size_t>(k));
    }
  }
}

template <Law L>
std::vector<double> SolidBoundary<L>::scattered(const grid::RowRange& rows) const {
  std::vector<double> values;
  each_scattered(rows, [&](std::size_t side, std::size_t k) {
    for (const auto* list : {&T_, &T_rate_, &v_change_}) {
      const Vec2& value = (*list)[side][k];
      values.insert(values.end(), {value.x(), value.y()});
    }
  });
  return values;
}

template <Law L>
std::span<const double> SolidBoundary<L>::gather_scattered(const grid::RowRange& rows,
                                                           std::span<const double> values) {
  std::size_t next = 0;
  each_scattered(rows, [&](std::size_t side, std::size_t k) {
    for (auto* list : {&T_, &T_rate_, &v_change_}) {
      (*list)[side][k] = {values[next], values[next + 1]};
      next += 2;
    }
  });
  return values.subspan(next);
}

}  // namespace fsi::solid
