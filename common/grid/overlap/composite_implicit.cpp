/// Points of a composite grid that are donors of each other.

#include <fmt/format.h>

#include <algorithm>

#include "common/core/failure.hpp"
#include "common/grid/overlap/composite_grid.hpp"

namespace fsi::grid {

/// Factors the system of the points that are donors of each other, where it takes that. Where they would
/// amplify errors, they get fewer donors, a neighbourhood at a time.
void CompositeGrid::solve_for_implicit(double t) {
  std::vector<Layout> layouts;
  for (const Part& p : parts_) layouts.push_back(p.layout);
  const auto there_are = [this] {
    return std::ranges::any_of(interpolation_,
                               [](const auto& list) { return list.implicit && list.size() > 0; });
  };
  // A step of the solver does not feed on an amplification more than once.
  constexpr double sound = sound_amplification;
  // Then all points that depend on others for more than half of their value, then all.
  constexpr int neighbourhoods = 4;
  for (int round = 0;; ++round) {
    implicit_.reset();
    if (!there_are()) return;
    implicit_.emplace(interpolation_, layouts);
    if (implicit_->amplification() <= sound) return;
    if (round > neighbourhoods + 1) break;  // there is nothing left to lower
    const std::vector<ImplicitPoint> points =
        round < neighbourhoods ? implicit_->amplifiers(interpolation_)
                               : implicit_->dependents(interpolation_, round == neighbourhoods ? 0.5 : 0);
    narrow(points);
  }
  if (!(implicit_->amplification() < 1e3 * sound)) report_unsolved(implicit_->worst(), t);
}

/// Gives points two donors per direction in place of three.
void CompositeGrid::narrow(std::span<const ImplicitPoint> points) {
  for (std::size_t l = 0; l < interpolation_.size(); ++l) {
    InterpolationList& list = interpolation_[l];
    if (!list.implicit || list.width != 3) continue;
    std::size_t kept = 0;
    auto next = std::ranges::find(points, l, &ImplicitPoint::list);
    for (std::size_t k = 0; k < list.size(); ++k) {
      std::optional<Stencil> stencil;
      if (next != points.end() && *next == ImplicitPoint{l, k}) {
        ++next;
        const Vec2 x(list.x[k][0], list.x[k][1]);
        const int from_lead = list.donor[k] - Layout::lead, stride = part(list.donor_grid).layout.stride;
        Start start{
            .grid = list.donor_grid, .i = from_lead % stride, .j = from_lead / stride - Layout::ghosts};
        stencil = stencil_for(list.target_grid, x, start, present(2));
      }
      if (stencil) {
        list_for(interpolation_, list.target_grid, *stencil)
            .append(list.target[k], part(stencil->grid).layout.at(stencil->i, stencil->j), *stencil,
                    list.x[k]);
        ++counts_.narrowed;
      } else {
        list.move(k, kept++);
      }
    }
    list.cut(kept);
  }
}

CompositeGrid::GridPoint CompositeGrid::point_of(const ImplicitPoint& point) const {
  const InterpolationList& list = interpolation_[point.list];
  const Layout& layout = part(list.target_grid).layout;
  const int from_lead = list.target[point.point] - Layout::lead + Layout::ghosts;
  return {.grid = list.target_grid,
          .i = from_lead % layout.stride - Layout::ghosts,
          .j = from_lead / layout.stride - Layout::ghosts,
          .x = {list.x[point.point][0], list.x[point.point][1]}};
}

void CompositeGrid::note_worst(double t) {
  record_.implicit = std::max(record_.implicit, counts_.implicit);
  record_.narrowed = std::max(record_.narrowed, counts_.narrowed);
  record_.lines_left_out = std::max(record_.lines_left_out, counts_.lines_left_out);
  if (!implicit_ || implicit_->amplification() <= record_.amplification) return;
  const auto [grid, i, j, x] = point_of(implicit_->worst());
  record_.amplification = implicit_->amplification();
  record_.grid = grid, record_.i = i, record_.j = j, record_.x = x, record_.t = t;
}

void CompositeGrid::archive(Archive& archive) {
  archive.number("amplification", record_.amplification);
  archive.number("grid", record_.grid);
  archive.number("i", record_.i);
  archive.number("j", record_.j);
  archive.number("x1", record_.x[0]);
  archive.number("x2", record_.x[1]);
  archive.number("t", record_.t);
  archive.number("implicit", record_.implicit);
  archive.number("narrowed", record_.narrowed);
  archive.number("lines_left_out", record_.lines_left_out);
}

void CompositeGrid::report_unsolved(const ImplicitPoint& point, double t) const {
  const auto [grid, i, j, x] = point_of(point);
  throw Diverged(
      fmt::format("it and points of grid \"{}\" take their values from nothing but each other: the "
                  "overlap is too small",
                  name(interpolation_[point.list].donor_grid)),
      {.t = t, .grid = name(grid), .point = {i, j}, .position = {x[0], x[1]}});
}

}  // namespace fsi::grid
