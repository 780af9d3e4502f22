#include "common/grid/overlap/disagreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fsi::grid {

namespace {

/// Bilinear value of a plane between the points (i, j) and (i + 1, j + 1), at (r, s) from the first one.
double between(ConstFieldView q, int plane, int i, int j, double r, double s) {
  const double *low = q.row(plane, j) + i, *high = q.row(plane, j + 1) + i;
  return (1 - s) * ((1 - r) * low[0] + r * low[1]) + s * ((1 - r) * high[0] + r * high[1]);
}

/// Are the cells around a point of a grid about as long and as wide as those of the background?
bool alike(const CartesianGrid& background, ConstFieldView x, int i, int j) {
  const double longest = unlike * std::min(background.dx(), background.dy()),
               shortest = std::max(background.dx(), background.dy()) / unlike;
  const int along = i > 0 ? -1 : 1, away = j > 0 ? -1 : 1;
  for (const auto& [m, n] : {std::pair(i + along, j), {i, j + away}}) {
    const double side = std::hypot(x(0, m, n) - x(0, i, j), x(1, m, n) - x(1, i, j));
    if (side < shortest || side > longest) return false;
  }
  return true;
}

}  // namespace

DisagreementWatch::DisagreementWatch(std::vector<WatchedQuantity> quantities, std::vector<std::string> grids)
    : Watch(std::move(quantities), grids), background_(std::move(grids.front())) {}

void DisagreementWatch::look(const CartesianGrid& background, std::span<const WatchedGrid> grids,
                             std::span<const double> ranges, double t) {
  begin();
  for (std::size_t g = 1; g < grids.size(); ++g) {
    const WatchedGrid& fitted = grids[g];
    for (int j = 0; j < fitted.q.layout.n2; ++j) {
      for (const Interval& run : fitted.points->row(j)) {
        for (int i = run.begin; i < run.end; ++i) {
          compare(background, grids, ranges,
                  {.grid = static_cast<int>(g),
                   .i = i,
                   .j = j,
                   .place = {fitted.x(0, i, j), fitted.x(1, i, j)},
                   .t = t});
        }
      }
    }
  }
}

/// At one point of a body-fitted grid.
void DisagreementWatch::compare(const CartesianGrid& background, std::span<const WatchedGrid> grids,
                                std::span<const double> ranges, Finding at) {
  const double r = (at.place.x() - background.x_a) / background.dx();
  const double s = (at.place.y() - background.y_a) / background.dy();
  const int i = static_cast<int>(std::floor(r)), j = static_cast<int>(std::floor(s));
  const WatchedGrid &beside = grids.front(), &fitted = grids[static_cast<std::size_t>(at.grid)];
  if (!beside.points->contains(Interval{i, i + 2}, j) ||
      !beside.points->contains(Interval{i, i + 2}, j + 1) || !alike(background, fitted.x, at.i, at.j))
    return;
  at.component = 0;
  for (std::size_t k = 0; k < quantities().size(); ++k) {
    for (int c = 0; c < quantities()[k].planes(); ++c, ++at.component) {
      const int plane = quantities()[k].first + c;
      at.size =
          std::fabs(fitted.q(plane, at.i, at.j) - between(beside.q, plane, i, j, r - i, s - j)) / ranges[k];
      keep(at);
    }
  }
}

std::string DisagreementWatch::in_words(const Finding& found) const {
  return fmt::format(
      R"({} differs by {:.2g} % of its range between grid "{}", point ({}, {}) at ({:.6g}, {:.6g}), and grid "{}", t = {:.4g})",
      component_of(found), 100 * found.size, grid_of(found), found.i, found.j, found.place.x(),
      found.place.y(), background_, found.t);
}

}  // namespace fsi::grid
