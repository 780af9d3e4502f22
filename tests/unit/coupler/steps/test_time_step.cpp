/// Everybody agrees on one time step.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "common/core/failure.hpp"
#include "coupler/time_step.hpp"

namespace fsi::coupler {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<Proposal> proposals(double gas, double solid, bool multirate) {
  return {{.from = "fluid", .dt = gas, .reason = "sound", .may_substep = false},
          {.from = "beam", .dt = solid, .reason = "p-wave", .may_substep = multirate}};
}

TEST(TimeStepAgreement, TakesNoStepAboveAnyProposalAndHitsEveryWantedTimeExactly) {
  const std::set<double> wanted{0.1, 0.25, 1.0 / 3.0, 0.7};
  TimeStepAgreement agreement(
      {.end = 1.0, .output_times = {wanted.begin(), wanted.end()}, .growth = 1.2, .dt_max = 0}, 0);
  std::set<double> hit;
  double shortest = 1;
  for (bool end = false; !end;) {
    const double t = agreement.t();
    const double gas = 0.013 * (1 + 0.5 * std::sin(9 * t));
    const double solid = 0.017 * (1 + 0.3 * std::cos(7 * t));
    const AgreedStep step = agreement.agree(proposals(gas, solid, false));
    ASSERT_LE(step.plan.dt, std::min(gas, solid));
    ASSERT_EQ(step.substeps, (std::vector<std::int32_t>{1, 1}));
    shortest = std::min(shortest, step.plan.dt);
    if (step.plan.output) hit.insert(agreement.t());
    end = step.plan.end;
  }
  EXPECT_EQ(agreement.t(), 1.0);
  hit.erase(1.0);
  EXPECT_EQ(hit, wanted);
  EXPECT_GT(shortest, 0.5 * 0.006);  // no sliver: the smallest proposal is 0.0065
}

TEST(TimeStepAgreement, LetsTheStepGrowOnlySlowly) {
  TimeStepAgreement agreement({.end = 1e3, .output_times = {}, .growth = 1.2, .dt_max = 0}, 0);
  double before = agreement.agree(proposals(0.01, 1, false)).plan.dt;
  for (int k = 0; k < 10; ++k) {
    const AgreedStep step = agreement.agree(proposals(1, 1, false));
    EXPECT_LE(step.plan.dt, 1.2 * before * (1 + 1e-3));  // the rest of the run is divided evenly
    EXPECT_EQ(step.limited_by, "time.growth");
    before = step.plan.dt;
  }
}

TEST(TimeStepAgreement, NamesTheProgramOrSettingThatLimits) {
  TimeStepAgreement agreement({.end = 1.0, .output_times = {0.5}, .growth = 10, .dt_max = 0.2}, 0);
  EXPECT_EQ(agreement.agree(proposals(0.1, 0.15, false)).limited_by, "fluid");
  EXPECT_EQ(agreement.agree(proposals(0.15, 0.1, false)).limited_by, "beam");
  EXPECT_EQ(agreement.agree(proposals(0.15, 0.1, false)).reason, "p-wave");
  EXPECT_EQ(agreement.agree(proposals(0.5, 0.5, false)).limited_by, "time.dt");
}

TEST(TimeStepAgreement, WithMultirateTheGasSetsTheStepAndTheSolidDividesIt) {
  TimeStepAgreement agreement({.end = 100.0, .output_times = {}, .growth = 100, .dt_max = 0}, 0);
  const AgreedStep step = agreement.agree(proposals(0.1, 0.013, true));
  EXPECT_NEAR(step.plan.dt, 0.1, 1e-12);
  EXPECT_EQ(step.limited_by, "fluid");
  EXPECT_EQ(step.substeps, (std::vector<std::int32_t>{1, 8}));
  EXPECT_EQ(agreement.agree(proposals(0.1, 0.7, true)).substeps, (std::vector<std::int32_t>{1, 1}));
}

TEST(TimeStepAgreement, ABodyWithoutALimitDoesNotLimit) {
  TimeStepAgreement agreement({.end = 10.0, .output_times = {}, .growth = 2, .dt_max = 0}, 0);
  const AgreedStep step = agreement.agree(proposals(0.1, infinity, true));
  EXPECT_NEAR(step.plan.dt, 0.1, 1e-12);
  EXPECT_EQ(step.substeps[1], 1);
}

TEST(TimeStepAgreement, ACollapsedStepIsNamed) {
  TimeStepAgreement agreement({.end = 1.0, .output_times = {}, .growth = 2, .dt_max = 0}, 0);
  const auto message = [&](double gas, double solid) -> std::string {
    try {
      agreement.agree(proposals(gas, solid, true));
    } catch (const Diverged& broke) {
      return broke.what();
    }
    return "no failure";
  };
  EXPECT_NE(message(0.1, std::nan("")).find("beam"), std::string::npos);
  EXPECT_NE(message(0.1, 1e-7).find("beam"), std::string::npos);
  EXPECT_NE(message(-1, 0.1).find("fluid"), std::string::npos);
  EXPECT_NE(message(1e-14, 0.1).find("collapsed"), std::string::npos);
  EXPECT_NE(message(1e-14, 0.1).find("let the run end before (time.end)"), std::string::npos);
}

}  // namespace
}  // namespace fsi::coupler
