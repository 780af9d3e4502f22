#include "solid_solver/boundary/sides/side_memory.hpp"

#include <string>

namespace fsi::solid {

SideMemory::SideMemory(const Sides& sides) {
  for (const Side side : all_sides) {
    for (Lists* lists : {&T_, &T_rate_, &v_change_})
      (*lists)[Sides::index(side)].assign(static_cast<std::size_t>(sides.line(side).n), Vec2::Zero());
  }
}

void SideMemory::archive(Archive& archive) {
  const auto vectors = [&](const std::string& name, std::vector<Vec2>& list) {
    archive.values(name, {list.empty() ? nullptr : list.front().data(), 2 * list.size()});
  };
  for (const Side side : all_sides) {
    archive.inside(name_of(side), [&] {
      vectors("T", T_[Sides::index(side)]);
      vectors("T_rate", T_rate_[Sides::index(side)]);
      vectors("v_change", v_change_[Sides::index(side)]);
    });
  }
}

namespace {

/// Calls action(point) for the points of all sides in these rows.
template <class Action>
void each_scattered(const Sides& sides, const grid::RowRange& rows, const Action& action) {
  for (const Side side : all_sides) {
    for (int k = 0; k < sides.line(side).n; ++k) {
      if (rows.contains(grid_point(sides.layout(), side, k).j)) action(SidePoint{side, k});
    }
  }
}

}  // namespace

std::vector<double> SideMemory::scattered(const Sides& sides, const grid::RowRange& rows) const {
  std::vector<double> values;
  each_scattered(sides, rows, [&](const SidePoint& p) {
    for (const Lists* lists : {&T_, &T_rate_, &v_change_}) {
      const Vec2& value = of(*lists, p.side, p.k);
      values.insert(values.end(), {value.x(), value.y()});
    }
  });
  return values;
}

std::span<const double> SideMemory::gather_scattered(const Sides& sides, const grid::RowRange& rows,
                                                     std::span<const double> values) {
  std::size_t next = 0;
  each_scattered(sides, rows, [&](const SidePoint& p) {
    for (Lists* lists : {&T_, &T_rate_, &v_change_}) {
      of(*lists, p.side, p.k) = {values[next], values[next + 1]};
      next += 2;
    }
  });
  return values.subspan(next);
}

}  // namespace fsi::solid
