#include "solid_solver/boundary/sides/loaded_rows.hpp"

namespace fsi::solid {

namespace {

std::vector<int> discretised_points(const Sides& sides, Side side) {
  std::vector<int> points;
  for (int k = 0; k < sides.line(side).n; ++k) {
    const GridPoint p = grid_point(sides.layout(), side, k);
    if (sides.grid().points->is_discretised(p.i, p.j)) points.push_back(k);
  }
  return points;
}

}  // namespace

void LoadedRows::lay_out(const Sides& sides) {
  for (const Side side : all_sides) {
    if (!sides.loaded(side)) continue;
    const std::vector<int> points = discretised_points(sides, side);
    std::vector<std::size_t>& slots = slots_[Sides::index(side)];
    rows_[Sides::index(side)] = Field(Layout(static_cast<int>(points.size()), SideRows::count), 1);
    slots.resize(static_cast<std::size_t>(sides.line(side).n));
    const SideRows rows = of(side);
    for (std::size_t m = 0; m < points.size(); ++m) {
      const SideMetrics& s = sides.at(side, points[m]);
      slots[static_cast<std::size_t>(points[m])] = m;
      rows[SideRows::normal1][m] = s.n0.x();
      rows[SideRows::normal2][m] = s.n0.y();
      rows[SideRows::across1][m] = s.across.x();
      rows[SideRows::across2][m] = s.across.y();
      rows[SideRows::size][m] = s.across.norm();
      rows[SideRows::scale][m] = s.sign / s.across.norm();
    }
  }
}

}  // namespace fsi::solid
