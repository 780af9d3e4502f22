#include "common/grid/moving_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "common/core/failure.hpp"

namespace fsi::grid {

namespace {

/// Uniform number in [-1, 1) that depends on its arguments only (splitmix64).
double random_number(std::uint64_t seed, std::uint64_t move, std::uint64_t point) {
  std::uint64_t z =
      seed * 0x9e3779b97f4a7c15ULL + move * 0xbf58476d1ce4e5b9ULL + point * 0x94d049bb133111ebULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1.0p-52 - 1.0;
}

/// Index pair of point k of a side, m lines inward (m < 0: ghost lines).
std::pair<int, int> side_index(const Layout& layout, Side side, int k, int m) {
  switch (side) {
    case Side::left:
      return {m, k};
    case Side::right:
      return {layout.n1 - 1 - m, k};
    case Side::bottom:
      return {k, m};
    case Side::top:
      return {k, layout.n2 - 1 - m};
  }
  return {0, 0};
}

/// Index along `side` of the corner it has in common with `other`.
int corner_index(const Layout& layout, Side side, Side other) {
  const int n = direction_of(side) == 0 ? layout.n2 : layout.n1;
  return at_upper_end(other) ? n - 1 : 0;
}

Vec2 point_at(std::span<const double> x, int k) {
  const auto at = static_cast<std::size_t>(k);
  return {x[at], x[x.size() / 2 + at]};
}

void put(const Vec2& point, int k, std::vector<double>& x) {
  const auto at = static_cast<std::size_t>(k);
  x[at] = point[0];
  x[x.size() / 2 + at] = point[1];
}

/// Cross product of the edges from (i, j) to its neighbours
/// at (i + a, j) and (i, j + b), positive when unfolded.
double corner_area(ConstFieldView x, int i, int j, int a, int b) {
  const double e1 = x(0, i + a, j) - x(0, i, j), e2 = x(1, i + a, j) - x(1, i, j);
  const double f1 = x(0, i, j + b) - x(0, i, j), f2 = x(1, i, j + b) - x(1, i, j);
  return a * b * (e1 * f2 - e2 * f1);
}

/// Cells between rows j and j + 1 with a corner that is not positive.
double folded_cells(ConstFieldView x, int j) {
  const double *a1 = x.row(0, j), *a2 = x.row(1, j), *b1 = x.row(0, j + 1), *b2 = x.row(1, j + 1);
  const int cells = x.layout.n1 - 1;
  double folded = 0;
#pragma omp simd reduction(+ : folded)
  for (int i = 0; i < cells; ++i) {
    const double south1 = a1[i + 1] - a1[i], south2 = a2[i + 1] - a2[i];
    const double north1 = b1[i + 1] - b1[i], north2 = b2[i + 1] - b2[i];
    const double west1 = b1[i] - a1[i], west2 = b2[i] - a2[i];
    const double east1 = b1[i + 1] - a1[i + 1], east2 = b2[i + 1] - a2[i + 1];
    const bool sound = (south1 * west2 - south2 * west1 > 0) & (south1 * east2 - south2 * east1 > 0) &
                       (north1 * west2 - north2 * west1 > 0) & (north1 * east2 - north2 * east1 > 0);
    folded += sound ? 0.0 : 1.0;
  }
  return folded;
}

}  // namespace

GridDescription marched_from(const HyperbolicGrid& grid, std::vector<double> curve) {
  return {.name = grid.name,
          .n1 = grid.points,
          .n2 = grid.lines,
          .mapping = {},
          .periodic1 = grid.ends == Curve::closed,
          .follows = true,
          .hyperbolic = grid,
          .curve = std::move(curve)};
}

MovingGrid::MovingGrid(GridDescription description, double t)
    : description_(std::move(description)), x_(Layout(description_.n1, description_.n2), 2) {
  if (description_.n1 < 5 || description_.n2 < 5) {
    throw UserMistake(fmt::format("grid \"{}\": {} x {} points are too few; each direction needs at least 5",
                                  name(), description_.n1, description_.n2));
  }
  if (description_.hyperbolic) march_.emplace(*description_.hyperbolic);
  if (march_) feet_ = {point_at(description_.curve, 0), point_at(description_.curve, description_.n1 - 1)};
  if (march_) {
    march(t, {});
  } else {
    place(t, x_.view());
  }
  if (moves()) remember_places();
  check(t);
}

/// Where the grid is becomes where it was.
void MovingGrid::remember_places() {
  x_mapped_ = march_ ? Field(layout(), 2) : x_.clone();
  x_old_ = x_.clone();
}

void MovingGrid::place(double t, FieldView x) const {
  const Layout& shape = layout();
  for (int j = -Layout::ghosts; j < shape.n2 + Layout::ghosts; ++j) {
    for (int i = -Layout::ghosts; i < shape.n1 + Layout::ghosts; ++i) {
      const Vec2 position = description_.mapping(static_cast<double>(i) / (shape.n1 - 1),
                                                 static_cast<double>(j) / (shape.n2 - 1), t);
      x(0, i, j) = position[0];
      x(1, i, j) = position[1];
    }
  }
}

void MovingGrid::move(double t, std::span<const SideCommand> commands) {
  if (stayed()) remember_places();
  std::swap(x_, x_old_);
  if (march_) {
    march(t, commands);
    return;
  }
  if (description_.moving) place(t, x_mapped_.view());
  std::ranges::copy(x_mapped_.values(), x_.values().begin());
  const std::vector<std::vector<double>> told = with_common_corners(t, commands);
  for (std::size_t k = 0; k < told.size(); ++k) follow(commands[k].side, told[k]);
  ++move_count_;
  if (description_.shake > 0) shake();
  check(t);
}

/// Line 0 goes where its side is told, or stays; the other lines are marched from it, which checks them.
void MovingGrid::march(double t, std::span<const SideCommand> commands) {
  for (const SideCommand& command : commands) {
    if (command.side != march_->grid().curve || command.x.size() != description_.curve.size()) {
      throw std::logic_error(fmt::format(
          "grid \"{}\": command for its {} side of {} numbers, but it is marched from {} on {}", name(),
          name_of(command.side), command.x.size(), description_.curve.size(), name_of(march_->grid().curve)));
    }
    std::ranges::copy(command.x, description_.curve.begin());
    for (const std::size_t end : {0U, 1U}) keep_on_wall(end, t);
  }
  march_->march(description_.curve, x_.view(), t);
}

/// An end that stands on a wall stays on it. Where the curve is not at right angles to the wall, what moves
/// its end along its normal takes it off the wall: the curve is led on along itself, or cut, to where it
/// meets the wall.
void MovingGrid::keep_on_wall(std::size_t end, double t) {
  const std::optional<Vec2>& wall = march_->grid().walls[end];
  if (!wall) return;
  const int n = description_.n1, k = end == 0 ? 0 : n - 1, inner = end == 0 ? 1 : n - 2;
  const Vec2 told = point_at(description_.curve, k), across((*wall)[1], -(*wall)[0]);
  const Vec2 last = told - point_at(description_.curve, inner);
  const double off = across.dot(feet_[end] - told), slope = across.dot(last) / last.norm();
  constexpr double round_off = 1e-9, most = 0.5, grazing = 0.1;
  if (std::abs(off) <= round_off * last.norm()) return;
  if (std::abs(off) > most * last.norm()) {
    throw Diverged(
        fmt::format("the end of its curve has left the wall it stands on, by {:.3g}; let the solid be "
                    "clamped there, or slide along the wall",
                    std::abs(off)),
        {.t = t, .grid = name(), .position = {told[0], told[1]}});
  }
  const Vec2 shift = std::abs(slope) > grazing ? Vec2(off / slope / last.norm() * last) : Vec2(off * across);
  put(told + shift, k, description_.curve);
}

/// Two sides with one corner: a command that others have gone before finds it where it belongs.
std::vector<std::vector<double>> MovingGrid::with_common_corners(
    double t, std::span<const SideCommand> commands) const {
  std::vector<std::vector<double>> told;
  for (const SideCommand& command : commands) {
    const int n = side_size(command.side);
    if (command.x.size() != static_cast<std::size_t>(2 * n)) {
      throw std::logic_error(
          fmt::format("grid \"{}\": command of {} numbers for {} points", name(), command.x.size(), n));
    }
    told.emplace_back(command.x.begin(), command.x.end());
  }
  for (std::size_t a = 0; a < told.size(); ++a) {
    for (std::size_t b = a + 1; b < told.size(); ++b) {
      if (direction_of(commands[a].side) == direction_of(commands[b].side)) continue;
      const Vec2 corner = common_corner(t, commands[a], commands[b]);
      put(corner, corner_index(layout(), commands[a].side, commands[b].side), told[a]);
      put(corner, corner_index(layout(), commands[b].side, commands[a].side), told[b]);
    }
  }
  return told;
}

/// The middle between where the two commands have it.
Vec2 MovingGrid::common_corner(double t, const SideCommand& a, const SideCommand& b) const {
  const int at_a = corner_index(layout(), a.side, b.side), at_b = corner_index(layout(), b.side, a.side);
  const Vec2 corner_a = point_at(a.x, at_a), corner_b = point_at(b.x, at_b);
  const double cell = std::min((point_at(a.x, at_a == 0 ? 1 : at_a - 1) - corner_a).norm(),
                               (point_at(b.x, at_b == 0 ? 1 : at_b - 1) - corner_b).norm());
  const double apart = (corner_a - corner_b).norm();
  if (!(apart < cell)) {
    throw Diverged(
        fmt::format("the commands for its sides {} and {} put their corner {:.3g} apart, here and at "
                    "({:.6g}, {:.6g}), more than the cell of {:.3g} there",
                    name_of(a.side), name_of(b.side), apart, corner_b[0], corner_b[1], cell),
        {.t = t, .grid = name(), .position = {corner_a[0], corner_a[1]}});
  }
  return 0.5 * (corner_a + corner_b);
}

/// Against where the side is, not where the mapping has it: what an adjacent side told before has moved it
/// by is taken off, so that nothing is left to add at their corner and that side stays. An opposite side
/// moved this one by nothing.
void MovingGrid::follow(Side side, std::span<const double> told) {
  constexpr int g = Layout::ghosts;
  const int n = side_size(side);
  const int lines = direction_of(side) == 0 ? layout().n1 : layout().n2;
  const bool closed = periodic(1 - direction_of(side));
  FieldView x = x_.view();
  std::vector<double> d(static_cast<std::size_t>(n + 2 * g));
  const auto at = [&d](int k) -> double& { return d[static_cast<std::size_t>(k + g)]; };
  for (int c = 0; c < 2; ++c) {
    for (int k = 0; k < n; ++k) {
      const auto [i, j] = side_index(layout(), side, k, 0);
      at(k) = told[static_cast<std::size_t>(c * n + k)] - x(c, i, j);
    }
    for (int k = 1; k <= g; ++k) {
      at(-k) = closed ? at(n - 1 - k) : 3 * at(1 - k) - 3 * at(2 - k) + at(3 - k);
      at(n - 1 + k) = closed ? at(k) : 3 * at(n - 2 + k) - 3 * at(n - 3 + k) + at(n - 4 + k);
    }
    for (int m = -g; m < lines + g; ++m) {
      const double weight = 1.0 - static_cast<double>(m) / (lines - 1);
      for (int k = -g; k < n + g; ++k) {
        const auto [i, j] = side_index(layout(), side, k, m);
        x(c, i, j) += weight * at(k);
      }
    }
  }
}

void MovingGrid::shake() {
  const Layout& shape = layout();
  const ConstFieldView mapped = x_mapped_.view();
  FieldView x = x_.view();
  for (int j = 1; j < shape.n2 - 1; ++j) {
    for (int i = 1; i < shape.n1 - 1; ++i) {
      const double cell = std::sqrt(std::abs(corner_area(mapped, i, j, 1, 1)));
      const auto point = static_cast<std::uint64_t>(shape.at(i, j)) * 2;
      for (int c = 0; c < 2; ++c) {
        x(c, i, j) +=
            description_.shake * cell *
            random_number(description_.shake_seed, move_count_, point + static_cast<std::uint64_t>(c));
      }
    }
  }
}

void MovingGrid::check(double t) const {
  const Layout& shape = layout();
  const ConstFieldView x = x_.view();
  for (int j = 0; j < shape.n2 - 1; ++j) {
    if (folded_cells(x, j) == 0) continue;
    for (int i = 0; i < shape.n1 - 1; ++i) {
      const double smallest =
          std::min({corner_area(x, i, j, 1, 1), corner_area(x, i + 1, j, -1, 1),
                    corner_area(x, i, j + 1, 1, -1), corner_area(x, i + 1, j + 1, -1, -1)});
      if (!(smallest > 0)) {
        throw Diverged(fmt::format("the cell from here on is folded, corner area = {:.3g}", smallest),
                       {.t = t, .grid = name(), .point = {i, j}, .position = {x(0, i, j), x(1, i, j)}});
      }
    }
  }
}

void MovingGrid::archive(Archive& archive) {
  if (!moves()) return;
  archive.values("x_mapped", x_mapped_.values());
  archive.values("x", x_.values());
  archive.values("x_old", x_old_.values());
  archive.values("curve", description_.curve);
  archive.number("moves", move_count_);
}

int MovingGrid::side_size(Side side) const {
  return direction_of(side) == 0 ? layout().n2 : layout().n1;
}

std::vector<double> MovingGrid::side_points(Side side) const {
  const int n = side_size(side);
  std::vector<double> points(static_cast<std::size_t>(2 * n));
  for (int c = 0; c < 2; ++c) {
    for (int k = 0; k < n; ++k) {
      const auto [i, j] = side_index(layout(), side, k, 0);
      points[static_cast<std::size_t>(c * n + k)] = x_(c, i, j);
    }
  }
  return points;
}

CartesianGrid background_of(const MovingGrid& grid) {
  const ConstFieldView x = grid.x();
  const int n1 = x.layout.n1, n2 = x.layout.n2;
  return {.name = grid.name(),
          .n1 = n1,
          .n2 = n2,
          .x_a = x(0, 0, 0),
          .x_b = x(0, n1 - 1, 0),
          .y_a = x(1, 0, 0),
          .y_b = x(1, 0, n2 - 1)};
}

}  // namespace fsi::grid
