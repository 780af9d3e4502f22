/// Which way the indices of a grid run makes no difference to the gas.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include "common/grid/geometry/interface_geometry.hpp"
#include "tests/unit/fluid/gas_runs.hpp"

namespace fsi::fluid::turned_grid {
namespace {

constexpr int cells1 = 8, cells2 = 10, steps = 4;

using Shape = Vec2 (*)(double r, double s, double t);

Vec2 swinging_rectangle(double r, double s, double t) {
  return {r + 0.05 * std::sin(3 * t), 1.2 * s};
}
Vec2 parallelogram(double r, double s, double t) {
  return {r - (0.4 - 0.05 * std::sin(3 * t)) * s, 1.2 * s + 0.3 * r};
}
Vec2 curved(double r, double s, double /*t*/) {
  return {r + 0.2 * s + 0.04 * std::sin(3 * s), s * (1 + 0.1 * r) + 0.05 * std::sin(3 * s) * std::sin(6 * r)};
}

/// No solution: walls, mirrors and open sides each make something else of it.
State waves(double x, double y, double t) {
  return {.rho = 1 + 0.1 * std::sin(2 * x + y - t),
          .v1 = 0.3 + 0.1 * std::cos(x - 2 * y + t),
          .v2 = -0.2 + 0.1 * std::sin(x + y),
          .p = 1 + 0.1 * std::cos(3 * x - y - t)};
}
/// What another open side is given.
State other_waves(double x, double y, double t) {
  return waves(y, x, -t);
}

const std::array<Boundary, 9> boundaries{Outflow{},      FarField{waves},      Inflow{other_waves},
                                         Imposed{waves}, Imposed{other_waves}, Dirichlet{waves},
                                         SlipWall{},     Interface{},          Symmetry{}};
const std::array names{"outflow",   "far_field", "inflow",    "imposed", "another imposed",
                       "dirichlet", "slip_wall", "interface", "symmetry"};
constexpr std::size_t symmetry = 8;  // a straight side, at right angles to its neighbours

/// A gas whose left and top side are of one kind and whose others are of another one, on a grid as it is or with its
/// indices turned by a right angle: what was the bottom is the left side then.
class Box {
 public:
  Box(Shape shape, std::size_t one, std::size_t other, bool turned)
      : sides_(sides(one, other, turned)),
        gas_(grid(shape, turned), {.linear_diffusion = 0.3}, sides_, 0),
        turned_(turned) {
    gas_.assign_initial_conditions(waves);
    apply_bcs();
  }

  double stable_step() const { return gas_.compute_time_step().dt; }
  void step(double dt) {
    t_ += dt;
    gas_.move_grids(t_, dt);
    gas_.advance_fluid(t_, dt);
    apply_bcs();
  }
  /// At the point with these indices of the grid that is not turned.
  double value(int plane, int i, int j) const {
    return turned_ ? gas_.state()(plane, j, cells1 - i) : gas_.state()(plane, i, j);
  }

 private:
  std::array<Boundary, 4> sides_;
  GasSolver gas_;
  bool turned_;
  double t_ = 0;

  static grid::MovingGrid grid(Shape shape, bool turned) {
    return {{.n1 = (turned ? cells2 : cells1) + 1,
             .n2 = (turned ? cells1 : cells2) + 1,
             .mapping = [=](double r, double s,
                            double t) { return turned ? shape(1 - s, r, t) : shape(r, s, t); },
             .moving = true},
            0};
  }
  static std::array<Boundary, 4> sides(std::size_t one, std::size_t other, bool turned) {
    const Boundary &a = boundaries[one], &b = boundaries[other];
    if (turned) return {b, a, b, a};
    return {a, b, b, a};
  }

  void apply_bcs() {
    std::vector<test::OwnedInterface> interfaces;
    for (const Side side : all_sides) {
      if (!std::holds_alternative<Interface>(sides_[static_cast<std::size_t>(side)])) continue;
      const std::vector<double> x = gas_.grid().side_points(side);
      const std::size_t points = x.size() / 2;
      test::OwnedInterface own{.side = side,
                               .n = grid::normals(x, grid::Curve::open, -grid::outward(side)),
                               .v_n = {},
                               .w_n = {},
                               .v = std::vector<double>(2 * points),
                               .a = std::vector<double>(2 * points)};
      for (std::size_t k = 0; k < points; ++k) {
        own.v_n.push_back(0.02 * std::sin(x[k] + 2 * x[points + k] + t_));
        own.w_n.push_back(-(1 + 0.1 * std::sin(x[k] - x[points + k] + t_)));
      }
      interfaces.push_back(own);
    }
    test::apply(gas_, t_, [&](const GasSolver&, double) { return interfaces; });
  }
};

double difference(const Box& one, const Box& other) {
  double most = 0;
  for (int p = 0; p < 4; ++p) {
    for (int j = 0; j <= cells2; ++j) {
      for (int i = 0; i <= cells1; ++i)
        most = std::max(most, std::fabs(one.value(p, i, j) - other.value(p, i, j)));
    }
  }
  return most;
}

TEST(TurnedGrid, MovesTheGasAlikeWhateverMeetsAtItsCorners) {
  constexpr double round_off = 1e-13;  // of values of the order of one
  for (const Shape shape : {swinging_rectangle, parallelogram, curved}) {
    const std::size_t kinds = shape == swinging_rectangle ? boundaries.size() : symmetry;
    for (std::size_t one = 0; one < kinds; ++one) {
      for (std::size_t other = 0; other < kinds; ++other) {
        Box box(shape, one, other, false), turned(shape, one, other, true);
        for (int k = 0; k < steps; ++k) {
          const double dt = box.stable_step();
          EXPECT_NEAR(turned.stable_step(), dt, 1e-12 * dt);
          box.step(dt);
          turned.step(dt);
        }
        EXPECT_LT(difference(box, turned), round_off) << names[one] << " and " << names[other];
      }
    }
  }
}

}  // namespace
}  // namespace fsi::fluid::turned_grid
