#include "common/grid/geometry/partition.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "common/core/component_major.hpp"
#include "common/grid/overlap/donor_search.hpp"

namespace fsi::grid {

namespace {

/// One body-fitted grid as a function of position: its weight before the others are looked at.
class Ramp {
 public:
  Ramp(const CompositeGrid& grids, int grid, ConstFieldView x)
      : body_(grids.body(grid)),
        valid_(grids.valid(grid)),
        cells_{.x = x, .closed = body_.ends == Curve::closed} {
    for (int j = 0; j < body_.n2; ++j) {
      if (!valid_.row(j).empty()) last_line_ = std::max(last_line_, line_of(j));
    }
    for (int j = 0; j < body_.n2; ++j) {
      for (int i = 0; i < body_.n1; ++i) {
        low_ = low_.cwiseMin(vector_at(x, i, j));
        high_ = high_.cwiseMax(vector_at(x, i, j));
      }
    }
  }

  const CellMap& cells() const { return cells_; }
  /// Weight of row coordinate j.
  double weight(double j) const {
    const double q = std::clamp(line_of(j) / last_line_, 0.0, 1.0);
    return 1.0 - q * q * q * (10.0 - q * (15.0 - 6.0 * q));
  }
  /// Weight at a position, the search started from cell (i, j); nothing where the grid has no values.
  std::optional<double> weight_at(const Vec2& position, int i, int j) const {
    const std::optional<CellPosition> cell = cells_.find(position, i, j);
    if (!cell) return {};
    const auto within = [](double part) { return part >= -rounding && part <= 1 + rounding; };
    if (!within(cell->r) || !within(cell->s)) return {};
    for (const int row : {cell->j, cell->j + 1}) {
      if (!valid_.contains({cell->i, cell->i + 2}, row)) return {};
    }
    Stencil stencil{.i = std::clamp(cell->i - (cell->r < 0.5 ? 1 : 0), 0, body_.n1 - 3),
                    .j = std::clamp(cell->j - (cell->s < 0.5 ? 1 : 0), 0, body_.n2 - 3)};
    stencil.r = cell->i - stencil.i + cell->r;
    stencil.s = cell->j - stencil.j + cell->s;
    if (!cells_.invert(position, stencil)) return weight(cell->j + cell->s);
    return weight(stencil.j + stencil.s);
  }
  /// The same without a start: from the nearest point.
  std::optional<double> weight_at(const Vec2& position) const {
    if ((position.array() < low_.array()).any() || (position.array() > high_.array()).any()) return {};
    double smallest = std::numeric_limits<double>::infinity();
    int i_start = 0, j_start = 0;
    for (int j = 0; j < body_.n2; ++j) {
      for (int i = 0; i < body_.n1; ++i) {
        const double distance = (vector_at(cells_.x, i, j) - position).squaredNorm();
        if (distance < smallest) smallest = distance, i_start = i, j_start = j;
      }
    }
    return weight_at(position, i_start, j_start);
  }

 private:
  const BodyFittedGrid& body_;
  const RowSets& valid_;
  CellMap cells_;
  double last_line_ = 1;
  Vec2 low_ = Vec2::Constant(std::numeric_limits<double>::infinity()), high_ = -low_;

  double line_of(double j) const { return body_.curve == Side::bottom ? j : body_.n2 - 1 - j; }
};

/// Products over the body-fitted grids from which the weights of all grids at a position follow.
struct Shares {
  double background = 1;  ///< prod (1 - w_m)
  double sum = 1;         ///< of the products of all grids

  /// Adds a grid of weight w: every other product takes the factor 1 - w, its own is w prod (1 - w_m).
  void add(double w) {
    sum = sum * (1.0 - w) + w * background;
    background *= 1.0 - w;
  }
};

/// Visits the background points that lie in the cells of a body-fitted grid, with its weight there.
template <class Visit>
void for_points_inside(const CartesianGrid& background, const Ramp& ramp, Visit&& visit) {
  const ConstFieldView x = ramp.cells().x;
  for (int j = 0; j + 1 < x.layout.n2; ++j) {
    for (int i = 0; i + 1 < x.layout.n1; ++i) {
      const Vec2 a = vector_at(x, i, j), b = vector_at(x, i + 1, j), c = vector_at(x, i, j + 1),
                 d = vector_at(x, i + 1, j + 1);
      const Vec2 low = a.cwiseMin(b).cwiseMin(c).cwiseMin(d), high = a.cwiseMax(b).cwiseMax(c).cwiseMax(d);
      const auto first = [](double from) {
        return std::max(static_cast<int>(std::ceil(from - rounding)), 0);
      };
      const auto end = [](double to, int n) {
        return std::min(static_cast<int>(std::floor(to + rounding)) + 1, n);
      };
      const auto column = [&](double at) { return (at - background.x_a) / background.dx(); };
      const auto row = [&](double at) { return (at - background.y_a) / background.dy(); };
      for (int l = first(row(low[1])); l < end(row(high[1]), background.n2); ++l) {
        for (int k = first(column(low[0])); k < end(column(high[0]), background.n1); ++k) {
          if (const auto w = ramp.weight_at(background.point(k, l), i, j)) visit(k, l, *w);
        }
      }
    }
  }
}

/// Background: prod (1 - w_m) over the sum.
Field background_weights(const CompositeGrid& grids, std::span<const Ramp> ramps) {
  const Layout shape = grids.layout(0);
  Field weights(shape, 1);
  std::vector<Shares> shares(shape.points());
  std::vector<int> seen(shape.points(), -1);
  for (std::size_t m = 0; m < ramps.size(); ++m) {
    for_points_inside(grids.background(), ramps[m], [&](int i, int j, double w) {
      const auto k = static_cast<std::size_t>(j * shape.n1 + i);
      if (std::exchange(seen[k], static_cast<int>(m)) != static_cast<int>(m)) shares[k].add(w);
    });
  }
  for (int j = 0; j < shape.n2; ++j) {
    for (const Interval& run : grids.valid(0).row(j)) {
      for (int i = run.begin; i < run.end; ++i) {
        const Shares& at = shares[static_cast<std::size_t>(j * shape.n1 + i)];
        weights(0, i, j) = at.background / at.sum;
      }
    }
  }
  return weights;
}

/// Has the background values about a position? One corner of its cell is enough: next to the curve, where the
/// background hardly weighs, the others are holes.
bool background_near(const CompositeGrid& grids, const Vec2& position) {
  const CellPosition cell = find_cell(grids.background(), position);
  const RowSets& valid = grids.valid(0);
  return valid.contains(cell.i, cell.j) || valid.contains(cell.i + 1, cell.j) ||
         valid.contains(cell.i, cell.j + 1) || valid.contains(cell.i + 1, cell.j + 1);
}

Field body_weights(const CompositeGrid& grids, std::span<const Ramp> ramps, int grid) {
  const Layout shape = grids.layout(grid);
  const Ramp& own = ramps[static_cast<std::size_t>(grid) - 1];
  Field weights(shape, 1);
  for (int j = 0; j < shape.n2; ++j) {
    const double w = own.weight(j);
    for (const Interval& run : grids.valid(grid).row(j)) {
      for (int i = run.begin; i < run.end; ++i) {
        Shares others;
        const Vec2 position = vector_at(own.cells().x, i, j);
        for (const Ramp& ramp : ramps) {
          if (&ramp == &own) continue;
          if (const auto other = ramp.weight_at(position)) others.add(*other);
        }
        Shares all = others;
        all.add(w);
        // Where the background has no value its share goes to the others.
        const double lost = background_near(grids, position) ? 0.0 : all.background;
        const double sum = all.sum - lost;
        weights(0, i, j) = sum > 0 ? w * others.background / sum : 0.0;
      }
    }
  }
  return weights;
}

double jacobian(ConstFieldView x, int i, int j) {
  const Vec2 along = 0.5 * (vector_at(x, i + 1, j) - vector_at(x, i - 1, j));
  const Vec2 across = 0.5 * (vector_at(x, i, j + 1) - vector_at(x, i, j - 1));
  return along[0] * across[1] - along[1] * across[0];
}

}  // namespace

std::vector<Field> partition_of_unity(const CompositeGrid& grids, std::span<const ConstFieldView> x) {
  std::vector<Ramp> ramps;
  for (int grid = 1; grid < grids.grids(); ++grid) {
    ramps.emplace_back(grids, grid, x[static_cast<std::size_t>(grid)]);
  }
  std::vector<Field> weights;
  weights.push_back(background_weights(grids, ramps));
  for (int grid = 1; grid < grids.grids(); ++grid) weights.push_back(body_weights(grids, ramps, grid));
  return weights;
}

std::vector<Field> area_weights(const CompositeGrid& grids, std::span<const ConstFieldView> x) {
  std::vector<Field> weights = partition_of_unity(grids, x);
  for (std::size_t grid = 0; grid < weights.size(); ++grid) {
    const Layout shape = weights[grid].layout();
    const double cell = grids.background().dx() * grids.background().dy();
    for (int j = 0; j < shape.n2; ++j) {
      const double end2 = j == 0 || j == shape.n2 - 1 ? 0.5 : 1.0;
      for (int i = 0; i < shape.n1; ++i) {
        const double end1 = i == 0 || i == shape.n1 - 1 ? 0.5 : 1.0;
        weights[grid](0, i, j) *= end1 * end2 * (grid == 0 ? cell : jacobian(x[grid], i, j));
      }
    }
  }
  return weights;
}

}  // namespace fsi::grid
