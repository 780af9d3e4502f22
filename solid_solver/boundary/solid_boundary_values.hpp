#pragma once
/// SolidBoundary, first part: values that are given on the sides, and ghost points that follow from them by
/// extrapolation, reflection or repetition.

#include <algorithm>

#include "solid_solver/boundary/solid_boundary.hpp"

namespace fsi::solid {

template <Law L>
SolidBoundary<L>::SolidBoundary(BoundaryGrid grid, const L& law, double rho, Boundaries boundaries,
                                Limiter limiter, double time_scale)
    : grid_(std::move(grid)),
      lines_{SideIndex(layout(), Side::left), SideIndex(layout(), Side::right),
             SideIndex(layout(), Side::bottom), SideIndex(layout(), Side::top)},
      law_(law),
      rho_(rho),
      boundaries_(std::move(boundaries)),
      limiter_(limiter),
      time_scale_(time_scale) {
  for (const Side side : all_sides) {
    for (int k = 0; k < line_of(side).n; ++k)
      metrics_[index(side)].push_back(side_metrics(*grid_.metrics, layout(), side, k));
  }
  for (const Side side : all_sides) {
    Kind& own = kinds_[index(side)];
    own = boundaries_[index(side)].kind;
    // Mirror images need a grid that continues as its mirror image; slip says the same without them.
    if (own == Kind::symmetry && !mirrored(side)) own = Kind::slip;
    if (own == Kind::dirichlet && !boundaries_[index(side)].state) {
      throw UserMistake(
          fmt::format("grid \"{}\": side {} is a dirichlet side without a state", grid_.name, name_of(side)));
    }
    const SideIndex& line = line_of(side);
    find_points(side);
    if (loaded(side)) lay_out_rows(side);
    T_[index(side)].assign(static_cast<std::size_t>(line.n), Vec2::Zero());
    T_rate_[index(side)] = v_change_[index(side)] = T_[index(side)];
  }
  for (const auto& [one, other] : {std::pair(Side::left, Side::right), std::pair(Side::bottom, Side::top)}) {
    if ((kind(one) == Kind::periodic) != (kind(other) == Kind::periodic)) {
      throw UserMistake(fmt::format("grid \"{}\": sides {} and {} must both be periodic or neither",
                                    grid_.name, name_of(one), name_of(other)));
    }
  }
}

template <Law L>
void SolidBoundary<L>::find_points(Side side) {
  const SideIndex& line = line_of(side);
  for (int k = 0; k < line.n; ++k) {
    const GridPoint p = grid_point(layout(), side, k);
    if (grid_.points->is_discretised(p.i, p.j)) {
      advanced_[index(side)].push_back(k);
    } else if (grid_.points->is_valid(p.i, p.j)) {
      interpolated_[index(side)].push_back(k);
    }
  }
}

template <Law L>
void SolidBoundary<L>::lay_out_rows(Side side) {
  const std::span<const int> list = points(side);
  rows_[index(side)] = Field(Layout(static_cast<int>(list.size()), SideRows::count), 1);
  slots_[index(side)].resize(static_cast<std::size_t>(line_of(side).n));
  const SideRows rows = rows_of(side);
  for (std::size_t m = 0; m < list.size(); ++m) {
    const SideMetrics& s = at(side, list[m]);
    slots_[index(side)][static_cast<std::size_t>(list[m])] = m;
    rows[SideRows::normal1][m] = s.n0.x();
    rows[SideRows::normal2][m] = s.n0.y();
    rows[SideRows::across1][m] = s.across.x();
    rows[SideRows::across2][m] = s.across.y();
    rows[SideRows::size][m] = s.across.norm();
    rows[SideRows::scale][m] = s.sign / s.across.norm();
  }
}

template <Law L>
bool SolidBoundary<L>::reads_interpolated_points() const {
  return std::ranges::any_of(all_sides, [&](Side side) {
    return kind(side) != Kind::none && kind(side) != Kind::periodic && !interpolated_[index(side)].empty();
  });
}

template <Law L>
bool SolidBoundary<L>::mirrored(Side side) const {
  const SideIndex& line = line_of(side);
  double defect = 0, size = 0;
  const Vec2 n = at(side, 0).n0;
  const Vec2 origin = position(line.at(0, 0));
  for (int k = 0; k < line.n; ++k) {
    for (int m = 0; m <= Layout::ghosts; ++m) {
      const Vec2 inside = position(line.at(k, m)), image = inside - 2.0 * n * n.dot(inside - origin);
      defect = std::max(defect, (position(line.at(k, -m)) - image).norm());
      size = std::max(size, (inside - origin).norm());
    }
  }
  return defect < 1e-10 * size;
}

template <Law L>
std::optional<typename SolidBoundary<L>::Motion> SolidBoundary<L>::given_motion(Side side, int k,
                                                                                double t) const {
  const SideIndex& line = line_of(side);
  if (!end_of(line, k)) return std::nullopt;
  const Side other = neighbour(side, k != 0);
  const Vec2 x = position(line.at(k, 0));
  if (kind(other) == Kind::displacement) return displacement_of(other, x, t);
  if (kind(other) != Kind::dirichlet) return std::nullopt;
  const SolidState given = boundaries_[index(other)].state(x.x(), x.y(), t);
  return Motion{.u = given.u, .v = given.v};
}

template <Law L>
std::optional<Vec2> SolidBoundary<L>::wall_of(Side side, int k) const {
  const SideIndex& line = line_of(side);
  if (!end_of(line, k)) return std::nullopt;
  const Kind other = kind(neighbour(side, k != 0));
  if (other != Kind::slip && other != Kind::symmetry) return std::nullopt;
  return side_normal_at_end(side, k);
}

template <Law L>
bool SolidBoundary<L>::imaged(Side side, int end) const {
  const Kind other = kind(neighbour(side, end != 0));
  return other == Kind::periodic || other == Kind::symmetry;
}

template <Law L>
bool SolidBoundary<L>::inner(Side side, int k) const {
  const SideIndex& line = line_of(side);
  if (!end_of(line, k) || imaged(side, k)) return true;
  return loaded(side) && kind(neighbour(side, k != 0)) == Kind::slip;
}

template <Law L>
Vec2 SolidBoundary<L>::difference_along(ConstFieldView q, const SideIndex& line, int first, int k) {
  const std::ptrdiff_t next = line.at(k + 1, 0), last = line.at(k - 1, 0);
  return {0.5 * (q.plane(first)[next] - q.plane(first)[last]),
          0.5 * (q.plane(first + 1)[next] - q.plane(first + 1)[last])};
}

template <Law L>
SolidState SolidBoundary<L>::chosen(std::ptrdiff_t at, double t) const {
  if (chosen_ == nullptr) return {};
  const Vec2 x = position(at);
  return chosen_->state(x.x(), x.y(), t);
}

template <Law L>
Tensor2 SolidBoundary<L>::chosen_offset(std::ptrdiff_t at, double t) const {
  if (chosen_ == nullptr) return {};
  const Vec2 x = position(at);
  return chosen_->offset(x.x(), x.y(), t);
}

/// Of the stress.
template <Law L>
Tensor2 SolidBoundary<L>::chosen_source(std::ptrdiff_t at, double t) const {
  if (chosen_ == nullptr) return {};
  const Vec2 x = position(at);
  return chosen_->source(x.x(), x.y(), t).P;
}

/// K grad v of the chosen solution: what its source leaves of dP/dt.
template <Law L>
Tensor2 SolidBoundary<L>::chosen_strain_rate(std::ptrdiff_t at, double t) const {
  if (chosen_ == nullptr) return {};
  const double delta = 1e-3 * time_scale_;
  const SolidState change = sum_of(chosen(at, t + delta), -1.0, chosen(at, t - delta));
  return minus(sum_of(SolidState{}, 0.5 / delta, change).P, chosen_source(at, t));
}

template <Law L>
void SolidBoundary<L>::project_velocity(FieldView q, double t, const InterfaceValues& values) {
  if (!present(values.side)) return;
  const SideIndex& line = line_of(values.side);
  const auto n = static_cast<std::size_t>(line.n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::ptrdiff_t a = line.at(static_cast<int>(k), 0);
    double &v1 = q.plane(plane::v1)[a], &v2 = q.plane(plane::v2)[a];
    const Vec2 exact = chosen(a, t).v;
    const double change =
        values.v_n[k] - (values.n[k] * (v1 - exact.x()) + values.n[n + k] * (v2 - exact.y()));
    v1 += change * values.n[k];
    v2 += change * values.n[n + k];
    v_change_[index(values.side)][k] = change * Vec2(values.n[k], values.n[n + k]);
  }
}

/// Later kinds win at corners: interface, slip and symmetry, displacement, exact state.
template <Law L>
void SolidBoundary<L>::set_motion(FieldView q, double t, std::span<const InterfaceValues> projected) {
  for (const InterfaceValues& values : projected) {
    if (values.grid == grid_.index) project_velocity(q, t, values);
  }
  for (const Side side : all_sides) {
    if (kind(side) == Kind::slip || kind(side) == Kind::symmetry) remove_normal_motion(q, side, t);
  }
  for (const Side side : all_sides) {
    if (kind(side) == Kind::displacement) set_given_motion(q, side, t);
    if (kind(side) == Kind::periodic && at_upper_end(side)) {
      const SideIndex& line = line_of(side);
      copy_period(q, line, {.m = 0, .begin = 0, .end = line.n});
    }
  }
  for (const Side side : all_sides) {
    if (kind(side) == Kind::dirichlet) set_exact(q, side, t, 0);
  }
}

template <Law L>
typename SolidBoundary<L>::Motion SolidBoundary<L>::displacement_of(Side side, const Vec2& x,
                                                                    double t) const {
  const Boundary& boundary = boundaries_[index(side)];
  Motion motion{.u = Vec2::Zero(), .v = Vec2::Zero()};
  if (boundary.vector) motion.u = boundary.vector(x.x(), x.y(), t);
  if (boundary.velocity) motion.v = boundary.velocity(x.x(), x.y(), t);
  return motion;
}

template <Law L>
void SolidBoundary<L>::set_given_motion(FieldView q, Side side, double t) {
  const SideIndex& line = line_of(side);
  for (const int k : points(side)) {
    const std::ptrdiff_t a = line.at(k, 0);
    const auto [u, v] = displacement_of(side, position(a), t);
    Vec2& change = v_change_[index(side)][static_cast<std::size_t>(k)];
    for (int c = 0; c < 2; ++c) {
      q.plane(plane::u1 + c)[a] = u[c];
      change[c] = v[c] - q.plane(plane::v1 + c)[a];
      q.plane(plane::v1 + c)[a] = v[c];
    }
  }
}

/// n0 . u = n0 . v = 0 for the difference to the chosen solution; where two such sides meet at an angle the
/// corner does not move at all.
template <Law L>
void SolidBoundary<L>::remove_normal_motion(FieldView q, Side side, double t) {
  constexpr double parallel = 1e-6;
  const SideIndex& line = line_of(side);
  for (const int k : points(side)) {
    const std::ptrdiff_t a = line.at(k, 0);
    const Vec2 n = at(side, k).n0;
    const SolidState exact = chosen(a, t);
    SolidState s = sum_of(load(q, a), -1.0, exact);
    s.u -= n * n.dot(s.u);
    v_change_[index(side)][static_cast<std::size_t>(k)] = -n * n.dot(s.v);
    s.v -= n * n.dot(s.v);
    const Side other = neighbour(side, k != 0);
    if (end_of(line, k) && (kind(other) == Kind::slip || kind(other) == Kind::symmetry)) {
      const Vec2 m = at(other, at_upper_end(side) ? line_of(other).n - 1 : 0).n0;
      if (std::abs(n.x() * m.y() - n.y() * m.x()) > parallel) s.u = s.v = Vec2::Zero();
    }
    store(q, a, sum_of(s, 1.0, exact));
  }
}

template <Law L>
void SolidBoundary<L>::set_exact(FieldView q, Side side, double t, int m) const {
  const SideIndex& line = line_of(side);
  const int beyond = m < 0 ? Layout::ghosts : 0;
  for (int k = -beyond; k < line.n + beyond; ++k) {
    const GridPoint p = grid_point(layout(), side, std::clamp(k, 0, line.n - 1));
    if (!grid_.points->is_valid(p.i, p.j)) continue;
    const std::ptrdiff_t a = line.at(k, m);
    const Vec2 x = position(a);
    store(q, a, boundaries_[index(side)].state(x.x(), x.y(), t));
  }
}

template <Law L>
void SolidBoundary<L>::mirror(FieldView q, Side side, double t, const GhostRange& range) const {
  const SideIndex& line = line_of(side);
  const Vec2 n0 = at(side, 0).n0;
  if (chosen_ == nullptr) return reflect(q, line, range, n0);
  for (int k = range.begin; k < range.end; ++k) {
    const std::ptrdiff_t ghost = line.at(k, range.m), inner = line.at(k, -range.m);
    const SolidState image = reflected(sum_of(load(q, inner), -1.0, chosen(inner, t)), n0);
    store(q, ghost, sum_of(image, 1.0, chosen(ghost, t)));
  }
}

template <Law L>
void SolidBoundary<L>::fill_side(FieldView q, Side side, double t, const GhostRange& range) const {
  if (!present(side)) return;
  const SideIndex& line = line_of(side);
  switch (kind(side)) {
    case Kind::none:
      break;
    case Kind::periodic:
      copy_period(q, line, range);
      break;
    case Kind::symmetry:
      mirror(q, side, t, range);
      break;
    case Kind::dirichlet:
      set_exact(q, side, t, range.m);
      break;
    default:
      extrapolate(q, line, range, limiter_);
  }
}

/// Ghost line range.m of all sides, beside the boundary points only.
template <Law L>
void SolidBoundary<L>::fill_line(FieldView q, double t, const GhostRange& range) const {
  for (const Side side : all_sides) {
    GhostRange own = range;
    own.begin = 0;
    own.end = line_of(side).n;
    fill_side(q, side, t, own);
  }
}

/// The corner blocks of the ghost frame: bottom and top over their full width by extrapolation, then the
/// sides that know better (mirror images, repetition, exact values) over theirs.
template <Law L>
void SolidBoundary<L>::fill_frame(FieldView q, double t) const {
  constexpr int g = Layout::ghosts;
  for (const Side side : {Side::bottom, Side::top}) {
    if (kind(side) == Kind::none) continue;
    const SideIndex& line = line_of(side);
    for (int m = -1; m >= -g; --m) {
      extrapolate(q, line, {.m = m, .begin = -g, .end = 0}, limiter_);
      extrapolate(q, line, {.m = m, .begin = line.n, .end = line.n + g}, limiter_);
    }
  }
  for (const Side side : all_sides) {
    const SideIndex& line = line_of(side);
    if (kind(side) != Kind::periodic && kind(side) != Kind::symmetry && kind(side) != Kind::dirichlet)
      continue;
    for (int m = -1; m >= -g; --m) {
      fill_side(q, side, t, {.m = m, .begin = -g, .end = 0});
      fill_side(q, side, t, {.m = m, .begin = line.n, .end = line.n + g});
    }
  }
}

/// Repetition last: it also carries the ghost points of other sides.
template <Law L>
void SolidBoundary<L>::refresh_ghosts(FieldView q, double t) const {
  for (const Side side : all_sides) {
    if (kind(side) == Kind::periodic || kind(side) == Kind::dirichlet) continue;
    for (const int k : interpolated_[index(side)]) {
      for (int m = -1; m >= -Layout::ghosts; --m) fill_side(q, side, t, {.m = m, .begin = k, .end = k + 1});
    }
  }
  for (const Side side : all_sides) {
    if (kind(side) != Kind::periodic) continue;
    const int n = line_of(side).n;
    for (int m = -1; m >= -Layout::ghosts; --m) {
      fill_side(q, side, t, {.m = m, .begin = -Layout::ghosts, .end = n + Layout::ghosts});
    }
  }
}

template <Law L>
void SolidBoundary<L>::broke(Side side, int k, double t) const {
  const GridPoint p = grid_point(layout(), side, k);
  if (!held_.owns(p.j)) return;
  const Vec2 T = T_[index(side)][static_cast<std::size_t>(k)];
  throw NumbersBroke(
      fmt::format("on side {} the law {} cannot bear the traction ({:.4g}, {:.4g}) per reference area "
                  "and stay hyperbolic",
                  name_of(side), L::name, T.x(), T.y()),
      {.t = t, .grid = grid_.name, .point = {p.i, p.j}});
}

template <Law L>
void SolidBoundary<L>::archive(Archive& archive) {
  const auto vectors = [&](const std::string& name, std::vector<Vec2>& list) {
    archive.values(name, {list.empty() ? nullptr : list.front().data(), 2 * list.size()});
  };
  for (const Side side : all_sides) {
    archive.inside(name_of(side), [&] {
      vectors("T", T_[index(side)]);
      vectors("T_rate", T_rate_[index(side)]);
      vectors("v_change", v_change_[index(side)]);
    });
  }
}

}  // namespace fsi::solid
