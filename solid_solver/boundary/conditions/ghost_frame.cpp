#include "solid_solver/boundary/conditions/ghost_frame.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

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

/// The corner block beyond `across`, left or right, and `beside`, bottom or top: ghost lines of either side go on into it, and
/// where both do, by their mean. Which direction is the first of a grid then makes no difference.
void GhostFrame::extend_into_corner(FieldView q, Side across, Side beside) const {
  const Layout& layout = sides_.layout();
  const bool along1 = !sides_.condition(beside).open(), along2 = !sides_.condition(across).open();
  const SideIndex &line1 = sides_.line(beside), &line2 = sides_.line(across);
  const std::ptrdiff_t inward1 = line2.inward, inward2 = line1.inward;
  const std::ptrdiff_t corner =
      layout.at(at_upper_end(across) ? layout.n1 - 1 : 0, at_upper_end(beside) ? layout.n2 - 1 : 0);
  if (!along1 && !along2) return;
  for (int p = 0; p < plane::count; ++p) {
    // From the inside out: a point reads those before it.
    for (const auto& [m, n] : {std::pair(1, 1), {1, 2}, {2, 1}, {2, 2}}) {
      double* to = q.plane(p) + corner - m * inward1 - n * inward2;
      const auto extended = [&](std::ptrdiff_t inward) {
        return extrapolated(to[inward], to[2 * inward], to[3 * inward], to[4 * inward], sides_.limiter());
      };
      const double first = along1 ? extended(inward1) : extended(inward2);
      const double second = along2 ? extended(inward2) : first;
      *to = 0.5 * (first + second);
    }
  }
}

void GhostFrame::fill_corners(FieldView q, double t) const {
  constexpr int g = Layout::ghosts;
  for (const Side across : {Side::left, Side::right}) {
    for (const Side beside : {Side::bottom, Side::top}) extend_into_corner(q, across, beside);
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
