/// Plain structures survive the way into the IDL types and back; odd names make valid topics.

#include "common/bus/convert.hpp"

#include <gtest/gtest.h>

#include <set>

#include "common/bus/dds.hpp"
#include "common/bus/lengths.hpp"
#include "common/bus/options.hpp"
#include "common/core/failure.hpp"

namespace fsi::bus {
namespace {

/// There and back.
template <class Message>
Message carried(const Message& message) {
  const auto sample = borrow(message);
  Message result;
  if constexpr (requires { sample.parts; }) {
    copy(sample.sample, result);
  } else {
    copy(sample, result);
  }
  return result;
}

TEST(Convert, PredictedStateKeepsEveryField) {
  const wire::PredictedInterface out{.run = "r",
                                     .from = "beam",
                                     .interface = "i",
                                     .step = 9,
                                     .t = 1,
                                     .proposed_dt = 2,
                                     .dt_reason = "why",
                                     .x = {1, 2},
                                     .v = {3},
                                     .a = {3.5},
                                     .w = {4},
                                     .p = {5},
                                     .z_f = {6},
                                     .rho = {6.25},
                                     .gamma = {6.5},
                                     .Z = {7, 8, 9},
                                     .z_p = 10,
                                     .fixed = {1, 0},
                                     .p_e = 11,
                                     .modal = {.modes = 1,
                                               .S = {.row = {0}, .column = {1}, .value = {12}},
                                               .g = {13},
                                               .N = {.row = {2}, .column = {3}, .value = {14}},
                                               .q_dot = {15}},
                                     .health = {16, 17, 18, 18.5, 19, 20},
                                     .compute_s = 21,
                                     .wait_s = 22};
  const wire::PredictedInterface in = carried(out);
  EXPECT_EQ(std::tie(in.run, in.from, in.interface, in.step, in.t, in.proposed_dt, in.dt_reason),
            std::tie(out.run, out.from, out.interface, out.step, out.t, out.proposed_dt, out.dt_reason));
  EXPECT_EQ(std::tie(in.x, in.v, in.a, in.w, in.p, in.z_f, in.rho, in.gamma, in.Z, in.z_p, in.fixed, in.p_e),
            std::tie(out.x, out.v, out.a, out.w, out.p, out.z_f, out.rho, out.gamma, out.Z, out.z_p,
                     out.fixed, out.p_e));
  EXPECT_EQ(std::tie(in.modal.modes, in.modal.g, in.modal.q_dot),
            std::tie(out.modal.modes, out.modal.g, out.modal.q_dot));
  for (const auto matrix : {&wire::ModalResponse::S, &wire::ModalResponse::N}) {
    const wire::SparseMatrix &i = in.modal.*matrix, &o = out.modal.*matrix;
    EXPECT_EQ(std::tie(i.row, i.column, i.value), std::tie(o.row, o.column, o.value));
  }
  EXPECT_EQ(std::tie(in.health.min_rho, in.health.min_p, in.health.min_det_F, in.health.min_cell_quality,
                     in.health.first_order_fallbacks, in.health.floors),
            std::tie(out.health.min_rho, out.health.min_p, out.health.min_det_F, out.health.min_cell_quality,
                     out.health.first_order_fallbacks, out.health.floors));
  EXPECT_EQ(std::tie(in.compute_s, in.wait_s), std::tie(out.compute_s, out.wait_s));
}

TEST(Convert, ProjectedStateKeepsEveryField) {
  const wire::ProjectedInterface out{.run = "r",
                                     .to = "beam",
                                     .interface = "i",
                                     .step = 9,
                                     .t = 1,
                                     .n = {2, 3},
                                     .v_n = {4},
                                     .w_n = {5},
                                     .v = {6, 7},
                                     .a = {8},
                                     .q_dot = {8.5},
                                     .z_f = {9},
                                     .robin_t = {10, 11},
                                     .robin_r = {12, 13},
                                     .dt_next = 14,
                                     .t_next = 15,
                                     .substeps_next = 16,
                                     .x_next = {17},
                                     .write_output = true,
                                     .write_checkpoint = true,
                                     .show = true,
                                     .stop = true,
                                     .stop_reason = "end"};
  const wire::ProjectedInterface in = carried(out);
  EXPECT_EQ(std::tie(in.run, in.to, in.interface, in.step, in.t, in.n, in.v_n, in.w_n, in.v, in.a, in.q_dot,
                     in.z_f),
            std::tie(out.run, out.to, out.interface, out.step, out.t, out.n, out.v_n, out.w_n, out.v, out.a,
                     out.q_dot, out.z_f));
  EXPECT_EQ(std::tie(in.robin_t, in.robin_r, in.dt_next, in.t_next, in.substeps_next, in.x_next,
                     in.write_output, in.write_checkpoint, in.show, in.stop, in.stop_reason),
            std::tie(out.robin_t, out.robin_r, out.dt_next, out.t_next, out.substeps_next, out.x_next,
                     out.write_output, out.write_checkpoint, out.show, out.stop, out.stop_reason));
}

TEST(Convert, HelloKeepsItsInterfaces) {
  const wire::Hello hello{.run = "r",
                          .role = "solid",
                          .name = "beam",
                          .law = "neo",
                          .config_digest = "d",
                          .host = "h",
                          .pid = 3,
                          .points = 4,
                          .build = "b",
                          .interfaces = {{.name = "a", .dimension = 2, .x = {1, 2}, .n = {0, 1}},
                                         {.name = "b", .dimension = 1, .x = {3}, .n = {}}}};
  const wire::Hello in = carried(hello);
  ASSERT_EQ(in.interfaces.size(), 2U);
  EXPECT_EQ(in.interfaces[0].n, hello.interfaces[0].n);
  EXPECT_EQ(in.interfaces[1].x, hello.interfaces[1].x);
  EXPECT_EQ(
      std::tie(in.run, in.role, in.name, in.law, in.config_digest, in.host, in.pid, in.points, in.build),
      std::tie(hello.run, hello.role, hello.name, hello.law, hello.config_digest, hello.host, hello.pid,
               hello.points, hello.build));
}

/// Telemetry without interfaces, every number of its own.
wire::Telemetry telemetry() {
  return {.run = "r",
          .from = "coupler",
          .role = "coupler",
          .state = "waiting",
          .host = "here",
          .pid = 12,
          .step = 1,
          .t = 2,
          .t_end = 3,
          .dt = 4,
          .dt_reason = "gas",
          .proposed_dt = 4.5,
          .limited_by = "fluid",
          .limits = {{.by = "fluid", .steps = 40}, {.by = "time.growth", .steps = 2}},
          .compute_s = 5,
          .wait_s = 6,
          .point_updates_per_s = 7,
          .health = {1, 2, 3, 3.5, 4, 5},
          .noise = "v1 ripples",
          .messages = 8,
          .bytes = 9,
          .round_trip_p50_us = 10,
          .round_trip_p99_us = 11,
          .interfaces = {},
          .traffic = {{.interface = "beam",
                       .from = "fluid",
                       .messages = 12,
                       .bytes = 13,
                       .missing = 14,
                       .dropped = 15,
                       .latency_p50_us = 16,
                       .latency_p99_us = 17}}};
}

wire::Telemetry::Interface interface_telemetry() {
  return {.name = "beam",
          .velocity_jump = 1,
          .traction_jump = 2,
          .gap = 3,
          .power = 4,
          .shear = 4.5,
          .velocity_scale = 4.6,
          .traction_scale = 4.7,
          .p_min = 5,
          .p_max = 6,
          .v_min = 7,
          .v_max = 8,
          .closed = true,
          .s = {9},
          .x = {10, 11},
          .x_start = {10.5, 11.5},
          .p_predicted = {12},
          .p_predicted_solid = {13},
          .p_projected = {14},
          .w_tangential = {14.5},
          .v_predicted = {15},
          .v_predicted_gas = {16},
          .v_projected = {17}};
}

TEST(Convert, TelemetryKeepsEveryField) {
  const wire::Telemetry out = telemetry(), in = carried(out);
  EXPECT_EQ(std::tie(in.run, in.from, in.role, in.state, in.host, in.pid, in.step, in.t, in.t_end, in.dt,
                     in.dt_reason),
            std::tie(out.run, out.from, out.role, out.state, out.host, out.pid, out.step, out.t, out.t_end,
                     out.dt, out.dt_reason));
  EXPECT_EQ(std::tie(in.compute_s, in.wait_s, in.point_updates_per_s, in.messages, in.bytes,
                     in.round_trip_p50_us, in.round_trip_p99_us, in.health.floors, in.noise),
            std::tie(out.compute_s, out.wait_s, out.point_updates_per_s, out.messages, out.bytes,
                     out.round_trip_p50_us, out.round_trip_p99_us, out.health.floors, out.noise));
  EXPECT_EQ(std::tie(in.proposed_dt, in.limited_by), std::tie(out.proposed_dt, out.limited_by));
  ASSERT_EQ(in.limits.size(), 2U);
  EXPECT_EQ(std::tie(in.limits[0].by, in.limits[1].by), std::tie(out.limits[0].by, out.limits[1].by));
  EXPECT_EQ(std::pair(in.limits[0].steps, in.limits[1].steps), std::pair(40UL, 2UL));
  ASSERT_EQ(in.traffic.size(), 1U);
  const wire::Traffic &there = in.traffic[0], &here = out.traffic[0];
  EXPECT_EQ(std::tie(there.interface, there.from, there.messages, there.bytes, there.missing, there.dropped,
                     there.latency_p50_us, there.latency_p99_us),
            std::tie(here.interface, here.from, here.messages, here.bytes, here.missing, here.dropped,
                     here.latency_p50_us, here.latency_p99_us));
}

TEST(Convert, WishesAndPicturesKeepEveryField) {
  const wire::Watch watch{.run = "r", .wishes = {"fluid.pressure", "solid.speed"}};
  const wire::Watch heard = carried(watch);
  EXPECT_EQ(std::tie(heard.run, heard.wishes), std::tie(watch.run, watch.wishes));
  const wire::Picture out{
      .run = "r",
      .from = "fluid",
      .quantity = "pressure",
      .role = "gas",
      .step = 1,
      .t = 2,
      .low = 3,
      .high = 4,
      .grids = {{.name = "g", .n1 = 2, .n2 = 1, .straight = true, .x = {5, 6, 7}, .level = {0, 65535}}}};
  const wire::Picture in = carried(out);
  EXPECT_EQ(std::tie(in.run, in.from, in.quantity, in.role, in.step, in.t, in.low, in.high),
            std::tie(out.run, out.from, out.quantity, out.role, out.step, out.t, out.low, out.high));
  ASSERT_EQ(in.grids.size(), 1U);
  const auto &there = in.grids[0], &here = out.grids[0];
  EXPECT_EQ(std::tie(there.name, there.n1, there.n2, there.straight, there.x, there.level),
            std::tie(here.name, here.n1, here.n2, here.straight, here.x, here.level));
}

TEST(Convert, TelemetryKeepsItsInterfaces) {
  wire::Telemetry out = telemetry();
  out.interfaces = {interface_telemetry()};
  const wire::Telemetry in = carried(out);
  ASSERT_EQ(in.interfaces.size(), 1U);
  const auto &there = in.interfaces[0], &here = out.interfaces[0];
  EXPECT_EQ(std::tie(there.name, there.velocity_jump, there.traction_jump, there.gap, there.power,
                     there.shear, there.velocity_scale, there.traction_scale, there.p_min, there.p_max,
                     there.v_min, there.v_max, there.closed),
            std::tie(here.name, here.velocity_jump, here.traction_jump, here.gap, here.power, here.shear,
                     here.velocity_scale, here.traction_scale, here.p_min, here.p_max, here.v_min, here.v_max,
                     here.closed));
  EXPECT_EQ(
      std::tie(there.s, there.x, there.x_start, there.p_predicted, there.p_predicted_solid, there.p_projected,
               there.w_tangential, there.v_predicted, there.v_predicted_gas, there.v_projected),
      std::tie(here.s, here.x, here.x_start, here.p_predicted, here.p_predicted_solid, here.p_projected,
               here.w_tangential, here.v_predicted, here.v_predicted_gas, here.v_projected));
}

TEST(Convert, RequestKeepsEveryField) {
  const wire::Control out{.run = "r", .command = "stop"};
  const wire::Control in = carried(out);
  EXPECT_EQ(std::tie(in.run, in.command), std::tie(out.run, out.command));
}

TEST(Convert, WaitingKeepsEveryField) {
  const wire::Waiting out{.run = "r", .from = "me", .to = "you", .topic = "t", .step = 7};
  const wire::Waiting in = carried(out);
  EXPECT_EQ(std::tie(in.run, in.from, in.to, in.topic, in.step),
            std::tie(out.run, out.from, out.to, out.topic, out.step));
}

TEST(Convert, OutgoingArraysAreBorrowedNotCopied) {
  wire::PredictedInterface state;
  state.x = {1, 2, 3};
  const amp_fsi_PredictedInterface sample = borrow(state);
  EXPECT_EQ(sample.x._buffer, state.x.data());
  EXPECT_FALSE(sample.x._release);
}

TEST(Topics, OddNamesNeitherCollideNorLeaveTheAlphabet) {
  const std::set<std::string> names = {
      topic_name("predicted", {"a/b", "c"}), topic_name("predicted", {"a", "b/c"}),
      topic_name("predicted", {"a b", "c"}), topic_name("predicted", {"a_20b", "c"})};
  EXPECT_EQ(names.size(), 4U);
  EXPECT_EQ(topic_name("predicted", {"a b", "c_d"}), "amp_fsi/predicted/a_20b/c__d");
}

TEST(Topics, DomainOfAnyRunLiesBelowTheEphemeralPorts) {
  for (int k = 0; k < 1000; ++k) {
    const std::uint32_t domain = domain_of("run " + std::to_string(k));
    EXPECT_GE(domain, 1U);
    EXPECT_LE(domain, 100U);
  }
}

TEST(Lengths, AbsurdModesAndRobinLevelsAreRefused) {
  const InterfaceSize size{.points = 2, .dimension = 2};
  wire::PredictedInterface predicted;
  predicted.modal.modes = 1000000;
  EXPECT_THROW(check_lengths(predicted, size), PeerLost);
  predicted.modal.modes = -1;
  EXPECT_THROW(check_lengths(predicted, size), PeerLost);
  predicted.modal = {
      .modes = 1, .S = {.row = {0}, .column = {0}, .value = {1}}, .g = {0}, .N = {}, .q_dot = {0}};
  EXPECT_NO_THROW(check_lengths(predicted, size));
  predicted.modal.N = {.row = {0}, .column = {2}, .value = {1}};
  EXPECT_THROW(check_lengths(predicted, size), PeerLost) << "the interface has two points";
  predicted.modal.N = {.row = {0}, .column = {}, .value = {1}};
  EXPECT_THROW(check_lengths(predicted, size), PeerLost) << "no column";
  wire::ProjectedInterface projected;
  projected.robin_t = {0, 1};
  projected.robin_r = {1, 2, 3};
  EXPECT_THROW(check_lengths(projected, size), PeerLost);
  projected.robin_r = {1, 2, 3, 4};
  EXPECT_NO_THROW(check_lengths(projected, size));
}

}  // namespace
}  // namespace fsi::bus
