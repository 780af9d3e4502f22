#pragma once
/// A block whose outline the coupler's projection moves, in a light gas that may press it.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "common/grid/geometry/interface_geometry.hpp"
#include "common/interface/riemann.hpp"
#include "solid_solver/boundary/joined_sides.hpp"
#include "tests/convergence/solid/noise_growth.hpp"

namespace fsi::solid::test {

struct GasAround {
  double z_f = 2e-3;  ///< its impedance over that of the solid at rest [-]
  Limiter limiter = Limiter::none;
  bool below = true;  ///< there as well; else the bottom is free, of a body at rest
};

template <class L>
class BlockInGas {
 public:
  /// Squeezed alike in all directions, F = f I, with noise; the gas bears it.
  BlockInGas(const NoiseCase& noise, const GasAround& gas)
      : law_{.lambda = noise.lambda, .mu = 1},
        f_(noise.F.a11),
        pressed_(law_.P({f_, 0, 0, f_})),
        solver_(grid(noise.aspect), law_,
                {.rho = 1,
                 .limiter = gas.limiter,
                 .tangential_stress = {.scaled = noise.beta_P},
                 .displacement = {.scaled = noise.beta_u},
                 .relaxation = {.scaled = noise.beta_r},
                 .cfl = noise.cfl},
                boundaries(gas), 0),
        outline_(outline(gas)),
        curve_(gas.below ? grid::Curve::closed : grid::Curve::open),
        gas_{.z = gas.z_f * std::sqrt(noise.lambda + 2), .w_n = pressed_.a11 / f_} {
    solver_.assign_initial_conditions([&](double x, double y, double) {
      return SolidState{.u = {(f_ - 1) * x, (f_ - 1) * y}, .v = Vec2::Zero(), .P = pressed_};
    });
    // By a rule of which no wave knows.
    FieldView q = solver_.state();
    for (int k = 0; k < plane::count; ++k) {
      for (int j = 0; j <= n2; ++j) {
        for (int i = 0; i <= n1; ++i)
          q(k, i, j) += 1e-9 * std::sin(7.0 * i * i + 3.0 * j * j + 5.0 * k * i + j);
      }
    }
    project();
  }

  void step() {
    const double dt = solver_.compute_time_step().dt;
    solver_.advance_solid(t_, dt);
    t_ += dt;
    project();
  }
  double largest_velocity() const {
    double largest = 0;
    for (int j = 0; j <= n2; ++j) {
      for (int i = 0; i <= n1; ++i) {
        const double size = std::hypot(solver_.state()(plane::v1, i, j), solver_.state()(plane::v2, i, j));
        largest = std::isfinite(size) ? std::max(largest, size) : HUGE_VAL;
      }
    }
    return largest;
  }

 private:
  static constexpr int n1 = 10, n2 = 6;
  static grid::MovingGrid grid(double aspect) {
    return {{.name = "block",
             .n1 = n1 + 1,
             .n2 = n2 + 1,
             .mapping = [aspect](double r, double s, double) -> Vec2 {
               return {n1 * r, aspect * n2 * s};
             }},
            0};
  }
  static Boundaries boundaries(const GasAround& gas) {
    Boundaries boundaries;
    for (Boundary& boundary : boundaries) boundary.condition = Interface::condition;
    if (!gas.below) boundaries[static_cast<std::size_t>(Side::bottom)].condition = Traction::condition;
    return boundaries;
  }
  static JoinedSides outline(const GasAround& gas) {
    if (!gas.below)
      return {{{Side::right}, {Side::top, true}, {Side::left, true}}, {n2 + 1, n1 + 1, n2 + 1}, false};
    return {{{Side::bottom}, {Side::right}, {Side::top, true}, {Side::left, true}},
            {n1 + 1, n2 + 1, n1 + 1, n2 + 1},
            true};
  }
  void project() {
    std::vector<SolidInterface> each(outline_.stretches().size());
    for (std::size_t k = 0; k < each.size(); ++k)
      solver_.interface_state(outline_.stretches()[k].side, each[k]);
    SolidInterface shown;
    outline_.join(each, shown);
    const std::vector<double> n = grid::normals(shown.x, curve_, 1);
    const std::size_t count = outline_.points();
    std::vector<double> v_n(count), w_n(count);
    for (std::size_t k = 0; k < count; ++k) {
      const auto vector_at = [&](const std::vector<double>& of) { return Vec2(of[k], of[count + k]); };
      const SolidPoint<2> solid = {
          .v = vector_at(shown.v),
          .w = vector_at(shown.w),
          .Z = Mat2{{shown.Z[k], shown.Z[count + k]}, {shown.Z[count + k], shown.Z[2 * count + k]}}};
      const NormalState both = fsi::project<2>(solid, gas_, vector_at(n), Projection::full);
      v_n[k] = both.v_n;
      w_n[k] = both.w_n;
    }
    std::vector<InterfaceValues> values;
    outline_.split({.n = n, .v_n = v_n, .w_n = w_n}, values);
    solver_.apply_solid_bcs(t_, values);
  }

  L law_;
  double f_;
  Tensor2 pressed_;
  SolidSolver<L> solver_;
  JoinedSides outline_;
  grid::Curve curve_;
  NormalSide gas_;
  double t_ = 0;
};

/// Largest velocity in a hundred steps after `steps` steps, relative to the largest in the first hundred; infinite where the
/// solution diverges.
template <class L>
double growth_of_noise_in_gas(const NoiseCase& noise, const GasAround& gas, int steps) {
  BlockInGas<L> block(noise, gas);
  double first = 0, last = 0;
  try {
    for (int step = 0; step < steps + 100; ++step) {
      block.step();
      if (step < 100) first = std::max(first, block.largest_velocity());
      if (step >= steps) last = std::max(last, block.largest_velocity());
      if (step % 500 == 499 && block.largest_velocity() > 1e4 * first) return HUGE_VAL;
    }
  } catch (const Diverged&) {
    return HUGE_VAL;
  }
  return last / first;
}

}  // namespace fsi::solid::test
