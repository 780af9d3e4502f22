/// The picture of a run on a terminal.

#include "monitor/terminal/screen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "monitor/terminal/plot.hpp"
#include "tests/unit/monitor/telemetry.hpp"

namespace fsi::monitor {
namespace {

std::string text_of(const Frame& frame) {
  std::string text;
  for (const std::string& line : frame.lines()) text += line + "\n";
  return text;
}

bool shows(const Frame& frame, const std::string& words) {
  return text_of(frame).find(words) != std::string::npos;
}

RunState coupled() {
  RunState state(entry("r-1"));
  auto gas = telemetry("fluid", "fluid", 7, 1);
  gas.health = {.min_rho = 0.5,
                .min_p = 0.25,
                .min_det_F = 0,
                .min_cell_quality = 1,
                .first_order_fallbacks = 3,
                .floors = 0};
  for (int k = 0; k < 20; ++k) {
    auto coupler = with_interface("beam", 40);
    coupler.t = 0.1 * k;
    coupler.interfaces[0].velocity_jump = 1e-3 * (k + 1);
    coupler.dt_reason = "fluid: acoustic waves";
    state.hear(coupler, 0.1 * k);
    state.hear(gas, 0.1 * k);
    state.hear(telemetry("solid", "beam", 7, 1), 0.1 * k);
  }
  return state;
}

TEST(Screen, ShowsEverythingOnEightyByTwentyFour) {
  const RunState state = coupled();
  for (const bool braille : {true, false}) {
    View view;
    view.braille = braille;
    const Frame frame = screen(state, 2, view, {.columns = 80, .rows = 24});
    for (const char* words :
         {"r-1", "running", "limited by fluid: acoustic waves", "coupler", "alive", "p50/p99", "min rho 0.5",
          "first order 3", "all finite", "v jump", "power", "along beam", "projected", "q quit"}) {
      EXPECT_TRUE(shows(frame, words)) << words << " is missing in\n" << text_of(frame);
    }
    const auto curves = [&](Style style) {
      int cells = 0;
      for (int row = 0; row < 24; ++row) {
        for (int column = 0; column < 80; ++column) cells += frame.at(column, row).style == style ? 1 : 0;
      }
      return cells;
    };
    EXPECT_GT(curves(Style::gas), 40) << "the predicted gas is drawn";
    EXPECT_GT(curves(Style::solid), 40);
    EXPECT_GT(curves(Style::projected), 40);
  }
}

TEST(Screen, ShowsWhichProgramIsRippledByTheGridAndWhere) {
  RunState state = coupled();
  EXPECT_FALSE(shows(screen(state, 2, {}, {.columns = 100, .rows = 30}), "WARNING"));
  auto solid = telemetry("solid", "beam", 8, 1);
  solid.noise = "v1 ripples by 4.1 % on grid \"ring\"";
  state.hear(solid, 2);
  EXPECT_TRUE(shows(screen(state, 2, {}, {.columns = 100, .rows = 30}),
                    "WARNING, beam: v1 ripples by 4.1 % on grid \"ring\""));
}

TEST(Screen, FitsAnyTerminalWhateverTheRunSays) {
  RunState state(entry("a run with a very long name " + std::string(200, 'x')));
  for (int k = 0; k < 40; ++k) {
    auto one = telemetry(k == 0 ? "coupler" : "solid",
                         "solid \x1b[31m" + std::to_string(k) + std::string(100, 'y'), 1, 1);
    one.interfaces.resize(30);
    one.interfaces[3] = with_interface("\xc3\xa9\x07", 4).interfaces[0];
    one.interfaces[3].p_projected[1] = std::numeric_limits<double>::infinity();
    one.dt = std::numeric_limits<double>::quiet_NaN();
    one.dt_reason = std::string(300, 'z');
    state.hear(one, 0);
  }
  for (const Extent extent : {Extent{80, 24}, Extent{20, 5}, Extent{1, 1}, Extent{300, 90}, Extent{80, 10}}) {
    for (const bool help : {false, true}) {
      View view;
      view.help = help;
      view.interface = 33;
      const Frame frame = screen(state, 0, view, extent);
      EXPECT_LE(std::ssize(frame.lines()), extent.rows);
      for (int row = 0; row < extent.rows; ++row) {
        for (int column = 0; column < extent.columns; ++column) {
          const char32_t character = frame.at(column, row).character;
          EXPECT_TRUE(character >= 0x20 && character != 0x7f)
              << "names from outside must not steer the terminal";
        }
      }
    }
  }
}

TEST(Screen, SaysWhereTextIsCutAndWhatShareOfTheStepsSomebodyLimits) {
  RunState state = coupled();
  EXPECT_TRUE(
      shows(screen(state, 2, {}, {.columns = 120, .rows = 24}), "acoustic waves, 100 % of the steps"));
  auto coupler = with_interface("beam", 4);
  coupler.t = 3;
  coupler.dt_reason = std::string(100, 'z');
  coupler.limits = {{.by = "fluid", .steps = 1}, {.by = "time.dt", .steps = 3}};
  state.hear(coupler, 3);
  const Frame frame = screen(state, 3, {}, {.columns = 80, .rows = 24});
  EXPECT_EQ(frame.at(79, 2).character, U'\u2026') << text_of(frame);
  View ascii;
  ascii.braille = false;
  EXPECT_EQ(screen(state, 3, ascii, {.columns = 80, .rows = 24}).at(79, 2).character, U'>');
  EXPECT_TRUE(shows(screen(state, 3, {}, {.columns = 240, .rows = 24}), "z, 25 % of the steps"));
}

TEST(Screen, RoundOffIsDrawnFlatAndZeroHasALine) {
  const auto rows_of = [](double size, double floor) {
    Frame frame({.columns = 40, .rows = 9});
    Plot plot{.title = "v_n", .curves = {{.style = Style::gas}}, .floor = floor};
    for (int k = 0; k < 40; ++k) {
      plot.curves[0].x.push_back(k);
      plot.curves[0].y.push_back(k % 2 == 0 ? size : -size);
    }
    draw(frame, frame.all(), plot, true);
    int rows = 0, zero = 0;
    for (int row = 1; row < 9; ++row) {
      bool drawn = false;
      for (int column = 0; column < 40; ++column) {
        drawn = drawn || frame.at(column, row).style == Style::gas;
        zero += frame.at(column, row).style == Style::dim ? 1 : 0;
      }
      rows += drawn ? 1 : 0;
    }
    return std::pair(rows, zero);
  };
  EXPECT_EQ(rows_of(1, 1e-9).first, 8);
  EXPECT_LE(rows_of(1e-16, 1e-9).first, 2) << "round-off does not fill the picture";
  Frame frame({.columns = 40, .rows = 9});
  draw(frame, frame.all(), {.title = "v_n", .curves = {{.x = {0, 1}, .y = {-1, 3}, .style = Style::gas}}},
       true);
  int dots = 0;
  for (int column = 0; column < 40; ++column) dots += frame.at(column, 6).style == Style::dim ? 1 : 0;
  EXPECT_GT(dots, 10) << "the line of zero, a quarter from below";
}

TEST(Screen, PowersOfRoundOffAreDrawnFlat) {
  const auto rows_of_powers = [](double size) {
    RunState state(entry("r-1"));
    for (int k = 0; k < 40; ++k) {
      auto coupler = with_interface("beam", 40);
      coupler.t = 0.1 * k;
      coupler.interfaces[0].power = k % 2 == 0 ? size : -size;
      state.hear(coupler, 0.1 * k);
    }
    const Frame frame = screen(state, 4, {}, {.columns = 80, .rows = 40});
    int rows = 0;
    for (int row = 30; row < 39; ++row) {
      bool drawn = false;
      for (int column = 60; column < 80; ++column)
        drawn = drawn ||
                (frame.at(column, row).style == Style::projected && frame.at(column, row).character > 0x2800);
      rows += drawn ? 1 : 0;
    }
    return rows;
  };
  EXPECT_GT(rows_of_powers(1e-3), 2);
  EXPECT_LE(rows_of_powers(1e-25), 2);
}

TEST(Screen, ARigidBodyHasNoTractionThatWouldBeCompared) {
  EXPECT_FALSE(shows(screen(coupled(), 2, {}, {.columns = 80, .rows = 40}), "lg w jump -"));
  RunState state(entry("r-1"));
  auto coupler = with_interface("beam", 40);
  coupler.interfaces[0].p_predicted_solid.clear();
  state.hear(coupler, 0);
  EXPECT_TRUE(shows(screen(state, 0, {}, {.columns = 80, .rows = 40}), "lg w jump -"));
}

TEST(Screen, NoTimeIsLeftWhileARunIsPaused) {
  RunState state = coupled();
  EXPECT_FALSE(shows(screen(state, 2, {}, {}), "left -"));
  auto coupler = with_interface("beam", 4);
  coupler.t = 2;
  coupler.state = "paused";
  state.hear(coupler, 2.1);
  EXPECT_TRUE(shows(screen(state, 2.1, {}, {}), "left -"));
}

TEST(Screen, SaysWhatIsWrong) {
  RunState state = coupled();
  state.see_process("fluid", Process::gone);
  EXPECT_TRUE(shows(screen(state, 2, {}, {}), "lost"));
  auto coupler = with_interface("beam", 4);
  coupler.interfaces[0].p_predicted[0] = std::numeric_limits<double>::quiet_NaN();
  state.hear(coupler, 3);
  EXPECT_TRUE(shows(screen(state, 3, {}, {}), "NOT FINITE: p of the gas at beam"));
  state.hear(wire::Abort{.run = "r", .from = "fluid", .exit_code = 3, .what = "p < 0"});
  EXPECT_TRUE(shows(screen(state, 3, {}, {}), "fluid ended the run: p < 0"));
}

TEST(Screen, AsksBeforeItStopsARun) {
  View view;
  view.ask_stop = true;
  EXPECT_TRUE(shows(screen(coupled(), 2, view, {}), "stop the run after this step?"));
}

TEST(Screen, ChooserMarksTheSelectedRunEvenInALongList) {
  std::vector<RunEntry> runs;
  for (int k = 0; k < 60; ++k) runs.push_back(entry("run-" + std::to_string(k)));
  EXPECT_TRUE(shows(chooser(runs, 0, {}), "> run-0"));
  EXPECT_TRUE(shows(chooser(runs, 59, {}), "> run-59"));
}

TEST(Plot, ARampRisesFromTheLowerLeftToTheUpperRight) {
  for (const bool braille : {true, false}) {
    Frame frame({.columns = 20, .rows = 11});
    draw(frame, frame.all(), {.title = "p", .curves = {{.x = {0, 1}, .y = {5, 7}}}}, braille);
    EXPECT_NE(frame.at(0, 10).character, U' ');
    EXPECT_NE(frame.at(19, 1).character, U' ');
    EXPECT_EQ(frame.at(0, 1).character, U' ');
    EXPECT_EQ(frame.at(19, 10).character, U' ');
    EXPECT_TRUE(shows(frame, "5 .. 7"));
  }
}

TEST(Plot, LogarithmicScaleMakesAGeometricSequenceALine) {
  Frame even({.columns = 30, .rows = 9}), curved({.columns = 30, .rows = 9});
  draw(even, even.all(), {.title = "", .curves = {{.x = {0, 1, 2}, .y = {0, 2, 4}}}}, true);
  draw(curved, curved.all(),
       {.title = "", .curves = {{.x = {0, 1, 2}, .y = {1e-4, 1e-2, 1}}}, .logarithmic = true}, true);
  for (int row = 1; row < 9; ++row) {
    for (int column = 0; column < 30; ++column) {
      EXPECT_EQ(even.at(column, row).character, curved.at(column, row).character);
    }
  }
}

TEST(Text, NumbersFitTheirColumnAndKeepTheirSize) {
  for (const double value : {0.0, 1.0, -1.23456789e-30, 9.87654e12, 123456.789, -0.00012345}) {
    const std::string text = compact(value, 8);
    EXPECT_LE(text.size(), 8U);
    EXPECT_NEAR(std::stod(text), value, 0.06 * std::abs(value));
  }
  EXPECT_EQ(compact(std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(Text, DurationsReadLikeTime) {
  EXPECT_EQ(duration_text(12.3), "12 s");
  EXPECT_EQ(duration_text(185), "3 min 05 s");
  EXPECT_EQ(duration_text(7800), "2 h 10 min");
  EXPECT_EQ(duration_text(std::numeric_limits<double>::infinity()), "-");
}

}  // namespace
}  // namespace fsi::monitor
