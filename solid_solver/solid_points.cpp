#include "solid_solver/solid_points.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace fsi::solid {

SolidPoints::SolidPoints(const Layout& layout)
    : SolidPoints(layout, grid::all_points(layout.n1, layout.n2), grid::all_points(layout.n1, layout.n2)) {}

SolidPoints::SolidPoints(const Layout& layout, grid::RowSets discretised, grid::RowSets valid)
    : discretised_(std::move(discretised)), valid_(std::move(valid)) {
  find_neighbours(layout);
}

void SolidPoints::find_neighbours(const Layout& layout) {
  std::vector<grid::Interval> needed, rest;
  const auto row = [&](int j) {
    return j >= 0 && j < layout.n2 ? discretised(j) : std::span<const grid::Interval>();
  };
  const auto add = [&](int j, int reach) {
    for (const grid::Interval& run : row(j)) needed.push_back({run.begin - reach, run.end + reach});
  };
  columns_ = {layout.n1, 0};
  for (int j = -1; j <= layout.n2; ++j) {
    for (const grid::Interval& run : row(j))
      columns_ = {std::min(columns_.begin, run.begin), std::max(columns_.end, run.end)};
    needed.clear();
    rest.clear();
    add(j - 1, 0);
    add(j, 0);
    unite(needed);
    if (j >= 0) {
      faces_.append(needed);
      faces_.end_row();
    }
    add(j, 1);
    add(j + 1, 0);
    unite(needed);
    subtract(needed, row(j), rest);
    beside_.append(rest);
    beside_.end_row();
    predicted_.append(needed);
    predicted_.end_row();
  }
}

}  // namespace fsi::solid
