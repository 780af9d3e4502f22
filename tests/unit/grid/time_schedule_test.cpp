#include "common/core/time_schedule.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "common/core/failure.hpp"

namespace fsi {
namespace {

TEST(TimeSchedule, HitsEveryOutputTimeExactlyAndNeverExceedsTheBid) {
  TimeSchedule schedule({.end = 1.0, .output_times = {0.3, 0.7}, .growth = 10, .dt_max = 0});
  std::vector<double> hit;
  double t = 0;
  for (bool end = false; !end;) {
    const PlannedStep step = schedule.plan(t, 0.043, "gas");
    EXPECT_LE(step.dt, 0.043 * (1 + 1e-12));
    // The remainder is spread: no step is much shorter than the bid allows for.
    EXPECT_GT(step.dt, 0.043 * 0.8);
    t = step.t_next;
    if (step.output) hit.push_back(t);
    end = step.end;
  }
  EXPECT_EQ(hit, (std::vector<double>{0.3, 0.7, 1.0}));
  EXPECT_EQ(t, 1.0);
}

TEST(TimeSchedule, LimitsTheGrowthOfTheStep) {
  TimeSchedule schedule({.end = 100, .output_times = {}, .growth = 1.5, .dt_max = 0});
  const double first = schedule.plan(0, 0.01, "gas").dt;
  const double second = schedule.plan(first, 1.0, "gas").dt;
  EXPECT_LE(second, 1.5 * first * (1 + 1e-12));
}

TEST(TimeSchedule, CallsAVanishedStepBroken) {
  TimeSchedule schedule({.end = 1, .output_times = {}, .growth = 1.2, .dt_max = 0});
  EXPECT_THROW(schedule.plan(0, 1e-14, "gas"), NumbersBroke);
  EXPECT_THROW(schedule.plan(0, std::numeric_limits<double>::quiet_NaN(), "gas"), NumbersBroke);
  // A body without waves bids no limit: then only the end of the run counts.
  EXPECT_EQ(schedule.plan(0, std::numeric_limits<double>::infinity(), "body").t_next, 1.0);
}

}  // namespace
}  // namespace fsi
