#include "common/core/time/time_schedule.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "common/core/failure.hpp"

namespace fsi {
namespace {

TEST(TimeSchedule, HitsEveryOutputTimeExactlyAndNeverExceedsTheProposal) {
  TimeSchedule schedule({.end = 1.0, .output_times = {0.3, 0.7}, .growth = 10, .dt_max = 0});
  std::vector<double> hit;
  double t = 0;
  for (bool end = false; !end;) {
    const PlannedStep step = schedule.plan(t, 0.043, "gas");
    EXPECT_LE(step.dt, 0.043 * (1 + 1e-12));
    // The remainder is spread: no step is much shorter than the proposal allows for.
    EXPECT_GT(step.dt, 0.043 * 0.8);
    t = step.t_next;
    if (step.output) hit.push_back(t);
    end = step.end;
  }
  EXPECT_EQ(hit, (std::vector<double>{0.3, 0.7, 1.0}));
  EXPECT_EQ(t, 1.0);
}

TEST(TimeSchedule, SaysWhatKeepsAStepFromBeingLonger) {
  TimeSchedule schedule({.end = 1.0, .output_times = {0.05}, .growth = 1.5, .dt_max = 0.2});
  EXPECT_EQ(schedule.plan(0, 0.04, "gas").limit, StepLimit::proposal);  // two even steps to the output time
  EXPECT_EQ(schedule.plan(0.045, 0.04, "gas").limit, StepLimit::output);
  EXPECT_EQ(schedule.plan(0.05, 0.4, "gas").limit,
            StepLimit::growth);  // from the proposal, not what was left
  for (int k = 0; k < 5; ++k) schedule.plan(0.1, 0.4, "gas");
  EXPECT_EQ(schedule.plan(0.1, 0.4, "gas").limit, StepLimit::largest);
  EXPECT_EQ(name_of(StepLimit::proposal, "gas"), "gas");
  EXPECT_EQ(name_of(StepLimit::largest, "gas"), "time.dt");
}

/// The steps of a whole run with an even proposal: each has a length.
std::vector<double> sizes_of_steps(TimeSchedule schedule, double proposal) {
  std::vector<double> sizes;
  double t = 0;
  for (bool end = false; !end && sizes.size() < 1000;) {
    const PlannedStep step = schedule.plan(t, proposal, "gas");
    sizes.push_back(step.dt);
    t = step.t_next;
    end = step.end;
  }
  return sizes;
}

TEST(TimeSchedule, AMultipleThatMissesTheEndByRoundOffIsTheEnd) {
  std::vector<double> times;
  for (int k = 0; k <= 19; ++k) times.push_back(k * (0.2 / 19));
  ASSERT_LT(times.back(), 0.2);
  const TimeSchedule schedule({.end = 0.2, .output_times = times, .growth = 1.2, .dt_max = 0});
  EXPECT_TRUE(schedule.output_at_start());
  const std::vector<double> sizes = sizes_of_steps(schedule, 1.0);
  ASSERT_EQ(sizes.size(), 19U);
  for (const double dt : sizes) EXPECT_NEAR(dt, 0.2 / 19, 1e-15);
}

TEST(TimeSchedule, TimesThatDifferByRoundOffAreOneAndDistinctOnesAreAllHit) {
  EXPECT_EQ(distinct_times({0.1, 0.1 + 1e-10, 0.2 - 1e-17, 1e-12}, 0.2), (std::vector<double>{0, 0.1, 0.2}));
  EXPECT_EQ(distinct_times({0.1, 0.1 + 1e-8, 0.3}, 0.2), (std::vector<double>{0.1, 0.1 + 1e-8}));
  const auto steps = [](std::vector<double> times) {
    return sizes_of_steps(
        TimeSchedule({.end = 0.2, .output_times = std::move(times), .growth = 1.2, .dt_max = 0}), 0.0101);
  };
  EXPECT_EQ(steps({0.1, 0.1 + 1e-10}), steps({0.1}));
  EXPECT_EQ(steps({0.1, 0.1 + 1e-8}).size(), steps({0.1}).size() + 1);
}

TEST(TimeSchedule, LimitsTheGrowthOfTheStep) {
  TimeSchedule schedule({.end = 100, .output_times = {}, .growth = 1.5, .dt_max = 0});
  const double first = schedule.plan(0, 0.01, "gas").dt;
  const double second = schedule.plan(first, 1.0, "gas").dt;
  EXPECT_LE(second, 1.5 * first * (1 + 1e-12));
}

TEST(TimeSchedule, CallsAVanishedStepBroken) {
  TimeSchedule schedule({.end = 1, .output_times = {}, .growth = 1.2, .dt_max = 0});
  EXPECT_THROW(schedule.plan(0, std::numeric_limits<double>::quiet_NaN(), "gas"), Diverged);
  // A body without waves proposes no limit: then only the end of the run counts.
  EXPECT_EQ(schedule.plan(0, std::numeric_limits<double>::infinity(), "body").t_next, 1.0);
  EXPECT_THROW(schedule.plan(0.5, 1e-14, "gas"), Diverged);
}

/// Nothing has been computed yet: it is the case that asks for too much.
TEST(TimeSchedule, SaysThatTheEndIsOutOfReachBeforeTheFirstStep) {
  TimeSchedule schedule({.end = 1e15, .output_times = {}, .growth = 1.2, .dt_max = 0});
  try {
    schedule.plan(0, 0.0346, "gas");
    FAIL() << "1e16 steps were begun";
  } catch (const UserMistake& mistake) {
    const std::string words = mistake.what();
    EXPECT_NE(words.find("time.end = 1e+15 is 2.9e+16 steps of 0.0346 (gas) away"), std::string::npos)
        << words;
  }
}

}  // namespace
}  // namespace fsi
