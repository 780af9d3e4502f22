#pragma once
/// A block whose outline, or a part of it, the coupler's projection moves, in a gas that may press it.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "common/grid/geometry/interface_geometry.hpp"
#include "common/interface/riemann.hpp"
#include "solid_solver/boundary/joined_sides.hpp"
#include "tests/convergence/solid/noise_growth.hpp"

namespace fsi::solid::test {

struct Surroundings {
  double z_f = 2e-3;  ///< impedance of the gas over that of the solid at rest [-]
  Limiter limiter = Limiter::none;
  /// Sides without it are free: of a body at rest.
  enum class Gas { around, not_below, nowhere } gas = Gas::around;
};

template <class L>
class BlockInGas {
 public:
  /// Squeezed alike in all directions, F = f I; the gas bears it.
  BlockInGas(const NoiseCase& noise, const Surroundings& around)
      : law_{.lambda = noise.lambda, .mu = 1},
        f_(noise.F.a11),
        pressed_(law_.P({f_, 0, 0, f_})),
        solver_(grid(noise.aspect), law_,
                {.rho = 1,
                 .limiter = around.limiter,
                 .tangential_stress = {.scaled = noise.beta_P},
                 .displacement = {.scaled = noise.beta_u},
                 .relaxation = {.scaled = noise.beta_r},
                 .cfl = noise.cfl},
                boundaries(around.gas), 0),
        outline_(outline(around.gas)),
        nowhere_(around.gas == Surroundings::Gas::nowhere),
        curve_(around.gas == Surroundings::Gas::around ? grid::Curve::closed : grid::Curve::open),
        gas_{.z = around.z_f * std::sqrt(noise.lambda + 2), .w_n = pressed_.a11 / f_} {
    solver_.assign_initial_conditions([&](double x, double y, double) {
      return SolidState{.u = {(f_ - 1) * x, (f_ - 1) * y}, .v = Vec2::Zero(), .P = pressed_};
    });
    project();
  }

  /// By a rule of which no wave knows.
  void add_noise() {
    FieldView q = solver_.state();
    for (int k = 0; k < plane::count; ++k) {
      for (int j = 0; j <= n2; ++j) {
        for (int i = 0; i <= n1; ++i)
          q(k, i, j) += 1e-9 * std::sin(7.0 * i * i + 3.0 * j * j + 5.0 * k * i + j);
      }
    }
    project();
  }

  double stable_step() const { return solver_.compute_time_step().dt; }
  void step() {
    const double dt = stable_step();
    solver_.advance_solid(t_, dt);
    t_ += dt;
    project();
  }
  /// All unknowns, point by point.
  std::vector<double> unknowns() const {
    std::vector<double> all;
    for (int j = 0; j <= n2; ++j) {
      for (int i = 0; i <= n1; ++i) {
        for (int k = 0; k < plane::count; ++k) all.push_back(solver_.state()(k, i, j));
      }
    }
    return all;
  }
  /// What conditions and a step make of these.
  std::vector<double> stepped(std::span<const double> all, double dt) {
    std::size_t next = 0;
    for (int j = 0; j <= n2; ++j) {
      for (int i = 0; i <= n1; ++i) {
        for (int k = 0; k < plane::count; ++k) solver_.state()(k, i, j) = all[next++];
      }
    }
    project();
    solver_.advance_solid(t_, dt);
    return unknowns();
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
  static Boundaries boundaries(Surroundings::Gas gas) {
    Boundaries boundaries;
    for (const Side side : all_sides) {
      const bool met =
          gas == Surroundings::Gas::around || (gas == Surroundings::Gas::not_below && side != Side::bottom);
      boundaries[static_cast<std::size_t>(side)].condition = met ? Interface::condition : Traction::condition;
    }
    return boundaries;
  }
  static JoinedSides outline(Surroundings::Gas gas) {
    if (gas == Surroundings::Gas::not_below)
      return {{{Side::right}, {Side::top, true}, {Side::left, true}}, {n2 + 1, n1 + 1, n2 + 1}, false};
    return {{{Side::bottom}, {Side::right}, {Side::top, true}, {Side::left, true}},
            {n1 + 1, n2 + 1, n1 + 1, n2 + 1},
            true};
  }
  void project() {
    if (nowhere_) return solver_.apply_solid_bcs(t_);
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
  bool nowhere_;
  grid::Curve curve_;
  NormalSide gas_;
  double t_ = 0;
};

/// Largest velocity in a hundred steps after `steps` steps, relative to the largest in the first hundred; infinite where the
/// solution diverges.
template <class L>
double growth_of_noise_in_gas(const NoiseCase& noise, const Surroundings& around, int steps) {
  BlockInGas<L> block(noise, around);
  block.add_noise();
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
