#pragma once
/// What must hold for every composite grid, checked point by point without any of its shortcuts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "common/grid/composite_grid.hpp"

namespace fsi::grid {

/// A closed polygon around the part of the plane behind a curve (or, with `outside`, around the domain).
struct Region {
  std::vector<Vec2> corners;
  bool outside = false;

  /// By the crossings of the vertical ray above the position.
  bool behind(const Vec2& x) const {
    bool in = false;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec2 &a = corners[k], &b = corners[(k + 1) % corners.size()];
      if ((a[0] <= x[0]) == (b[0] <= x[0])) continue;
      if (a[1] + (x[0] - a[0]) / (b[0] - a[0]) * (b[1] - a[1]) > x[1]) in = !in;
    }
    return in != outside;
  }
};

/// Region behind the line j of a closed grid.
inline Region region_of(ConstFieldView x, int j, bool outside = false) {
  Region region{{}, outside};
  for (int i = 0; i + 1 < x.layout.n1; ++i) region.corners.emplace_back(x(0, i, j), x(1, i, j));
  return region;
}

/// Kinds of all points of all grids: kinds[grid][j * n1 + i].
using Kinds = std::vector<std::vector<PointKind>>;

inline Kinds kinds_of(const CompositeGrid& grids) {
  Kinds kinds;
  for (int g = 0; g < grids.grids(); ++g) {
    const Layout shape = grids.layout(g);
    kinds.emplace_back();
    for (int j = 0; j < shape.n2; ++j) {
      for (int i = 0; i < shape.n1; ++i) kinds.back().push_back(grids.kind(g, i, j));
    }
  }
  return kinds;
}

class OverlapChecker {
 public:
  OverlapChecker(const CompositeGrid& grids, std::vector<Region> regions, int layers = 2)
      : grids_(grids), regions_(std::move(regions)), layers_(layers), kinds_(kinds_of(grids)) {}

  const Kinds& kinds() const { return kinds_; }

  /// Point sets against their definition; donors legal, complete, and where they say.
  void check(std::span<const ConstFieldView> x) {
    for (int g = 0; g < grids_.grids(); ++g) check_sets(g, x);
    std::map<std::tuple<int, int, int>, int> targets;
    for (const InterpolationList& list : grids_.interpolation()) check_list(list, x, kinds_, targets);
    check_targets(targets,
                  [&](int g, std::size_t at) { return kinds_[index(g)][at] == PointKind::interpolated; });
  }

  /// Exposed points: exactly those that have a value now and had none before.
  void check_exposed(const Kinds& before, std::span<const ConstFieldView> x_old) {
    std::map<std::tuple<int, int, int>, int> targets;
    for (const InterpolationList& list : grids_.exposed()) check_list(list, x_old, before, targets);
    check_targets(targets, [&](int g, std::size_t at) {
      return kinds_[index(g)][at] != PointKind::unused && before[index(g)][at] == PointKind::unused;
    });
  }

 private:
  const CompositeGrid& grids_;
  std::vector<Region> regions_;
  int layers_;
  Kinds kinds_;

  static std::size_t index(int k) { return static_cast<std::size_t>(k); }
  std::size_t at(int g, int i, int j) const { return index(j) * index(grids_.layout(g).n1) + index(i); }

  Vec2 position(int g, int i, int j, std::span<const ConstFieldView> x) const {
    if (g == 0) return grids_.background().point(i, j);
    return {x[index(g) - 1](0, i, j), x[index(g) - 1](1, i, j)};
  }

  /// Calls visit(i, j) for the points within reach, periodic where the grid is closed.
  template <class Visit>
  void around(int g, int i, int j, Visit&& visit) const {
    const Layout shape = grids_.layout(g);
    const bool closed = g > 0 && grids_.body(g).ends == Curve::closed;
    for (int b = std::max(j - layers_, 0); b <= std::min(j + layers_, shape.n2 - 1); ++b) {
      for (int a = i - layers_; a <= i + layers_; ++a) {
        const int period = shape.n1 - 1;
        if (closed) {
          visit((a + period) % period, b);
        } else if (a >= 0 && a < shape.n1) {
          visit(a, b);
        }
      }
    }
  }

  void check_sets(int g, std::span<const ConstFieldView> x) {
    const Layout shape = grids_.layout(g);
    std::vector<char> hole(shape.points()), discretised(shape.points());
    const auto& b = grids_.background();
    for (int j = 0; j < shape.n2; ++j) {
      for (int i = 0; i < shape.n1; ++i) {
        const Vec2 p = position(g, i, j, x);
        bool behind =
            p[0] < b.x_a - 1e-9 || p[0] > b.x_b + 1e-9 || p[1] < b.y_a - 1e-9 || p[1] > b.y_b + 1e-9;
        for (int r = 0; r < static_cast<int>(regions_.size()); ++r) {
          if (g == 0 || r != g - 1) behind = behind || regions_[index(r)].behind(p);
        }
        hole[at(g, i, j)] = behind;
      }
    }
    std::size_t wrong = 0;
    for (int j = 0; j < shape.n2; ++j) {
      for (int i = 0; i < shape.n1; ++i) {
        const bool below = g > 0 && grids_.body(g).curve == Side::bottom;
        bool inner = g == 0 || (below ? j < shape.n2 - layers_ : j >= layers_);
        around(g, i, j, [&](int a, int c) { inner = inner && !hole[at(g, a, c)]; });
        discretised[at(g, i, j)] = inner;
      }
    }
    for (int j = 0; j < shape.n2; ++j) {
      for (int i = 0; i < shape.n1; ++i) {
        bool needed = false;
        around(g, i, j, [&](int a, int c) { needed = needed || discretised[at(g, a, c)]; });
        const PointKind kind = discretised[at(g, i, j)]       ? PointKind::discretised
                               : needed && !hole[at(g, i, j)] ? PointKind::interpolated
                                                              : PointKind::unused;
        if (kind != kinds_[index(g)][at(g, i, j)]) ++wrong;
      }
    }
    EXPECT_EQ(wrong, 0U) << "points of grid " << g << " of another kind than their definition says";
  }

  void check_list(const InterpolationList& list, std::span<const ConstFieldView> x, const Kinds& kinds,
                  std::map<std::tuple<int, int, int>, int>& targets) const {
    const Layout to = grids_.layout(list.target_grid), from = grids_.layout(list.donor_grid);
    for (std::size_t k = 0; k < list.size(); ++k) {
      const auto place = [](const Layout& shape, std::int32_t offset) {
        return std::pair{(offset - Layout::lead) % shape.stride,
                         (offset - Layout::lead) / shape.stride - Layout::ghosts};
      };
      const auto [i, j] = place(to, list.target[k]);
      const auto [di, dj] = place(from, list.donor[k]);
      ++targets[{list.target_grid, i, j}];
      Vec2 mean = Vec2::Zero();
      double sum = 0;
      bool legal = true;
      for (int m = 0; m < list.width * list.width; ++m) {
        const int a = di + m % list.width, b = dj + m / list.width;
        const double w = list.weight[k * index(list.width * list.width) + index(m)];
        const PointKind kind = kinds[index(list.donor_grid)][at(list.donor_grid, a, b)];
        legal =
            legal && (kind == PointKind::discretised || (list.implicit && kind == PointKind::interpolated));
        mean += w * position(list.donor_grid, a, b, x);
        sum += w;
      }
      EXPECT_TRUE(legal) << "grid " << list.target_grid << " point " << i << ", " << j;
      EXPECT_NEAR(sum, 1, 1e-14);  // nine products of rounded numbers
      // The stencil's own map leads to the point: Newton's last step was below 1e-12 cells.
      EXPECT_LT((mean - position(list.target_grid, i, j, x)).norm(), 1e-13);
    }
  }

  template <class Wanted>
  void check_targets(const std::map<std::tuple<int, int, int>, int>& targets, Wanted&& wanted) const {
    std::size_t count = 0;
    for (int g = 0; g < grids_.grids(); ++g) {
      for (int j = 0; j < grids_.layout(g).n2; ++j) {
        for (int i = 0; i < grids_.layout(g).n1; ++i) count += wanted(g, at(g, i, j)) ? 1U : 0U;
      }
    }
    EXPECT_EQ(targets.size(), count);
    for (const auto& [point, times] : targets) {
      EXPECT_EQ(times, 1);
      EXPECT_TRUE(wanted(std::get<0>(point), at(std::get<0>(point), std::get<1>(point), std::get<2>(point))));
    }
  }
};

}  // namespace fsi::grid
