/// Interfaces whose two sides have different points: what goes over is of fourth order, exact for what moves
/// as one, and acts with the same force on both sides.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <tuple>

#include "common/interface/point_lengths.hpp"
#include "coupler/coupler.hpp"
#include "tests/unit/coupler/messages.hpp"

namespace fsi::coupler {
namespace {

using namespace testing;
using std::numbers::pi;
using Function = std::function<double(const Vec2&)>;

/// Points on an ellipse, clustered; `shift` turns where they begin.
std::vector<double> ellipse(std::size_t n, double shift = 0) {
  std::vector<double> x(2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const double r = static_cast<double>(k % (n - 1)) / static_cast<double>(n - 1);
    const double angle = 2 * pi * r + 0.1 * std::sin(2 * pi * r) + shift;
    x[k] = 1.25 * std::cos(angle);
    x[n + k] = 0.5 * std::sin(angle);
  }
  return x;
}

/// Outward normals of that ellipse.
std::vector<double> outward(const std::vector<double>& x) {
  const std::size_t n = x.size() / 2;
  std::vector<double> normals(2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 normal = Vec2(x[k] / (1.25 * 1.25), x[n + k] / (0.5 * 0.5)).normalized();
    normals[k] = normal.x();
    normals[n + k] = normal.y();
  }
  return normals;
}

std::vector<double> at(const std::vector<double>& x, const Function& f) {
  const std::size_t n = x.size() / 2;
  std::vector<double> values(n);
  for (std::size_t k = 0; k < n; ++k) values[k] = f({x[k], x[n + k]});
  return values;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

double wavy(const Vec2& x) {
  return std::sin(2 * x.x() + 3 * x.y());
}

/// Both sides of an interface in a gas whose pressure varies along it.
struct Sides {
  std::vector<double> gas, solid;

  std::vector<wire::Hello> hellos() const {
    return {fluid_hello({{.name = "solid", .dimension = 2, .x = gas, .n = {}}}),
            solid_hello("solid", {.name = "solid", .dimension = 2, .x = solid, .n = outward(solid)})};
  }
  wire::PredictedInterface of_gas(const Vec2& v, double amplitude) const {
    const std::size_t n = gas.size() / 2;
    wire::PredictedInterface state = gas_state(n, 0);
    state.x = gas;
    state.v = everywhere(n, v.x(), v.y());
    state.p = at(gas, [&](const Vec2& x) { return 1 + amplitude * wavy(x); });
    state.z_f = at(gas, [](const Vec2& x) { return 1.5 + 0.5 * wavy(x); });
    return state;
  }
  wire::PredictedInterface of_solid(const Vec2& v) const {
    const std::size_t n = solid.size() / 2;
    wire::PredictedInterface state = solid_state(n, 0);
    state.x = solid;
    state.v = everywhere(n, v.x(), v.y());
    return state;
  }
};

CouplerOptions transfer_options() {
  CouplerOptions result;
  result.time.end = 1;
  result.multirate = true;
  result.combination.projection = Projection::full;
  return result;
}

/// Of a normal traction, sum ds w_n n.
Vec2 force_of(const std::vector<double>& x, const std::vector<double>& n, const std::vector<double>& w_n) {
  const std::size_t points = w_n.size();
  std::vector<double> ds(points);
  point_lengths(x, n, ds);
  Vec2 force = Vec2::Zero();
  for (std::size_t k = 0; k < points; ++k) force += ds[k] * w_n[k] * Vec2(n[k], n[points + k]);
  return force;
}

Vec2 force_on(const std::vector<double>& x, const wire::ProjectedInterface& answer) {
  return force_of(x, answer.n, answer.w_n);
}

TEST(CurveInterpolation, IsOfFourthOrderAlongClosedAndOpenCurves) {
  const auto error = [](std::size_t n, bool closed) {
    const std::size_t m = 3 * n + 5;
    auto from = ellipse(n), to = ellipse(m, 0.3);
    if (!closed) {  // points of a parabola in y, wider apart upwards
      from = vertical_line(n, 0);
      to = vertical_line(m, 0);
      for (auto* x : {&from, &to}) {
        const std::size_t count = x->size() / 2;
        for (std::size_t k = 0; k < count; ++k) {
          (*x)[count + k] += 0.2 * std::sin(2 * (*x)[count + k]);
          (*x)[k] = std::pow((*x)[count + k], 2);
        }
      }
      to[2 * m - 1] = from[2 * n - 1];
    }
    std::vector<double> values(m);
    CurveInterpolation(from, to).cubic(at(from, wavy), values);
    return difference(values, at(to, wavy));
  };
  for (const bool closed : {true, false}) {
    EXPECT_LT(error(81, closed), 1e-4);
    EXPECT_GT(std::log2(error(81, closed) / error(161, closed)), 3.6) << closed;
  }
}

TEST(CurveInterpolation, GoesRoundARingThatPeriodicSidesClose) {
  const auto from = ellipse(31), to = ellipse(81, 0.3);
  const CurveInterpolation closed(from, to), periodic(from, to, true);
  EXPECT_DOUBLE_EQ(periodic.largest_distance(), closed.largest_distance());
  std::vector<double> by_closed(81), by_periodic(81);
  closed.cubic(at(from, wavy), by_closed);
  periodic.cubic(at(from, wavy), by_periodic);
  EXPECT_LE(difference(by_periodic, by_closed), 1e-14);
}

TEST(CurveInterpolation, HandsOnValuesAtItsOwnPointsToTheBit) {
  const auto x = ellipse(41);
  auto reversed = x;
  std::reverse(reversed.begin(), reversed.begin() + 41);
  std::reverse(reversed.begin() + 41, reversed.end());
  std::vector<double> values(41);
  CurveInterpolation(x, reversed).cubic(at(x, wavy), values);
  EXPECT_EQ(values, at(reversed, wavy));
}

TEST(CurveInterpolation, LinearValuesStayBetweenTheirNeighbours) {
  const auto from = ellipse(20), to = ellipse(77, 0.1);
  std::vector<double> step(20), values(77);
  std::fill(step.begin() + 7, step.end(), 1.0);
  CurveInterpolation(from, to).linear(step, values);
  EXPECT_GE(*std::ranges::min_element(values), 0);
  EXPECT_LE(*std::ranges::max_element(values), 1);
}

TEST(CurveInterpolation, FindsPointsBetweenThoseOfTheCurveUpToTheFourthOrder) {
  const auto distance = [](std::size_t n) {
    return CurveInterpolation(ellipse(n), ellipse(4 * n, 0.2)).largest_distance();
  };
  EXPECT_LT(distance(81), 1e-4);
  EXPECT_GT(std::log2(distance(81) / distance(161)), 3.6);
}

class PointRatio : public ::testing::TestWithParam<std::pair<std::size_t, std::size_t>> {
 protected:
  Sides sides{ellipse(GetParam().first), ellipse(GetParam().second, 0.4)};
};

/// A coarser solid gets a traction that, as a function along the curve, has the force on the gas to round-off; a coarser gas
/// one that has it but for errors of the interpolation.
TEST_P(PointRatio, BothSidesFeelTheSameForce) {
  Coupler coupler(transfer_options(), sides.hellos());
  const auto answers = coupler.step(std::vector{sides.of_gas({0.3, 0.1}, 0.5), sides.of_solid({0, 0})});
  const bool gas_is_coarser = sides.gas.size() < sides.solid.size();
  const auto& [x, fine] =
      gas_is_coarser ? std::tie(sides.solid, answers[1]) : std::tie(sides.gas, answers[0]);
  const auto& [x_coarse, coarse] =
      gas_is_coarser ? std::tie(sides.gas, answers[0]) : std::tie(sides.solid, answers[1]);
  std::vector<double> w_n(fine.w_n.size());
  CurveInterpolation(x_coarse, x).cubic(coarse.w_n, w_n);
  const Vec2 force = force_on(x, fine), of_coarse = force_of(x, fine.n, w_n);
  EXPECT_GT(force.norm(), 0.01);
  const double h = 2 / static_cast<double>(coarse.w_n.size());
  EXPECT_LT((force - of_coarse).norm(), gas_is_coarser ? 0.1 * h * h : 1e-14);
  EXPECT_LT((force - force_on(x_coarse, coarse)).norm(), h * h);  // each with its own lengths and normals
}

TEST_P(PointRatio, AUniformMotionStaysOneOnBothSides) {
  Coupler coupler(transfer_options(), sides.hellos());
  const Vec2 v(0.7, -0.4);
  const auto answers = coupler.step(std::vector{sides.of_gas(v, 0), sides.of_solid(v)});
  for (const wire::ProjectedInterface& answer : answers) {
    const std::size_t n = answer.v_n.size();
    const std::vector<double>& x = answer.to == "fluid" ? sides.gas : sides.solid;
    ASSERT_EQ(n, x.size() / 2);
    for (std::size_t k = 0; k < n; ++k) {
      EXPECT_NEAR(answer.v_n[k], v.dot(Vec2(answer.n[k], answer.n[n + k])), 1e-14);
      EXPECT_NEAR(answer.w_n[k], 0, 1e-14);
    }
    for (std::size_t k = 0; k < answer.x_next.size() / 2; ++k)
      EXPECT_NEAR(answer.x_next[k], x[k] + answer.dt_next * v.x(), 1e-14);
  }
}

TEST_P(PointRatio, TheRobinDataOfTheSolidBelongsToItsProjectedState) {
  Coupler coupler(transfer_options(), sides.hellos());
  wire::PredictedInterface body = sides.of_solid({0, 0});
  body.proposed_dt = 0.03;  // substeps
  const auto answers = coupler.step(std::vector{sides.of_gas({0.3, 0.1}, 0.5), body});
  const wire::ProjectedInterface& solid = answers[1];
  ASSERT_EQ(solid.robin_r.size() % solid.v_n.size(), 0);
  ASSERT_GE(solid.robin_r.size(), solid.v_n.size());
  for (std::size_t k = 0; k < solid.v_n.size(); ++k)
    EXPECT_NEAR(solid.robin_r[k], solid.w_n[k] + solid.z_f[k] * solid.v_n[k], 1e-14);
}

/// A body that moves along (1, 1) only: its modal force is the work of the pressure per velocity.
TEST_P(PointRatio, AModalBodyOnOtherPointsMovesAsOnThoseOfTheGas) {
  const auto speed_with = [](const Sides& both) {
    const Vec2 direction(1, 1);
    const std::size_t n = both.solid.size() / 2;
    wire::PredictedInterface body = both.of_solid({0, 0});
    const auto normals = outward(both.solid);
    body.w.clear();
    body.Z.clear();
    std::vector<double> N(n);
    for (std::size_t k = 0; k < n; ++k) N[k] = direction.dot(Vec2(normals[k], normals[n + k]));
    BdfBody motion{.mass = 0.2};
    Coupler coupler(transfer_options(), both.hellos());
    double speed = 0;
    for (std::uint64_t step = 0; step < 5; ++step) {
      wire::PredictedInterface gas = both.of_gas({0, 0}, 0.5);
      gas.step = body.step = step;
      body.v = everywhere(n, motion.now, motion.now);
      body.modal = one_mode(motion.S(), motion.g(), N, motion.now);
      const auto answers = coupler.step(std::vector{gas, body});
      motion.take(answers[1].q_dot.front(), answers[1].dt_next);
      const wire::ProjectedInterface& answer = answers[0];
      const std::size_t m = answer.v_n.size();
      for (std::size_t k = 0; k < m; ++k) {  // where the normal is (1, 0) or nearly so
        if (answer.n[k] > 1 - 1e-3) speed = answer.v_n[k] / (answer.n[k] + answer.n[m + k]);
      }
    }
    return speed;
  };
  const double same_points = speed_with({sides.gas, sides.gas});
  EXPECT_GT(std::abs(same_points), 0.1);
  EXPECT_NEAR(speed_with(sides) / same_points, 1, 0.02);  // (h kappa)^2 of the coarser side
}

/// The same points from the other end, component-major.
template <class Number>
std::vector<Number> from_the_other_end(std::vector<Number> values, std::size_t points) {
  for (auto first = values.begin(); first != values.end();) {
    const auto last = first + static_cast<std::ptrdiff_t>(points);
    std::reverse(first, last);
    first = last;
  }
  return values;
}

/// A bent interface with an end that slides along a wall and one that is clamped; the solid counts its points as the gas
/// does, or from the other end.
std::vector<wire::ProjectedInterface> answers_at_two_different_ends(std::size_t gas_points,
                                                                    std::size_t solid_points, bool opposite) {
  const auto bend = [](std::vector<double> x) {
    const std::size_t n = x.size() / 2;
    for (std::size_t k = 0; k < n; ++k) x[k] += 0.01 * wavy({x[k], x[n + k]});
    return x;
  };
  wire::PredictedInterface gas = gas_state(gas_points, 0), solid = solid_state(solid_points, 0);
  gas.x = bend(gas.x);
  gas.p = at(gas.x, [](const Vec2& x) { return 1.2 + 0.5 * wavy(x); });
  solid.x = bend(solid.x);
  solid.fixed.assign(solid_points, wire::Freedom::free);
  solid.fixed.front() = wire::Freedom::slides;
  solid.fixed.back() = wire::Freedom::fixed;
  std::vector<double> x = vertical_line(solid_points, 0);
  if (opposite) {
    for (auto* each : {&x, &solid.x, &solid.v, &solid.w, &solid.Z})
      *each = from_the_other_end(*each, solid_points);
    solid.fixed = from_the_other_end(solid.fixed, solid_points);
  }
  const std::vector<wire::Hello> hellos = {
      fluid_hello({{.name = "solid", .dimension = 2, .x = vertical_line(gas_points, 0), .n = {}}}),
      solid_hello("solid", {.name = "solid", .dimension = 2, .x = x, .n = everywhere(solid_points, 1, 0)})};
  Coupler coupler(transfer_options(), hellos);
  const auto result = coupler.step(std::vector{gas, solid});
  std::vector<wire::ProjectedInterface> answers(result.begin(), result.end());
  if (opposite) {
    for (auto* each : {&answers[1].n, &answers[1].v_n, &answers[1].w_n})
      *each = from_the_other_end(*each, solid_points);
  }
  return answers;
}

TEST(OppositeSides, GetTheAnswersOfSidesThatRunAlike) {
  for (const auto& [gas_points, solid_points] : {std::pair<std::size_t, std::size_t>{21, 31}, {31, 21}}) {
    const auto alike = answers_at_two_different_ends(gas_points, solid_points, false),
               opposite = answers_at_two_different_ends(gas_points, solid_points, true);
    for (const std::size_t side : {0U, 1U}) {
      EXPECT_LT(difference(alike[side].n, opposite[side].n), 1e-14) << gas_points << " " << side;
      EXPECT_LT(difference(alike[side].v_n, opposite[side].v_n), 1e-14) << gas_points << " " << side;
      EXPECT_LT(difference(alike[side].w_n, opposite[side].w_n), 1e-14) << gas_points << " " << side;
    }
    EXPECT_LT(difference(alike[0].x_next, opposite[0].x_next), 1e-14) << gas_points;
    EXPECT_EQ(alike[0].v_n.back(), 0) << "clamped";
    EXPECT_NE(alike[0].v_n.front(), 0) << "slides";
  }
}

/// A gas that takes a long time to answer keeps the pressure it is given: what is its pressure along a slightly bent interface
/// after many steps beside a solid with the traction `w` at its points, without the change of the first step.
double drift_of_pressure(std::size_t gas_points, std::size_t solid_points, double density,
                         const std::function<double(std::size_t)>& w) {
  const auto bend = [](std::vector<double> x) {
    const std::size_t n = x.size() / 2;
    for (std::size_t k = 0; k < n; ++k) x[k] += 1e-3 * std::pow(std::sin(pi * x[n + k]), 2);
    return x;
  };
  const std::vector<wire::Hello> hellos = {
      fluid_hello({{.name = "solid", .dimension = 2, .x = vertical_line(gas_points, 0), .n = {}}}),
      solid_hello("solid", {.name = "solid",
                            .dimension = 2,
                            .x = vertical_line(solid_points, 0),
                            .n = everywhere(solid_points, 1, 0)})};
  CouplerOptions options = transfer_options();
  options.multirate = false;
  options.time.end = 1e6;
  Coupler coupler(options, hellos);
  wire::PredictedInterface gas = gas_state(gas_points, 0), solid = solid_state(solid_points, 0);
  gas.x = bend(gas.x);
  gas.p = at(gas.x, [](const Vec2& x) { return 1 + 0.1 * std::sin(2 * pi * x.y()); });
  solid.x = bend(solid.x);
  for (double& z : solid.Z) z *= density;
  solid.z_p *= density;
  for (std::size_t k = 0; k < solid_points; ++k) solid.w[k] = w(k);
  std::vector<double> first;
  for (std::uint64_t step = 0; step < 500; ++step) {
    gas.step = solid.step = step;
    const auto answers = coupler.step(std::vector{gas, solid});
    for (std::size_t k = 0; k < gas_points; ++k) gas.p[k] = gas.p_e - answers[0].w_n[k];
    if (step == 0) first = gas.p;
  }
  return difference(gas.p, first);
}

/// A body so heavy that the gas alone decides on the traction.
TEST(SlightlyBentSides, LeaveTheTractionOfTheGasAsItIs) {
  for (const std::size_t solid_points : {81U, 80U, 21U, 15U})
    EXPECT_LT(drift_of_pressure(21, solid_points, 1e12, [](std::size_t) { return 0.0; }), 2e-3)
        << solid_points;
}

/// The traction of one point that a coarser gas has not.
TEST(SlightlyBentSides, DoNotAddUpWhatTheGasCannotShow) {
  const double quiet = drift_of_pressure(21, 81, 1e3, [](std::size_t) { return 0.0; });
  const double beside_one = drift_of_pressure(21, 81, 1e3, [](std::size_t k) { return k == 42 ? 1.0 : 0.0; });
  EXPECT_NEAR(beside_one, quiet, 1e-10);
}

INSTANTIATE_TEST_SUITE_P(CoarserAndFinerGas, PointRatio,
                         ::testing::Values(std::pair<std::size_t, std::size_t>{81, 161},
                                           std::pair<std::size_t, std::size_t>{81, 321},
                                           std::pair<std::size_t, std::size_t>{321, 81},
                                           std::pair<std::size_t, std::size_t>{100, 100},
                                           std::pair<std::size_t, std::size_t>{100, 131}));

}  // namespace
}  // namespace fsi::coupler
