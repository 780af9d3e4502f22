#include "solid_solver/boundary/conditions/ghost_frame.hpp"

#include <algorithm>

namespace fsi::solid {

void GhostFrame::set_state(FieldView q, Side side, double t, int m) const {
  const SideIndex& line = sides_.line(side);
  const int beyond = m < 0 ? Layout::ghosts : 0;
  for (int k = -beyond; k < line.n + beyond; ++k) {
    const GridPoint p = grid_point(sides_.layout(), side, std::clamp(k, 0, line.n - 1));
    if (!sides_.grid().points->is_valid(p.i, p.j)) continue;
    const std::ptrdiff_t a = line.at(k, m);
    const Vec2 x = sides_.position(a);
    store(q, a, sides_.boundary(side).state(x.x(), x.y(), t));
  }
}

void GhostFrame::mirror(FieldView q, Side side, double t, const GhostRange& range) const {
  const SideIndex& line = sides_.line(side);
  const Vec2 n0 = sides_.at(side, 0).n0;
  if (!chosen_) return reflect(q, line, range, n0);
  for (int k = range.begin; k < range.end; ++k) {
    const std::ptrdiff_t ghost = line.at(k, range.m), inner = line.at(k, -range.m);
    const SolidState image = reflected(sum_of(load(q, inner), -1.0, chosen_.state(inner, t)), n0);
    store(q, ghost, sum_of(image, 1.0, chosen_.state(ghost, t)));
  }
}

void GhostFrame::fill_side(FieldView q, Side side, double t, const GhostRange& range) const {
  if (!sides_.present(side)) return;
  const SideIndex& line = sides_.line(side);
  switch (sides_.condition(side).ghosts) {
    case Condition::Ghosts::nothing:
      return;
    case Condition::Ghosts::repeated:
      return copy_period(q, line, range);
    case Condition::Ghosts::mirrored:
      return mirror(q, side, t, range);
    case Condition::Ghosts::state:
      return set_state(q, side, t, range.m);
    case Condition::Ghosts::extrapolated:
      return extrapolate(q, line, range, sides_.limiter());
  }
}

void GhostFrame::fill_line(FieldView q, double t, const GhostRange& range) const {
  for (const Side side : all_sides) {
    GhostRange own = range;
    own.begin = 0;
    own.end = sides_.line(side).n;
    fill_side(q, side, t, own);
  }
}

void GhostFrame::fill_corners(FieldView q, double t) const {
  constexpr int g = Layout::ghosts;
  for (const Side side : {Side::bottom, Side::top}) {
    if (sides_.condition(side).open()) continue;
    const SideIndex& line = sides_.line(side);
    for (int m = -1; m >= -g; --m) {
      extrapolate(q, line, {.m = m, .begin = -g, .end = 0}, sides_.limiter());
      extrapolate(q, line, {.m = m, .begin = line.n, .end = line.n + g}, sides_.limiter());
    }
  }
  for (const Side side : all_sides) {
    const SideIndex& line = sides_.line(side);
    if (!sides_.condition(side).imaged() && !sides_.condition(side).has_state()) continue;
    for (int m = -1; m >= -g; --m) {
      fill_side(q, side, t, {.m = m, .begin = -g, .end = 0});
      fill_side(q, side, t, {.m = m, .begin = line.n, .end = line.n + g});
    }
  }
}

void GhostFrame::refresh(FieldView q, double t) const {
  for (const Side side : all_sides) {
    if (sides_.condition(side).repeated() || sides_.condition(side).has_state()) continue;
    for (const int k : sides_.interpolated(side)) {
      for (int m = -1; m >= -Layout::ghosts; --m) fill_side(q, side, t, {.m = m, .begin = k, .end = k + 1});
    }
  }
  for (const Side side : all_sides) {
    if (!sides_.condition(side).repeated()) continue;
    const int n = sides_.line(side).n;
    for (int m = -1; m >= -Layout::ghosts; --m) {
      fill_side(q, side, t, {.m = m, .begin = -Layout::ghosts, .end = n + Layout::ghosts});
    }
  }
}

}  // namespace fsi::solid
