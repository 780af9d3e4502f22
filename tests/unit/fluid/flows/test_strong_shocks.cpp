// Shocks that a gas without viscosity does not keep.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/core/field.hpp"
#include "common/core/types.hpp"
#include "common/grid/intervals.hpp"
#include "fluid_solver/measures/strong_shocks.hpp"

namespace fsi::fluid {
namespace {

constexpr double shocked_gamma = 1.4;
constexpr int cells_each_way = 24;

/// rho, v, p of a flow along x, by the distance from its middle in cells.
struct Flow {
  double rho, v, p;
};

/// Gas at rest, into which a shock of that Mach number comes from the left, smeared over so many cells.
std::function<Flow(double)> shock(double mach, double cells) {
  const double m2 = mach * mach, a = std::sqrt(shocked_gamma);  // of rho = p = 1
  const Flow behind = {.rho = (shocked_gamma + 1) * m2 / ((shocked_gamma - 1) * m2 + 2),
                       .v = a * mach * (1 - ((shocked_gamma - 1) * m2 + 2) / ((shocked_gamma + 1) * m2)),
                       .p = (2 * shocked_gamma * m2 - (shocked_gamma - 1)) / (shocked_gamma + 1)};
  return [=](double x) {
    const double part = std::min(1.0, std::max(0.0, cells > 0 ? 0.5 - x / cells : double(x < 0)));
    return Flow{.rho = 1 + part * (behind.rho - 1), .v = part * behind.v, .p = 1 + part * (behind.p - 1)};
  };
}

/// What is found in the flow when x runs along rows or columns, forwards or backwards.
grid::Finding found(const std::function<Flow(double)>& flow, bool columns, bool back,
                    const grid::RowSets& points = grid::all_points(cells_each_way, cells_each_way)) {
  Field q({cells_each_way, cells_each_way}, 4), x({cells_each_way, cells_each_way}, 2);
  for (int j = 0; j < cells_each_way; ++j) {
    for (int i = 0; i < cells_each_way; ++i) {
      const int k = columns ? j : i;
      const auto [rho, v, p] = flow((back ? cells_each_way - 1 - k : k) - 11.5);
      q.view()(0, i, j) = rho;
      q.view()(columns ? 2 : 1, i, j) = back ? -v : v;
      q.view()(3, i, j) = p;
      x.view()(0, i, j) = 0.1 * i;
      x.view()(1, i, j) = 0.1 * j;
    }
  }
  ShockWatch watch(shocked_gamma, {"fluid"});
  const grid::WatchedGrid on{.q = q.view(), .x = x.view(), .points = &points};
  watch.look({&on, 1}, 0.5);
  EXPECT_EQ(watch.now().size, watch.worst().size);
  return watch.worst();
}

TEST(StrongShocks, AreFoundWithTheirMachNumberWhicheverWayTheyGo) {
  for (const bool columns : {false, true}) {
    for (const bool back : {false, true}) {
      for (const double mach : {1.6, 2.5, 6.0}) {
        for (const double cells : {0.0, 2.0, 3.0}) {
          const grid::Finding one = found(shock(mach, cells), columns, back);
          EXPECT_NEAR(one.size, mach, 1e-3 * mach) << columns << back << cells;
          EXPECT_NEAR(one.place[columns ? 1 : 0], 1.15, 0.6);  // the window begins up to four cells before
          EXPECT_EQ(one.t, 0.5);
        }
      }
      EXPECT_EQ(found(shock(1.4, 1), columns, back).size, 0);  // weak ones are not looked for
    }
  }
}

TEST(StrongShocks, AreNoExpansionsContactsOrSlopes) {
  const auto strong = shock(3, 2);
  // The gas that the pressure drives apart.
  EXPECT_EQ(found(
                [&](double x) {
                  return Flow{strong(x).rho, -strong(x).v, strong(x).p};
                },
                false, false)
                .size,
            0);
  // A jump of pressure alone, as of the first instant of a tube.
  EXPECT_EQ(found([&](double x) { return Flow{strong(x).rho, 0, strong(x).p}; }, false, false).size, 0);
  EXPECT_EQ(found([&](double x) { return Flow{strong(x).rho, strong(x).v, 1}; }, false, false).size, 0);
  // Of twelve cells, it is none that a grid captured: no part of it is as strong.
  EXPECT_LT(found(shock(3, 12), true, false).size, 2);
}

TEST(StrongShocks, AreNotLookedForAcrossPointsThatAreNotThere) {
  grid::RowSets points;
  points.clear();
  for (int j = 0; j < cells_each_way; ++j) {
    if (j < 11 || j > 12) points.append({0, cells_each_way});
    points.end_row();
  }
  EXPECT_EQ(found(shock(3, 0), true, false, points).size, 0);  // on both sides of a thin body
  EXPECT_GT(found(shock(3, 0), false, false, points).size, 2.9);
}

}  // namespace
}  // namespace fsi::fluid
