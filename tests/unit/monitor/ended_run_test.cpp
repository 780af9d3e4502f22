/// What a run left in its folder can be looked at again: its fields as pictures, its reports as a state.

#include "monitor/recording/ended_run.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/core/failure.hpp"
#include "common/core/field.hpp"
#include "common/io/grid_writer.hpp"
#include "common/io/part.hpp"
#include "common/program/picture.hpp"
#include "monitor/recording/field_files.hpp"

namespace fsi::monitor {
namespace {

namespace fs = std::filesystem;

/// A folder with the fields of a gas and a solid at three times.
class Folder : public testing::Test {
 public:
  Folder() : path_(fs::temp_directory_path() / ("fsi-ended-" + std::to_string(getpid()))) {
    fs::create_directories(path_);
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 6; ++i) {
        x_(0, i, j) = i + 0.1 * j;
        x_(1, i, j) = j;
        v_(0, i, j) = 3 * i;
        v_(1, i, j) = 4 * i;
      }
    }
    io::GridWriter gas(path_.string(), "fluid_left"), solid(path_.string(), "solid_beam");
    for (std::uint64_t k = 0; k < 3; ++k) {
      gas.write(0.5 * static_cast<double>(k), 10 * k, std::vector{grid()});
      solid.write(0.5 * static_cast<double>(k), 10 * k, std::vector{grid()});
    }
  }
  ~Folder() override { fs::remove_all(path_); }

  io::GridOutput grid() const {
    return {.grid = "g",
            .x = x_.view(),
            .u = {},
            .fields = {{.name = "v1", .field = v_.view(), .plane = 0},
                       {.name = "v2", .field = v_.view(), .plane = 1}}};
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }

  fs::path path_;
  Field x_{Layout(6, 4), 2}, v_{Layout(6, 4), 2};
};

TEST_F(Folder, ItsFieldsArePicturesOnceEachAndNotBeforeTheirTime) {
  FieldFiles files(path_.string());
  const std::vector<std::string> wishes{"fluid.speed", "solid.speed", "solid.no_such_thing",
                                        "fluid.pressure"};
  std::set<std::pair<std::string, std::uint64_t>> seen;
  for (const wire::Picture& one : files.next(wishes, 0.6)) seen.insert({one.from, one.step});
  EXPECT_EQ(seen, (std::set<std::pair<std::string, std::uint64_t>>{
                      {"left", 0}, {"left", 10}, {"beam", 0}, {"beam", 10}}));
  const std::vector<wire::Picture> rest = files.next(wishes, 9);
  ASSERT_EQ(rest.size(), 2U);
  EXPECT_TRUE(files.next(wishes, 9).empty());
  const auto expected = picture_of(std::vector{grid()}, "speed");
  ASSERT_TRUE(expected);
  EXPECT_EQ(rest[0].t, 1.0);
  EXPECT_EQ(rest[0].high, expected->high);
  EXPECT_EQ(rest[0].grids[0].level, expected->grids[0].level);
  EXPECT_EQ(rest[0].grids[0].x, expected->grids[0].x);
  EXPECT_EQ(rest[0].role, rest[0].from == "beam" ? "solid" : "fluid");
}

TEST_F(Folder, ASolidIsDrawnWhereItsUsedPointsAre) {
  constexpr int n1 = 600, n2 = 40;  // so many that not every point is a sample
  Field x(Layout(n1, n2), 2), u(Layout(n1, n2), 2), v(Layout(n1, n2), 2);
  io::GridOutput solid{.grid = "core",
                       .x = std::as_const(x).view(),
                       .u = std::as_const(u).view(),
                       .fields = {{.name = "v1", .field = std::as_const(v).view(), .plane = 0},
                                  {.name = "v2", .field = std::as_const(v).view(), .plane = 1}}};
  for (int j = 0; j < n2; ++j) {
    for (int i = 0; i < n1; ++i) {
      x(0, i, j) = i;
      x(1, i, j) = j;
      const bool used = i % 50 < 40;
      u(0, i, j) = used ? 0.25 : 1000;
      v(0, i, j) = i;
      solid.kinds.push_back(used ? 1 : 0);
    }
  }
  io::GridWriter writer(path_.string(), "solid_wall");
  writer.write(0, 0, std::vector{solid});
  const auto expected = picture_of(std::vector{solid}, "speed");
  ASSERT_TRUE(expected);
  ASSERT_LT(expected->grids[0].n1, static_cast<std::uint32_t>(n1));
  FieldFiles files(path_.string());
  bool found = false;
  for (const wire::Picture& one : files.next({"solid.speed"}, 0)) {
    if (one.from != "wall") continue;
    found = true;
    EXPECT_EQ(one.grids[0].level, expected->grids[0].level);
    EXPECT_EQ(one.grids[0].x, expected->grids[0].x);
  }
  EXPECT_TRUE(found);
}

TEST_F(Folder, WhatIsDamagedOrGoneIsPassedOver) {
  write("fluid_left.h5", "this is no such file");
  EXPECT_EQ(FieldFiles(path_.string()).next({"fluid.speed", "solid.speed"}, 9).size(), 3U);
  EXPECT_TRUE(FieldFiles("/no/such/folder").next({"fluid.speed"}, 9).empty());
  EXPECT_TRUE(FieldFiles("").next({"fluid.speed"}, 9).empty());
}

TEST_F(Folder, ItsReportsAreTheLastStateOfTheRun) {
  io::Part part;
  part.participant = part.role = "coupler";
  part.steps = 20;
  part.t = 1;
  part.limited_by = {{"left", 18}, {"time.growth", 2}};
  io::write_part(path_.string(), part);
  write("interface.csv", "step,t [time],dt [time],beam.gap [length]\n1,0.5,0.05,1e-3\n20,1,0.05,2e-3\n");
  EXPECT_THROW(EndedRun(path_.string()), UserMistake) << "it is not over";
  write("summary.json", R"({"case": "piston", "status": "failed", "reason": "left: it broke",
      "failure": {"told_by": "left", "exit_code": 3, "what": "it broke", "step": 21}})");
  EndedRun run(path_.string());
  RunState state(run.run());
  run.listen(state, 1);
  EXPECT_TRUE(state.over());
  EXPECT_EQ(state.run().name, "piston");
  EXPECT_EQ(state.leader()->limited_by, "left");
  EXPECT_EQ(state.leader()->dt, 0.05);
  ASSERT_EQ(state.interfaces().size(), 1U);
  EXPECT_EQ(state.interfaces()[0].gap, 2e-3);
  EXPECT_TRUE(std::isnan(state.interfaces()[0].shear)) << "its table has no such column";
  EXPECT_TRUE(std::isnan(state.interfaces()[0].p_max));
  EXPECT_EQ(state.progress(), 1) << "its summary does not say how far it was to go";
  ASSERT_TRUE(state.abort());
  EXPECT_EQ(state.abort()->place.step, 21);
}

TEST_F(Folder, ItsPresentValuesAreThoseOfTheLastLineHoweverLongTheTableIs) {
  io::Part part;
  part.participant = part.role = "coupler";
  constexpr int steps = 1498;  // so many that a point of a history stands for several lines, the last one too
  part.steps = steps;
  part.t = 0.1;
  part.limited_by = {{"left", steps - 1}, {"time.growth", 1}};
  io::write_part(path_.string(), part);
  {
    std::ofstream table(path_ / "interface.csv");
    table << "step,t [time],dt [time],beam.velocity_jump [length/time],beam.traction_jump [force/area],"
             "beam.gap [length],beam.power [power/depth],beam.shear [force/area],beam.p_max [force/area],"
             "limited_by\n";
    for (int k = 0; k <= steps; ++k) {
      const bool odd = k % 2 == 1;
      table << k << ',' << k * 0.1 / steps << ',' << (odd ? 2e-3 : 1e-3) << ',' << (odd ? 3 : 2) << ','
            << (odd ? 30 : 20) << ',' << (odd ? "1" : "1e-6") << ',' << (odd ? -5 : 0.25) << ','
            << (odd ? 0.7 : 0.5) << ',' << (odd ? 9 : 4) << ',' << (k < steps ? "left" : "time.growth")
            << '\n';
    }
  }
  write("summary.json", R"({"case": "piston", "status": "failed", "t": 0.1, "t_end": 0.8})");
  EndedRun run(path_.string());
  RunState state(run.run());
  run.listen(state, 1);
  ASSERT_EQ(state.interfaces().size(), 1U);
  const wire::Telemetry::Interface& side = state.interfaces()[0];
  EXPECT_EQ(side.velocity_jump, 2);
  EXPECT_EQ(side.traction_jump, 20);
  EXPECT_EQ(side.gap, 1e-6);
  EXPECT_EQ(side.power, 0.25);
  EXPECT_EQ(side.shear, 0.5);
  EXPECT_EQ(side.p_max, 4);
  EXPECT_EQ(state.leader()->dt, 1e-3);
  EXPECT_EQ(state.leader()->t_end, 0.8);
  EXPECT_DOUBLE_EQ(state.progress(), 0.125);
}

TEST_F(Folder, AnOutputThatCannotBeReadTakesNoOthersWithIt) {
  const auto steps_of = [&] {
    FieldFiles files(path_.string());
    std::set<std::uint64_t> steps;
    for (int again = 0; again < 3; ++again) {
      for (const wire::Picture& one : files.next({"fluid.speed"}, 9)) steps.insert(one.step);
    }
    return steps;
  };
  write("fields/fluid_left_000001.h5", "this is no such file");
  EXPECT_EQ(steps_of(), (std::set<std::uint64_t>{0, 20}));
  fs::remove(path_ / "fields" / "fluid_left_000001.h5");
  EXPECT_EQ(steps_of(), (std::set<std::uint64_t>{0, 20}));
  const fs::path newest = path_ / "fields" / "fluid_left_000002.h5", away = path_ / "away.h5";
  fs::rename(newest, away);
  FieldFiles files(path_.string());
  EXPECT_EQ(files.next({"fluid.speed"}, 9).size(), 1U);
  EXPECT_TRUE(files.next({"fluid.speed"}, 9).empty());
  fs::rename(away, newest);
  EXPECT_EQ(files.next({"fluid.speed"}, 9).size(), 1U) << "it was not there yet";
}

TEST_F(Folder, ItsReportsKeepWhatIsNotFiniteAndWhoLimitedTheLastStep) {
  io::Part coupler, gas;
  coupler.participant = coupler.role = "coupler";
  coupler.t = gas.t = 0.5;
  coupler.limited_by = {{"left", 2}, {"time.growth", 1}};
  coupler.interface = io::InterfaceExtremes{.velocity_scale = std::nan(""), .traction_scale = 3};
  gas.participant = "left";
  gas.role = "fluid";
  gas.health = {{"min_rho", 0.5}, {"min_p", std::nan("")}};
  for (const io::Part& part : {coupler, gas}) io::write_part(path_.string(), part);
  write("interface.csv",
        "step,t [time],beam.gap [length],limited_by\n1,0.1,0,left\n2,0.3,0,left\n3,0.5,0,time.growth\n");
  write("summary.json", R"({"case": "piston", "status": "completed"})");
  EndedRun run(path_.string());
  RunState state(run.run());
  run.listen(state, 1);
  EXPECT_EQ(state.programs().at("left").health.min_rho, 0.5);
  EXPECT_TRUE(std::isnan(state.programs().at("left").health.min_p)) << "the part has null";
  EXPECT_EQ(state.programs().at("left").health.min_det_F, 0) << "the part has none";
  EXPECT_EQ(state.non_finite(), std::vector<std::string>{"health of left"});
  EXPECT_TRUE(std::isnan(state.interfaces().at(0).velocity_scale));
  EXPECT_EQ(state.leader()->limited_by, "time.growth");
  EXPECT_EQ(state.history().limiters().changes().back().t, 0.3) << "nobody limited a step after the last one";
}

}  // namespace
}  // namespace fsi::monitor
