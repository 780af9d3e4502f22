// Which way the indices of a grid run makes no difference to the body.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "common/grid/geometry/interface_geometry.hpp"
#include "solid_solver/boundary/every_boundary.hpp"
#include "solid_solver/neo_hookean_solver.hpp"
#include "tests/convergence/solid/skewed_grid.hpp"

namespace fsi::solid::turned_grid {
namespace {

constexpr int cells1 = 8, cells2 = 10, steps = 5;

Vec2 rectangle(double r, double s) {
  return {r, 1.2 * s};
}
Vec2 parallelogram(double r, double s) {
  return {r - 0.4 * s, 1.2 * s + 0.3 * r};
}

/// Small waves for sides whose values are given.
SolidState given(double x, double y, double t) {
  return {.u = 0.01 * Vec2(std::sin(x + t), std::cos(y - t)),
          .v = 0.01 * Vec2(std::cos(x + t), std::sin(y - t)),
          .P = {0.01 * x, 0.02 * y, 0.015 * x * y, 0.01}};
}

const std::array boundaries{
    Boundary{.condition = Traction::condition,
             .vector = [](double x, double y, double t) -> Vec2 {
               return {0.1 * std::sin(x + t), 0.05 * y};
             }},
    Boundary{.condition = Interface::condition},
    Boundary{.condition = SlipWall::condition},
    Boundary{.condition = Symmetry::condition},
    Boundary{.condition = Displacement::condition,
             .vector = [](double x, double y, double t) { return given(x, y, t).u; },
             .velocity = [](double x, double y, double t) { return given(x, y, t).v; }},
    Boundary{.condition = Dirichlet::condition, .state = given},
};
const std::array names{"traction", "interface", "slip_wall", "symmetry", "displacement", "dirichlet"};

/// A body whose left and top side are of one kind and whose others are of another one, on a grid as it is or with its
/// indices turned by a right angle: what was the bottom is the left side then.
class Body {
 public:
  Body(test::Shape shape, std::size_t one, std::size_t other, bool turned)
      : solver_(grid(shape, turned), NeoHookean{.lambda = 20, .mu = 1},
                {.rho = 1.5,
                 .limiter = Limiter::minmod,
                 .tangential_stress = {.scaled = 0.5},
                 .displacement = {.scaled = 0.5},
                 .relaxation = {.scaled = 0.2}},
                sides(one, other, turned), 0),
        turned_(turned) {
    solver_.assign_initial_conditions(
        [](double x, double y, double) -> Vec2 {
          return {0.02 * std::sin(2 * x), 0.01 * x * y};
        },
        [](double x, double y, double) -> Vec2 {
          return {0.1 * std::sin(2 * x + 0.7 * y + 0.3), 0.07 * std::cos(x - 2 * y)};
        });
    apply_bcs();
  }

  double stable_step() const { return solver_.compute_time_step().dt; }
  void step(double dt) {
    solver_.advance_solid(t_, dt);
    t_ += dt;
    apply_bcs();
  }
  /// At the point with these indices of the grid that is not turned.
  double value(int plane, int i, int j) const {
    return turned_ ? solver_.state()(plane, j, cells1 - i) : solver_.state()(plane, i, j);
  }

 private:
  SolidSolver<NeoHookean> solver_;
  bool turned_;
  double t_ = 0;

  static grid::MovingGrid grid(test::Shape shape, bool turned) {
    return {{.name = "block",
             .n1 = (turned ? cells2 : cells1) + 1,
             .n2 = (turned ? cells1 : cells2) + 1,
             .mapping = [=](double r, double s, double) { return turned ? shape(1 - s, r) : shape(r, s); }},
            0};
  }
  static Boundaries sides(std::size_t one, std::size_t other, bool turned) {
    const Boundary &a = boundaries[one], &b = boundaries[other];
    return turned ? Boundaries{b, a, b, a} : Boundaries{a, b, b, a};
  }

  bool meets_gas(Side side) const { return solver_.condition(side).meets_gas(); }

  /// Where two interfaces meet, of both.
  std::vector<double> normals(Side side) const {
    const auto of = [&](Side one) {
      return grid::normals(solver_.grid().side_points(one), grid::Curve::open, grid::outward(one));
    };
    std::vector<double> n = of(side);
    const std::size_t points = n.size() / 2;
    for (const bool last : {false, true}) {
      const Side beyond = neighbour(side, last);
      if (!meets_gas(beyond)) continue;
      const std::vector<double> other = of(beyond);
      const std::size_t k = last ? points - 1 : 0, l = at_upper_end(side) ? other.size() / 2 - 1 : 0;
      const Vec2 mean = Vec2(n[k] + other[l], n[points + k] + other[other.size() / 2 + l]).normalized();
      n[k] = mean.x();
      n[points + k] = mean.y();
    }
    return n;
  }

  void apply_bcs() {
    std::array<std::vector<double>, 4> n, v_n, w_n;
    std::vector<InterfaceValues> projected;
    for (const Side side : all_sides) {
      if (!meets_gas(side)) continue;
      const auto m = static_cast<std::size_t>(side);
      const std::vector<double> x = solver_.grid().side_points(side);
      n[m] = normals(side);
      for (std::size_t k = 0, points = x.size() / 2; k < points; ++k) {
        v_n[m].push_back(0.02 * std::sin(x[k] + 2 * x[points + k] + t_));
        w_n[m].push_back(-0.1 * (1 + x[k] * std::cos(t_)));
      }
      projected.push_back({.side = side,
                           .n = n[m],
                           .v_n = v_n[m],
                           .w_n = w_n[m],
                           .goes_on = {meets_gas(neighbour(side, false)), meets_gas(neighbour(side, true))}});
    }
    solver_.apply_solid_bcs(t_, projected);
  }
};

/// Largest difference of the two bodies, in parts of the largest value of its plane.
double difference(const Body& one, const Body& other) {
  double most = 0;
  for (int p = 0; p < plane::count; ++p) {
    double apart = 0, size = 0;
    for (int j = 0; j <= cells2; ++j) {
      for (int i = 0; i <= cells1; ++i) {
        apart = std::max(apart, std::abs(one.value(p, i, j) - other.value(p, i, j)));
        size = std::max(size, std::abs(one.value(p, i, j)));
      }
    }
    most = std::max(most, apart / size);
  }
  return most;
}

TEST(TurnedGrid, MovesABodyAlikeWhateverMeetsAtItsCorners) {
  constexpr double round_off = 1e-12;
  for (const test::Shape shape : {rectangle, parallelogram, test::skewed_position}) {
    for (std::size_t one = 0; one < boundaries.size(); ++one) {
      for (std::size_t other = 0; other < boundaries.size(); ++other) {
        Body body(shape, one, other, false), turned(shape, one, other, true);
        for (int k = 0; k < steps; ++k) {
          const double dt = body.stable_step();
          EXPECT_NEAR(turned.stable_step(), dt, 1e-10 * dt);
          body.step(dt);
          turned.step(dt);
        }
        EXPECT_LT(difference(body, turned), round_off) << names[one] << " and " << names[other];
      }
    }
  }
}

}  // namespace
}  // namespace fsi::solid::turned_grid
