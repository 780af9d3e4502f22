/// Levels of the gas's background: what fits, what is refused, and what a report says.

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "common/case/report/cost.hpp"
#include "common/case/report/memory.hpp"
#include "common/case/report/summary.hpp"
#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

using tests::load_text;
using tests::mistake_in;

const char* const stream = R"(time: {end: 1}
fluid:
  gamma: 1.4
  p_e: 1
  grid: {x: [0, 2], y: [0, 1], points: [81, 41]}
  boundary: {left: outflow, right: outflow, bottom: symmetry, top: symmetry}
  initial: {rho: 1, v: [0, 0], p: 1}
)";

std::array<int, 2> points_with(const std::string& levels, const std::string& points) {
  const Case problem = load_text(stream, {"fluid.grid.levels=" + levels, "fluid.grid.points=" + points});
  return {problem.fluids.front().grid.n1, problem.fluids.front().grid.n2};
}

TEST(BackgroundLevels, AddAsFewPointsAsMakeThemFit) {
  EXPECT_EQ(points_with("1", "[81, 41]"), (std::array{81, 41}));
  EXPECT_EQ(points_with("2", "[82, 43]"), (std::array{82, 43}));
  EXPECT_EQ(points_with("2", "[81, 41]"), (std::array{82, 43}));
  EXPECT_EQ(points_with("3", "[81, 41]"), (std::array{82, 46}));
  EXPECT_EQ(points_with("3", "[81, 5]"), (std::array{82, 37})) << "four cells of the coarsest level at least";
}

TEST(BackgroundLevels, AreNamedByAReportWithThePointsThatWereAdded) {
  const Case even = load_text(stream), levels = load_text(stream, {"fluid.grid.levels=3"});
  EXPECT_EQ(summary_line(even).find("levels"), std::string::npos);
  EXPECT_NE(summary_line(levels).find("gas 82 x 46, 3 levels"), std::string::npos) << summary_line(levels);
  EXPECT_NE(summary_line(levels).find("fluid.grid: 82 x 46 points in place of 81 x 41, so that 3 levels fit"),
            std::string::npos)
      << summary_line(levels);
  EXPECT_EQ(summary_line(levels).find("the finest spacing is"), std::string::npos);
  const std::string deep = summary_line(load_text(stream, {"fluid.grid.levels=6"}));  // 80 cells become 972
  EXPECT_NE(deep.find("973 x 973 points in place of 81 x 41"), std::string::npos) << deep;
  EXPECT_NE(deep.find("; the finest spacing is "), std::string::npos) << deep;
  EXPECT_NE(deep.find("write fewer `levels`"), std::string::npos) << deep;
  EXPECT_NE(summary_line(levels).find("memory at most about"), std::string::npos) << summary_line(levels);
  EXPECT_EQ(cost_text(cost_of(even)).find("levels"), std::string::npos);
  EXPECT_NE(cost_text(cost_of(levels)).find("less by what the levels save"), std::string::npos);
}

TEST(BackgroundLevels, AreRefusedForGridsThatAreNoRectangleAtRest) {
  const std::string rest = ": only a `rectangle` along the axes";
  for (const char* change : {"fluid.grid.rotation=10", "fluid.grid.shake=0.1",
                             "fluid.grid={kind: mapped, points: [81, 41], map: [r, s], levels: 2}"}) {
    const std::string message = mistake_in(stream, {"fluid.grid.levels=2", change, "fluid.grid.levels=2"});
    EXPECT_NE(message.find("fluid.grid.levels" + rest), std::string::npos) << change << ": " << message;
  }
  EXPECT_EQ(mistake_in(stream, {"fluid.grid.rotation=10", "fluid.grid.levels=1"}), "");
}

TEST(BackgroundLevels, AreRefusedWhereASideMovesWithASolid) {
  const std::string piston = std::string(stream) + R"(solids:
  piston:
    law: linear_elastic
    rho: 1
    lambda: 1
    mu: 1
    grid: {x: [-1, 0], y: [0, 1], points: [11, 11]}
    boundary: {left: clamped, right: interface, bottom: symmetry, top: symmetry}
)";
  const std::string message =
      mistake_in(piston, {"fluid.boundary.left={kind: interface, solid: piston}", "fluid.grid.levels=3"});
  EXPECT_NE(message.find("fluid.grid.levels: the left side moves with `piston`"), std::string::npos)
      << message;
  EXPECT_NE(message.find("write 1"), std::string::npos) << message;
}

TEST(BackgroundLevels, MustHaveABufferThatNoWaveCrossesBetweenAdaptations) {
  const std::string message =
      mistake_in(stream, {"fluid.grid.levels=2", "fluid.grid.refine={buffer: 2, every: 7}"});
  EXPECT_NE(
      message.find("fluid.grid.refine: a wave can leave the refined part: write `buffer: 3` or `every: 6`"),
      std::string::npos)
      << message;
  EXPECT_EQ(mistake_in(stream, {"fluid.grid.levels=2", "fluid.grid.refine={buffer: 2, every: 6}"}), "");
}

}  // namespace
}  // namespace fsi
