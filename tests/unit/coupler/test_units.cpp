/// The same interface in other units is given the same answers to the bit, where the units differ by powers of two: no
/// number in the coupler has a dimension.

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "coupler/coupler.hpp"
#include "messages.hpp"

namespace fsi::coupler {
namespace {

using namespace testing;

constexpr std::size_t scaled_points = 7;
constexpr int scaled_exchanges = 8;

/// Factors of lengths, times and densities.
struct Units {
  double length = 1, time = 1, density = 1;
  double speed() const { return length / time; }
  double pressure() const { return density * speed() * speed(); }
  double impedance() const { return density * speed(); }
  double mass() const { return density * length * length; }  ///< per depth
};

std::vector<double> times(double factor, std::vector<double> values) {
  for (double& value : values) value *= factor;
  return values;
}

/// No value is like another, none a round number.
double odd(int k) {
  return std::sin(1.7 * k + 0.3);
}

std::vector<double> odd_values(std::size_t n, double middle, double spread, int seed) {
  std::vector<double> values(n);
  for (std::size_t k = 0; k < n; ++k) values[k] = middle + spread * odd(seed + static_cast<int>(k));
  return values;
}

/// A line with waves.
std::vector<double> wavy(int step) {
  std::vector<double> x = vertical_line(scaled_points, 0);
  for (std::size_t k = 0; k < scaled_points; ++k)
    x[k] += 0.01 * odd(step) * std::sin(3 * x[scaled_points + k]);
  return x;
}

wire::PredictedInterface gas_in(const Units& units, int step) {
  wire::PredictedInterface gas = gas_state(scaled_points, static_cast<std::uint64_t>(step));
  gas.x = times(units.length, wavy(step));
  gas.v = times(units.speed(), odd_values(2 * scaled_points, 0.1, 0.2, step));
  gas.p = times(units.pressure(), odd_values(scaled_points, 1.2, 0.3, 2 * step));
  gas.rho = times(units.density, odd_values(scaled_points, 1.1, 0.2, 3 * step));
  gas.z_f = times(units.impedance(), odd_values(scaled_points, 1.3, 0.1, 5 * step));
  gas.gamma.assign(scaled_points, 1.4);
  gas.p_e = units.pressure();
  gas.proposed_dt = units.time * (0.1 + 0.01 * odd(step));
  return gas;
}

/// An elastic solid.
wire::PredictedInterface solid_in(const Units& units, int step) {
  wire::PredictedInterface solid = solid_state(scaled_points, static_cast<std::uint64_t>(step));
  solid.x = times(units.length, wavy(step + 1));
  solid.v = times(units.speed(), odd_values(2 * scaled_points, -0.05, 0.1, 7 * step));
  solid.w = times(units.pressure(), odd_values(2 * scaled_points, 0.1, 0.1, 11 * step));
  solid.Z = times(units.impedance(), solid.Z);
  solid.z_p = 2 * units.impedance();
  solid.proposed_dt = units.time * (0.03 + 0.002 * odd(step));
  return solid;
}

/// A rigid one, with an inertia instead of an impedance.
wire::PredictedInterface body_in(const Units& units, int step) {
  wire::PredictedInterface body = solid_in(units, step);
  body.w.clear();
  body.Z.clear();
  body.z_p = 0;
  for (std::size_t k = 0; k < scaled_points; ++k) body.v[k] = units.speed() * 0.1;
  body.modal = one_mode(units.mass() * (0.3 + 0.01 * odd(step)), units.mass() * units.speed() * odd(2 * step),
                        std::vector<double>(scaled_points, 1), units.speed() * 0.1);
  return body;
}

CouplerOptions options_in(const Units& units, Projection how, bool multirate) {
  CouplerOptions options;
  options.time = {.end = 10 * units.time, .output_times = {0.3 * units.time}, .growth = 1.2, .dt_max = 0};
  options.combination.projection = how;
  options.multirate = multirate;
  return options;
}

Coupler coupler_in(const Units& units, const CouplerOptions& options) {
  std::vector<wire::Hello> hellos = piston_hellos(scaled_points);
  for (wire::Hello& hello : hellos) hello.interfaces[0].x = times(units.length, hello.interfaces[0].x);
  return {options, hellos};
}

void expect_same(const wire::ProjectedInterface& one, const wire::ProjectedInterface& other,
                 const Units& units) {
  EXPECT_EQ(one.n, other.n);
  EXPECT_EQ(times(units.speed(), one.v_n), other.v_n);
  EXPECT_EQ(times(units.pressure(), one.w_n), other.w_n);
  EXPECT_EQ(times(units.speed(), one.v), other.v);
  EXPECT_EQ(times(units.speed() / units.time, one.a), other.a);
  EXPECT_EQ(times(units.length, one.x_next), other.x_next);
  EXPECT_EQ(times(units.impedance(), one.z_f), other.z_f);
  EXPECT_EQ(times(units.time, one.robin_t), other.robin_t);
  EXPECT_EQ(times(units.pressure(), one.robin_r), other.robin_r);
  EXPECT_EQ(units.time * one.dt_next, other.dt_next);
  EXPECT_EQ(units.time * one.t_next, other.t_next);
  EXPECT_EQ(one.substeps_next, other.substeps_next);
}

using Solid = wire::PredictedInterface (*)(const Units&, int);

void expect_same_answers(const Units& units, Solid solid, Projection how, bool multirate) {
  Coupler coupler = coupler_in({}, options_in({}, how, multirate)),
          other = coupler_in(units, options_in(units, how, multirate));
  for (int step = 0; step < scaled_exchanges; ++step) {
    const auto answers = coupler.step(std::vector{gas_in({}, step), solid({}, step)});
    const auto in_units = other.step(std::vector{gas_in(units, step), solid(units, step)});
    ASSERT_EQ(answers.size(), in_units.size());
    for (std::size_t k = 0; k < answers.size(); ++k) expect_same(answers[k], in_units[k], units);
  }
  const InterfaceReport one = coupler.reports().front(), its = other.reports().front();
  EXPECT_EQ(units.length * one.gap, its.gap);
  EXPECT_EQ(units.speed() * one.velocity_jump, its.velocity_jump);
  EXPECT_EQ(units.pressure() * one.traction_jump, its.traction_jump);
  EXPECT_EQ(units.pressure() * units.speed() * units.length * one.power, its.power);
}

class CouplerInUnits : public ::testing::TestWithParam<Units> {};

TEST_P(CouplerInUnits, Eq28GivesAnElasticSolidTheSameAnswers) {
  for (const Projection how : {Projection::full, Projection::simplified, Projection::traditional}) {
    for (const bool multirate : {false, true}) expect_same_answers(GetParam(), solid_in, how, multirate);
  }
}

TEST_P(CouplerInUnits, ABodyWithModesGetsTheSameAnswers) {
  expect_same_answers(GetParam(), body_in, Projection::simplified, false);
}

INSTANTIATE_TEST_SUITE_P(PowersOfTwo, CouplerInUnits,
                         ::testing::Values(Units{.length = 0x1p-10}, Units{.time = 0x1p-17},
                                           Units{.density = 0x1p9},
                                           Units{.length = 0x1p7, .time = 0x1p-5, .density = 0x1p-12}));

}  // namespace
}  // namespace fsi::coupler
