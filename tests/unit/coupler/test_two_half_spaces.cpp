/// The one-dimensional model problem through the whole coupler: a pulse in a gas half-space and one in a
/// solid half-space meet at the interface. With r_f(t) = w + z_f v and r_s(t) = w - z_s v arriving from the
/// two sides its velocity is exactly (r_f - r_s) / (z_s + z_f). The set-up is turned by an angle, so that
/// normals and positions take part.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "coupler/coupler.hpp"
#include "half_space.hpp"
#include "messages.hpp"

namespace fsi::coupler {
namespace {

using namespace testing;

constexpr std::size_t points = 3;
constexpr double angle = 0.5;
constexpr double t_end = 1.0;
constexpr double amplitude = 1e-3;  ///< of the pulse: the motion stays small against h

/// Vector of length `along` in the direction of the interface normal at every point.
std::vector<double> along_normal(double along) {
  return everywhere(points, along * std::cos(angle), along * std::sin(angle));
}

/// Positions of the interface points, moved by u along the normal.
std::vector<double> interface_at(double u) {
  std::vector<double> x(2 * points);
  for (std::size_t k = 0; k < points; ++k) {
    const double s = 0.1 * static_cast<double>(k);
    x[k] = u * std::cos(angle) - s * std::sin(angle);
    x[points + k] = u * std::sin(angle) + s * std::cos(angle);
  }
  return x;
}

/// Incoming gas characteristic w + z_f v at distance x from
/// the interface at t = 0; four times differentiable.
double pulse(double x) {
  const double s = (x - 0.5) / 0.4;
  return std::abs(s) < 1 ? -amplitude * std::pow(1 - s * s, 5) : 0.0;
}

/// Incoming solid characteristic w - z_s v at distance x; its
/// traction has half the size, whatever the densities are.
double solid_pulse(double x, double c) {
  return -0.5 * pulse(x / c + 0.05);
}

struct Outcome {
  double error = 0;  ///< largest error of the interface velocity, relative to its maximum
  double gap = 0;    ///< largest gap, relative to the largest displacement
  std::uint64_t steps = 0;
  bool blown_up = false;
};

class ModelProblem {
 public:
  ModelProblem(Medium solid, std::size_t cells, const CouplerOptions& options)
      : h_(1.0 / static_cast<double>(cells)),
        solid_(solid, -1, static_cast<std::size_t>(std::ceil(1.2 * solid.c * static_cast<double>(cells))) + 1,
               h_),
        gas_({.rho = 1, .c = 1}, +1, 2 * cells + 1, h_),
        options_(options),
        coupler_(with_end(options), hellos()) {
    for (std::size_t i = 0; i <= 2 * cells; ++i) {
      const double w = pulse(static_cast<double>(i) * h_);
      gas_.s(i) = 0.5 * w;
      gas_.v(i) = 0.5 * w;
    }
    for (std::size_t i = 0; static_cast<double>(i) * h_ < solid.c; ++i) {
      const double w = solid_pulse(static_cast<double>(i) * h_, solid.c);
      solid_.s(i) = 0.5 * w;
      solid_.v(i) = -0.5 * w / solid.z();
    }
  }

  Outcome run() {
    Outcome outcome;
    double x_gas = 0;
    for (std::uint64_t step = 0;; ++step) {
      const auto answers = coupler_.step(std::vector{gas_message(step, x_gas), solid_message(step)});
      const double v_n = answers[0].v_n[1];
      solid_.set(v_n, answers[1].w_n[1]);
      gas_.set(v_n, answers[0].w_n[1]);
      measure(v_n, outcome);
      outcome.steps = step;
      if (std::abs(v_n) > 100 * amplitude) outcome.blown_up = true;
      if (outcome.blown_up || coupler_.finished()) return outcome;
      gas_.advance(answers[0].dt_next);
      advance_solid(answers[1]);
      x_gas = std::cos(angle) * answers[0].x_next[1] + std::sin(angle) * answers[0].x_next[points + 1];
    }
  }

 private:
  static CouplerOptions with_end(CouplerOptions options) {
    options.time.end = t_end;
    return options;
  }
  static std::vector<wire::Hello> hellos() {
    return {
        fluid_hello({{.name = "solid", .dimension = 2, .x = interface_at(0), .n = {}}}),
        solid_hello("solid", {.name = "solid", .dimension = 2, .x = interface_at(0), .n = along_normal(1)})};
  }
  wire::PredictedInterface gas_message(std::uint64_t step, double x) {
    wire::PredictedInterface state = gas_state(points, step);
    state.x = interface_at(x);
    state.v = along_normal(gas_.v(0));
    state.p.assign(points, 1 - gas_.s(0));
    state.z_f.assign(points, gas_.medium().z());
    state.proposed_dt = gas_.largest_step();
    return state;
  }
  wire::PredictedInterface solid_message(std::uint64_t step) {
    wire::PredictedInterface state = solid_state(points, step);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double z_p = solid_.medium().z();
    const double z_s = 0.5 * z_p;
    state.x = interface_at(solid_.u());
    state.v = along_normal(solid_.v(0));
    state.w = along_normal(solid_.s(0));
    for (std::size_t k = 0; k < points; ++k) {
      state.Z[k] = z_p * c * c + z_s * s * s;
      state.Z[points + k] = (z_p - z_s) * c * s;
      state.Z[2 * points + k] = z_p * s * s + z_s * c * c;
    }
    state.z_p = z_p;
    state.proposed_dt = solid_.largest_step();
    return state;
  }

  /// Lagrange polynomial through the Robin data at time t.
  static double robin(const wire::ProjectedInterface& answer, double t) {
    double sum = 0;
    for (std::size_t k = 0; k < answer.robin_t.size(); ++k) {
      double weight = 1;
      for (std::size_t l = 0; l < answer.robin_t.size(); ++l) {
        if (l != k) weight *= (t - answer.robin_t[l]) / (answer.robin_t[k] - answer.robin_t[l]);
      }
      sum += weight * answer.robin_r[k * points + 1];
    }
    return sum;
  }

  void advance_solid(const wire::ProjectedInterface& answer) {
    const double dt = answer.dt_next / answer.substeps_next;
    for (int k = 1; k <= answer.substeps_next; ++k) {
      solid_.advance(dt);
      if (k == answer.substeps_next) return;  // the coupler closes the last substep
      const double z_s = solid_.medium().z();
      const double r = robin(answer, answer.t + k * dt);
      const double v_n = (r - solid_.s(0) + z_s * solid_.v(0)) / (z_s + answer.z_f[1]);
      solid_.set(v_n, r - answer.z_f[1] * v_n);
    }
  }

  void measure(double v_n, Outcome& outcome) {
    const double z = gas_.medium().z() + solid_.medium().z();
    const double t = coupler_.t();
    const double exact = (pulse(t) - solid_pulse(solid_.medium().c * t, solid_.medium().c)) / z;
    outcome.error = std::max(outcome.error, std::abs(v_n - exact) * z / amplitude);
    outcome.gap = std::max(outcome.gap, coupler_.reports().front().gap * z / (0.3 * amplitude));
  }

  double h_;
  HalfSpace solid_, gas_;
  CouplerOptions options_;
  Coupler coupler_;
};

CouplerOptions with(Projection projection, bool multirate, int robin_order = 2) {
  CouplerOptions options;
  options.time.growth = 1.2;
  options.combination.projection = projection;
  options.multirate = multirate;
  options.robin_order = robin_order;
  return options;
}

/// Twice the error of the upwind scheme itself on these pulses
/// at 80 cells per length, whatever the densities.
constexpr double error_at_80 = 1.5e-3;

class DensityRatio : public ::testing::TestWithParam<double> {};

TEST_P(DensityRatio, Eq28IsStableAndOfSecondOrder) {
  const Medium solid{.rho = GetParam(), .c = 1.3};
  for (const Projection how : {Projection::full, Projection::simplified}) {
    const Outcome coarse = ModelProblem(solid, 80, with(how, false)).run();
    const Outcome fine = ModelProblem(solid, 160, with(how, false)).run();
    EXPECT_LE(coarse.error, error_at_80);
    EXPECT_GE(std::log2(coarse.error / fine.error), 1.8);
    EXPECT_LE(coarse.gap, 4e-4);
    EXPECT_GE(std::log2(coarse.gap / fine.gap), 2.8);  // dt^3 per step, never summed up
  }
}

TEST_P(DensityRatio, Eq28IsStableAndOfSecondOrderWithSubstepsOfAStiffSolid) {
  const Medium solid{.rho = GetParam(), .c = 8};
  for (const int order : {1, 2}) {
    const Outcome coarse = ModelProblem(solid, 80, with(Projection::simplified, true, order)).run();
    const Outcome fine = ModelProblem(solid, 160, with(Projection::simplified, true, order)).run();
    const Outcome single = ModelProblem(solid, 80, with(Projection::simplified, false)).run();
    EXPECT_LE(coarse.error, error_at_80);
    EXPECT_GE(std::log2(coarse.error / fine.error), 1.8) << "order " << order;
    EXPECT_GE(static_cast<double>(single.steps), 7 * static_cast<double>(coarse.steps));
  }
}

TEST_P(DensityRatio, Eq28IsStableWithASlowSolidThatNeedsNoSubsteps) {
  const Medium solid{.rho = GetParam(), .c = 0.3};
  const Outcome outcome = ModelProblem(solid, 80, with(Projection::simplified, true)).run();
  EXPECT_LE(outcome.error, 3e-2);  // twice what 19 cells over half a pulse in the solid give
}

INSTANTIATE_TEST_SUITE_P(FromVeryLightToVeryHeavy, DensityRatio,
                         ::testing::Values(1e-3, 1e-2, 0.1, 1.0, 10.0, 1e3));

TEST(TraditionalScheme, HoldsForHeavySolidsAndBlowsUpForLightOnes) {
  const auto outcome = [](double ratio) {
    return ModelProblem({.rho = ratio, .c = 1.3}, 80, with(Projection::traditional, false)).run();
  };
  EXPECT_FALSE(outcome(1e3).blown_up);
  EXPECT_LE(outcome(1e3).error, error_at_80 + 1e-3);  // its own error is of the order of z_f / z_s
  EXPECT_TRUE(outcome(0.1).blown_up);
  EXPECT_TRUE(outcome(1e-2).blown_up);
}

}  // namespace
}  // namespace fsi::coupler
