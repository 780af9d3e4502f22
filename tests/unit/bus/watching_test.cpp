/// Pictures of a run for whoever watches: nothing is drawn for nobody, and what is damaged goes no further.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/convert.hpp"
#include "common/bus/dds.hpp"
#include "common/bus/lengths.hpp"
#include "common/bus/peers/watchers.hpp"
#include "common/bus/sessions/listener.hpp"
#include "common/bus/sessions/solo_session.hpp"
#include "tests/unit/bus/seats.hpp"
#include "tests/waiting.hpp"

namespace fsi::bus::test {
namespace {

wire::Picture square(const std::string& quantity) {
  wire::Picture picture;
  picture.from = "fluid";
  picture.role = "fluid";
  picture.quantity = quantity;
  picture.high = 1;
  picture.grids = {
      {.name = "g", .n1 = 2, .n2 = 2, .straight = true, .x = {0, 1, 0, 1}, .level = {1, 2, 3, 4}}};
  return picture;
}

/// A solver, somebody who watches it, and how often it drew.
class Watched : public testing::Test {
 public:
  Watched()
      : solver_(options(own_run()), "fluid", "fluid"), draw_([this](const std::string& wish) {
          ++drawn_;
          return wish == "fluid.pressure" ? std::optional(square("pressure")) : std::nullopt;
        }) {}

  /// The solver looks for watchers, as it does whenever it has sent telemetry.
  bool due() {
    solver_.publish(wire::Telemetry{});
    return solver_.picture_due();
  }
  bool seen(Listener& listener, std::vector<wire::Picture>& pictures) const {
    listener.wait(0.05);
    for (wire::Picture& one : listener.pictures()) pictures.push_back(std::move(one));
    return !pictures.empty();
  }

  SoloSession solver_;
  int drawn_ = 0;
  Draw draw_;
};

TEST_F(Watched, NothingIsDrawnUntilSomebodyWatches) {
  EXPECT_FALSE(due());
  solver_.show(draw_, 1, true);
  EXPECT_EQ(drawn_, 0);
  Listener listener(own_run());
  listener.wait(0);  // it listens, but watches no pictures
  EXPECT_FALSE(due());
  ASSERT_TRUE(fsi::test::until([&] {
    listener.watch({"fluid.pressure"});
    listener.wait(0.05);
    return due();
  }));
  std::vector<wire::Picture> pictures;
  ASSERT_TRUE(fsi::test::until([&] {
    listener.watch({"fluid.pressure"});
    solver_.show(draw_, 1, true);
    return seen(listener, pictures);
  }));
  EXPECT_GT(drawn_, 0);
  EXPECT_EQ(pictures[0].quantity, "pressure");
  EXPECT_EQ(pictures[0].run, own_run());
  EXPECT_EQ(pictures[0].grids.at(0).level, square("pressure").grids[0].level);
}

TEST_F(Watched, WhatWasShownOfAPausedStateIsNotDrawnAgain) {
  Listener listener(own_run());
  ASSERT_TRUE(fsi::test::until([&] {
    listener.watch({"fluid.pressure"});
    listener.wait(0.05);
    return due();
  }));
  solver_.show_missing(draw_, 7);
  solver_.show_missing(draw_, 7);
  EXPECT_EQ(drawn_, 1);
  solver_.show_missing(draw_, 8);
  EXPECT_EQ(drawn_, 2);
}

TEST_F(Watched, DamagedPicturesAreLeftOut) {
  Listener listener(own_run());
  const Entity participant = create_participant(own_run());
  Writer<amp_fsi_Picture> forger(participant, picture_topic, Delivery::listening);
  wire::Picture damaged = square("forged"), sound = square("pressure");
  damaged.run = sound.run = own_run();
  damaged.grids[0].n2 = 40000;
  std::vector<wire::Picture> pictures;
  ASSERT_TRUE(fsi::test::until([&] {
    listener.watch({"fluid.pressure"});
    forger.write(borrow(damaged).sample);
    forger.write(borrow(sound).sample);
    return seen(listener, pictures);
  }));
  for (const wire::Picture& one : pictures) EXPECT_EQ(one.quantity, "pressure");
}

TEST(Pictures, AreSoundOnlyWithArraysOfTheLengthsTheyPromise) {
  EXPECT_TRUE(is_sound(square("pressure")));
  using Damage = std::function<void(wire::Picture&)>;
  const std::vector<Damage> damages = {
      [](auto& p) { p.grids[0].n1 = 0; },
      [](auto& p) { p.grids[0].n1 = 3; },
      [](auto& p) { p.grids[0].n1 = 1U << 31, p.grids[0].n2 = 1U << 31; },
      [](auto& p) { p.grids[0].straight = false; },
      [](auto& p) { p.grids[0].x.pop_back(); },
      [](auto& p) { p.grids[0].x[1] = std::numeric_limits<float>::infinity(); },
      [](auto& p) { p.grids[0].level.push_back(1); },
      [](auto& p) { p.low = 2; },
      [](auto& p) { p.high = std::nan(""); },
      [](auto& p) { p.from.assign(1000, 'x'); },
      [](auto& p) {  // each grid is sound
        p.grids[0].n1 = p.grids[0].n2 = 256;
        p.grids[0].x.assign(512, 0);
        p.grids[0].level.assign(1 << 16, 1);
        p.grids.resize(5, wire::Picture::Grid(p.grids[0]));
      },
      [](auto& p) { p.grids.resize(wire::Picture::most_grids + 1, wire::Picture::Grid(p.grids[0])); }};
  for (std::size_t k = 0; k < damages.size(); ++k) {
    wire::Picture picture = square("pressure");
    damages[k](picture);
    EXPECT_FALSE(is_sound(picture)) << "damage " << k;
  }
}

TEST(Traffic, IsCountedPerInterfaceAndDirection) {
  const std::string run = own_run();
  constexpr std::uint64_t exchanged = 5;
  Listener listener(run);
  const auto solve = [&run](const wire::Hello& self) {
    SolverSession session(options(run), self);
    for (std::uint64_t step = 0; step < exchanged; ++step) {
      session.publish(predicted(step));
      session.receive("beam", step);
    }
    const Statistics all = session.statistics();
    EXPECT_EQ(all.messages, 2 * exchanged);
    session.publish(wire::Telemetry{});
    session.leave();
  };
  auto fluid = in_thread([&] { solve(gas()); }), beam = in_thread([&] { solve(solid()); });
  std::vector<wire::Telemetry> heard;
  auto coupler = in_thread([&] {
    CouplerSession session(options(run), gas_and_solid(), "one case");
    for (std::uint64_t step = 0; step < exchanged; ++step) {
      session.gather(step);
      session.scatter(std::vector{projected("fluid", step), projected("beam", step)});
    }
    ASSERT_TRUE(fsi::test::until([&] {
      session.publish(wire::Telemetry{});
      for (wire::Telemetry& one : listener.wait(0.05)) {
        if (one.role == "coupler") heard.push_back(std::move(one));
      }
      return !heard.empty();
    }));
    session.leave();
  });
  for (auto* program : {&fluid, &beam, &coupler}) EXPECT_EQ(program->get().reason, "");
  ASSERT_EQ(heard.at(0).traffic.size(), 2U);
  for (const wire::Traffic& one : heard[0].traffic) {
    EXPECT_EQ(one.interface, "beam");
    EXPECT_EQ(one.messages, exchanged);
    EXPECT_EQ(one.bytes, exchanged * 6 * sizeof(double));  // v of three points
    EXPECT_GE(one.latency_p99_us, one.latency_p50_us);
  }
  EXPECT_EQ(heard[0].traffic[0].from, "fluid");
  EXPECT_EQ(heard[0].traffic[1].from, "beam");
}

}  // namespace
}  // namespace fsi::bus::test
