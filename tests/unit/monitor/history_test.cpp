/// What the monitor remembers, in bounded memory.

#include "monitor/history.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "tests/unit/monitor/telemetry.hpp"

namespace fsi::monitor {
namespace {

TEST(Series, HoldsTheWholeTimeAndEveryPeakInBoundedMemory) {
  Series series;
  constexpr int n = 100000;
  for (int k = 0; k < n; ++k) series.add(k, k == 12345 ? -50 : 1);
  const auto& points = series.points();
  EXPECT_LE(points.size(), Series::capacity);
  EXPECT_GT(points.size(), Series::capacity / 4);
  EXPECT_LT(points.front().at, 2.0 * n / Series::capacity * 2);
  EXPECT_EQ(points.back().at, n - 1);
  EXPECT_EQ(std::ranges::count(points, -50, &Series::Point::value), 1);
  EXPECT_TRUE(std::ranges::is_sorted(points, {}, &Series::Point::at));
}

TEST(Series, WhatLiesBehindTheLastPointIsLeftOut) {
  Series series;
  series.add(1, 5);
  series.add(1, 6);
  series.add(0.5, 7);
  ASSERT_EQ(series.points().size(), 1U);
  EXPECT_EQ(series.points()[0].value, 5);
}

TEST(Series, TheNewestValueIsKeptBesideThePeaks) {
  Series series;
  EXPECT_FALSE(series.newest());
  for (int k = 0; k < 5000; ++k) {
    series.add(k, k % 2 == 0 ? 8 : 1);
    ASSERT_TRUE(series.newest());
    ASSERT_EQ(series.newest()->at, k);
    ASSERT_EQ(series.newest()->value, k % 2 == 0 ? 8 : 1);
  }
  series.add(4999, 7);
  EXPECT_EQ(series.newest()->value, 1) << "what lies not behind the last one is no newer";
}

TEST(Series, WhatIsNotFiniteIsNotForgotten) {
  Series series;
  for (int k = 0; k < 5000; ++k) series.add(k, k == 2000 ? std::numeric_limits<double>::quiet_NaN() : k);
  EXPECT_EQ(
      std::ranges::count_if(series.points(), [](const auto& point) { return point.value != point.value; }),
      1);
}

TEST(Limiters, HoldTheChangesOnlyInBoundedMemory) {
  Limiters limiters;
  for (int k = 0; k < 10; ++k) limiters.add(k, k < 4 ? "fluid" : "beam");
  limiters.add(3, "time.growth");  // behind the last one
  limiters.add(10, "");            // the run is over
  ASSERT_EQ(limiters.changes().size(), 2U);
  EXPECT_EQ(limiters.changes()[1].t, 4);
  EXPECT_EQ(limiters.changes()[1].by, "beam");
  for (int k = 10; k < 100000; ++k) limiters.add(k, k % 2 == 0 ? "fluid" : "beam");
  EXPECT_LE(limiters.changes().size(), Limiters::capacity);
  EXPECT_EQ(limiters.changes().front().t, 0);
  EXPECT_GE(limiters.changes().back().t, 99990);
}

TEST(History, TheTableSaysWhatWasProposedWhereAStepBeganAndWhoLimitedIt) {
  const auto path =
      std::filesystem::temp_directory_path() / ("fsi-proposals-" + std::to_string(getpid()) + ".csv");
  std::ofstream(path) << "step,t [time],dt [time],fluid.proposed_dt [time],limited_by\n0,0,0,nan,none\n"
                         "1,0.25,0.25,0.3,time.growth\n2,0.5,0.25,0.25,fluid\n3,0.75,0.25,inf,fluid\n";
  History history;
  history.read_table(path.string());
  std::filesystem::remove(path);
  const auto& proposals = history.of("fluid.proposed_dt").points();
  ASSERT_EQ(proposals.size(), 3U);
  EXPECT_EQ(proposals[0].at, 0);
  EXPECT_EQ(proposals[0].value, 0.3);
  EXPECT_EQ(proposals[2].at, 0.5);
  EXPECT_TRUE(std::isinf(proposals[2].value));
  const auto& changes = history.limiters().changes();
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].by, "time.growth");
  EXPECT_EQ(changes[1].t, 0.25);
  EXPECT_EQ(changes[1].by, "fluid");
  EXPECT_TRUE(history.of("limited_by").points().empty());
}

TEST(History, BeginsWithWhatTheTableOfTheRunHolds) {
  const auto path =
      std::filesystem::temp_directory_path() / ("fsi-history-" + std::to_string(getpid()) + ".csv");
  std::ofstream(path)
      << "step,t [time],dt [time],beam.gap [length]\n0,0,0,0\n1,0.25,0.25,3e-4\n2,0.5,0.25,4e-4\n3,0.7";
  History history;
  history.read_table(path.string());
  auto coupler = with_interface("beam", 3);
  coupler.t = 0.5;
  history.add(coupler);
  coupler.t = 0.75;
  coupler.interfaces[0].gap = 5e-4;
  history.add(coupler);
  const auto& gap = history.of("beam.gap").points();
  ASSERT_EQ(gap.size(), 4U) << "the torn line and the step known already do not count";
  EXPECT_EQ(gap[1].value, 3e-4);
  EXPECT_EQ(gap[3].at, 0.75);
  EXPECT_EQ(gap[3].value, 5e-4);
  EXPECT_EQ(history.of("dt").points().front().at, 0.25) << "no step led to the initial state";
  EXPECT_TRUE(history.of("nothing").points().empty());
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace fsi::monitor
