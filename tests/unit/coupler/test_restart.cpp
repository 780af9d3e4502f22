/// A coupler that goes on from a checkpoint says the same to the last bit as one that was never stopped.

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

constexpr std::size_t n = 4;
constexpr std::uint64_t stop = 5, end = 9;

CouplerOptions restart_options() {
  CouplerOptions options;
  options.time = {.end = 100, .output_times = {}, .growth = 1.2, .dt_max = 0};
  options.multirate = true;
  return options;
}

/// Both sides at an exchange: everything changes from step to step, the proposals up and down.
std::vector<wire::PredictedInterface> exchange(std::uint64_t step, bool modal) {
  const auto s = static_cast<double>(step);
  auto gas = gas_state(n, step);
  auto solid = solid_state(n, step);
  gas.x = solid.x = vertical_line(n, 0.01 * s * s);
  gas.v = everywhere(n, 0.3 * std::sin(s), 0.1);
  solid.v = everywhere(n, 0.2 * std::cos(2 * s), -0.1 * s);
  for (std::size_t k = 0; k < n; ++k) {
    gas.p[k] = 1 + 0.1 * std::cos(s + static_cast<double>(k));
    gas.z_f[k] = 1 + 0.05 * s;
    solid.w[k] = 0.02 * std::sin(3 * s);
  }
  gas.proposed_dt = step == stop - 1 ? 0.01 : 0.1;  // the step has to grow again after the restart
  solid.proposed_dt = 0.004;  // several substeps also in the small steps then: Robin data are told
  if (modal) {
    solid.w.clear();
    solid.Z.clear();
    solid.v = everywhere(n, 0.1, -0.1 * s);
    solid.modal = one_mode(0.5, 0.02 * s, std::vector<double>(n, 1.0), 0.1);
  }
  return {gas, solid};
}

/// All numbers both sides are told, first the gas.
using Told = std::vector<std::vector<double>>;
constexpr std::size_t robin_r = 8, to_solid = 10;  // places in it
Told told(Coupler& coupler, std::uint64_t step, bool modal) {
  Told values;
  for (const wire::ProjectedInterface& a : coupler.step(exchange(step, modal))) {
    values.insert(values.end(), {a.n, a.v_n, a.w_n, a.v, a.a, a.x_next, a.z_f, a.robin_t, a.robin_r});
    values.push_back({a.t, a.dt_next, a.t_next, static_cast<double>(a.substeps_next)});
  }
  return values;
}

class CouplerRestart : public ::testing::TestWithParam<bool> {};

TEST_P(CouplerRestart, ContinuesBitForBit) {
  Coupler whole(restart_options(), piston_hellos(n)), first(restart_options(), piston_hellos(n)),
      second(restart_options(), piston_hellos(n));
  for (std::uint64_t step = 0; step < stop; ++step)
    EXPECT_EQ(told(first, step, GetParam()), told(whole, step, GetParam()));
  Archive saved;
  first.archive(saved);
  Archive loaded(saved.entries());
  second.archive(loaded);
  loaded.check_all_loaded();
  for (std::uint64_t step = stop; step < end; ++step) {
    const Told expected = told(whole, step, GetParam()), found = told(second, step, GetParam());
    EXPECT_EQ(second.next().limited_by, whole.next().limited_by) << "step " << step;
    EXPECT_GT(expected[to_solid + robin_r].size(), n) << "step " << step;
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_EQ(found[k], expected[k]) << "step " << step << ", " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(OfASolid, CouplerRestart, ::testing::Bool(),
                         [](const auto& modal) { return modal.param ? "WithModes" : "ThatDeforms"; });

}  // namespace
}  // namespace fsi::coupler
