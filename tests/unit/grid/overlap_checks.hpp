#pragma once
/// What must hold for every composite grid, checked point by point without any of its shortcuts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "common/grid/overlap/composite_grid.hpp"

namespace fsi::grid {

/// A closed polygon around the part of the plane behind a curve (or, with `outside`, around the domain).
struct Region {
  std::vector<Vec2> corners;
  bool outside;
  Vec2 low = Vec2::Constant(1e300), high = -low;

  Region(std::vector<Vec2> points, bool domain_inside) : corners(std::move(points)), outside(domain_inside) {
    for (const Vec2& corner : corners) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  }

  /// By the crossings of the vertical ray above the position.
  bool behind(const Vec2& x) const {
    if (x[0] < low[0] || x[0] > high[0] || x[1] < low[1] || x[1] > high[1]) return outside;
    bool in = false;
    Vec2 a = corners.back();
    for (const Vec2& b : corners) {
      const bool meets = (a[0] <= x[0]) != (b[0] <= x[0]);
      if (meets && a[1] + (x[0] - a[0]) / (b[0] - a[0]) * (b[1] - a[1]) > x[1]) in = !in;
      a = b;
    }
    return in != outside;
  }
};

/// Region behind the line j of a closed grid.
inline Region region_of(ConstFieldView x, int j, bool outside = false) {
  std::vector<Vec2> corners;
  for (int i = 0; i + 1 < x.layout.n1; ++i) corners.emplace_back(x(0, i, j), x(1, i, j));
  return {std::move(corners), outside};
}

/// Numbers of marked points in boxes around points, from sums over all boxes that start at the first point.
class BoxCount {
 public:
  BoxCount(const std::vector<char>& marked, const Layout& shape, bool closed, int reach)
      : n1_(shape.n1), n2_(shape.n2), reach_(reach), width_(shape.n1 + 2 * reach + 1) {
    sums_.assign(static_cast<std::size_t>(width_ * (n2_ + 1)), 0);
    for (int j = 0; j < n2_; ++j) {
      int row = 0;
      for (int a = -reach; a < n1_ + reach; ++a) {
        const int period = n1_ - 1, i = closed ? (a + period) % period : a;
        if (i >= 0 && i < n1_) row += marked[static_cast<std::size_t>(j * n1_ + i)];
        sum(a + reach + 1, j + 1) = sum(a + reach + 1, j) + row;
      }
    }
  }
  /// Marked points within reach of (i, j).
  int around(int i, int j) {
    const int left = i, right = i + 2 * reach_ + 1, low = std::max(j - reach_, 0),
              high = std::min(j + reach_ + 1, n2_);
    return sum(right, high) - sum(left, high) - sum(right, low) + sum(left, low);
  }

 private:
  int n1_, n2_, reach_, width_;
  std::vector<int> sums_;
  int& sum(int a, int b) { return sums_[static_cast<std::size_t>(b * width_ + a)]; }
};

/// Kinds of all points of all grids: kinds[grid][j * n1 + i].
using Kinds = std::vector<std::vector<PointKind>>;

inline Kinds kinds_of(const CompositeGrid& grids) {
  Kinds kinds;
  for (int g = 0; g < grids.grids(); ++g) {
    const Layout shape = grids.layout(g);
    kinds.emplace_back();
    kinds.back().resize(shape.points(), PointKind::unused);
    for (int j = 0; j < shape.n2; ++j) {
      for (const Interval& run : grids.valid(g).row(j)) {
        for (int i = run.begin; i < run.end; ++i) {
          kinds.back()[static_cast<std::size_t>(j * shape.n1 + i)] =
              grids.discretised(g).contains(i, j) ? PointKind::discretised : PointKind::interpolated;
        }
      }
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
    Marks targets = no_marks();
    for (const InterpolationList& list : grids_.interpolation()) check_list(list, x, kinds_, targets);
    check_targets(targets,
                  [&](int g, std::size_t at) { return kinds_[index(g)][at] == PointKind::interpolated; });
  }

  /// Exposed points: exactly those that have a value now and had none before.
  void check_exposed(const Kinds& before, std::span<const ConstFieldView> x_old) {
    Marks targets = no_marks();
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

  /// How often each point of each grid is a target.
  using Marks = std::vector<std::vector<int>>;

  Marks no_marks() const {
    Marks marks;
    for (int g = 0; g < grids_.grids(); ++g) marks.emplace_back(grids_.layout(g).points(), 0);
    return marks;
  }

  static std::size_t index(int k) { return static_cast<std::size_t>(k); }
  std::size_t at(int g, int i, int j) const { return index(j) * index(grids_.layout(g).n1) + index(i); }

  Vec2 position(int g, int i, int j, std::span<const ConstFieldView> x) const {
    if (g == 0) return grids_.background().point(i, j);
    return {x[index(g) - 1](0, i, j), x[index(g) - 1](1, i, j)};
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
    const bool closed = g > 0 && grids_.body(g).ends == Curve::closed;
    const bool below = g > 0 && grids_.body(g).curve == Side::bottom;
    BoxCount holes(hole, shape, closed, layers_);
    for (int j = 0; j < shape.n2; ++j) {
      const bool inner = g == 0 || (below ? j < shape.n2 - layers_ : j >= layers_);
      for (int i = 0; i < shape.n1; ++i) discretised[at(g, i, j)] = inner && holes.around(i, j) == 0;
    }
    BoxCount needs(discretised, shape, closed, layers_);
    std::size_t wrong = 0;
    for (int j = 0; j < shape.n2; ++j) {
      for (int i = 0; i < shape.n1; ++i) {
        PointKind kind = PointKind::unused;
        if (!hole[at(g, i, j)] && needs.around(i, j) > 0) kind = PointKind::interpolated;
        if (discretised[at(g, i, j)]) kind = PointKind::discretised;
        if (kind != kinds_[index(g)][at(g, i, j)]) ++wrong;
      }
    }
    EXPECT_EQ(wrong, 0U) << "points of grid " << g << " of another kind than their definition says";
  }

  void check_list(const InterpolationList& list, std::span<const ConstFieldView> x, const Kinds& kinds,
                  Marks& targets) const {
    double sum_error = 0, place_error = 0;
    std::size_t illegal = 0;
    const Layout to = grids_.layout(list.target_grid), from = grids_.layout(list.donor_grid);
    for (std::size_t k = 0; k < list.size(); ++k) {
      const auto place = [](const Layout& shape, std::int32_t offset) {
        return std::pair{(offset - Layout::lead) % shape.stride,
                         (offset - Layout::lead) / shape.stride - Layout::ghosts};
      };
      const auto [i, j] = place(to, list.target[k]);
      const auto [di, dj] = place(from, list.donor[k]);
      ++targets[index(list.target_grid)][at(list.target_grid, i, j)];
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
      illegal += legal ? 0U : 1U;
      sum_error = std::max(sum_error, std::abs(sum - 1));
      place_error = std::max(place_error, (mean - position(list.target_grid, i, j, x)).norm());
    }
    EXPECT_EQ(illegal, 0U) << "points of grid " << list.target_grid << " with donors that may not give";
    EXPECT_LT(sum_error, 1e-14);  // nine products of rounded numbers
    // The stencil's own map leads to the point: Newton's next step would be round-off.
    EXPECT_LT(place_error, 1e-13);
  }

  template <class Wanted>
  void check_targets(const Marks& targets, Wanted&& wanted) const {
    std::size_t wrong = 0;
    for (int g = 0; g < grids_.grids(); ++g) {
      for (std::size_t k = 0; k < grids_.layout(g).points(); ++k) {
        if (targets[index(g)][k] != (wanted(g, k) ? 1 : 0)) ++wrong;
      }
    }
    EXPECT_EQ(wrong, 0U) << "points that get no value, two values, or one they should not";
  }
};

}  // namespace fsi::grid
