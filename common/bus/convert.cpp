#include "common/bus/convert.hpp"

#include <cstring>

namespace fsi::bus {

namespace {

/// DDS never writes through a borrowed pointer, but its C types know no const.
template <class Sequence, class Element>
Sequence borrowed(const std::vector<Element>& values) {
  Sequence sequence{};
  sequence._length = sequence._maximum = static_cast<std::uint32_t>(values.size());
  sequence._buffer = const_cast<Element*>(values.data());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  sequence._release = false;
  return sequence;
}

amp_fsi_Numbers borrow(const std::vector<double>& values) {
  return borrowed<amp_fsi_Numbers>(values);
}

amp_fsi_Flags borrow(const std::vector<std::uint8_t>& values) {
  return borrowed<amp_fsi_Flags>(values);
}

amp_fsi_Health borrow(const wire::Health& health) {
  return {.min_rho = health.min_rho,
          .min_p = health.min_p,
          .min_det_F = health.min_det_F,
          .min_cell_quality = health.min_cell_quality,
          .first_order_fallbacks = health.first_order_fallbacks,
          .floors = health.floors};
}

amp_fsi_Indices borrow(const std::vector<std::int32_t>& values) {
  return borrowed<amp_fsi_Indices>(values);
}

amp_fsi_SparseMatrix borrow(const wire::SparseMatrix& matrix) {
  return {.row = borrow(matrix.row), .column = borrow(matrix.column), .value = borrow(matrix.value)};
}

amp_fsi_ModalResponse borrow(const wire::ModalResponse& modal) {
  return {.modes = modal.modes,
          .S = borrow(modal.S),
          .g = borrow(modal.g),
          .N = borrow(modal.N),
          .q_dot = borrow(modal.q_dot)};
}

void copy(const amp_fsi_Numbers& from, std::vector<double>& to) {
  to.assign(from._buffer, from._buffer + from._length);
}

void copy(const amp_fsi_Flags& from, std::vector<std::uint8_t>& to) {
  to.assign(from._buffer, from._buffer + from._length);
}

void copy(const amp_fsi_Indices& from, std::vector<std::int32_t>& to) {
  to.assign(from._buffer, from._buffer + from._length);
}

void copy(const amp_fsi_SparseMatrix& from, wire::SparseMatrix& to) {
  copy(from.row, to.row);
  copy(from.column, to.column);
  copy(from.value, to.value);
}

void copy(const char* from, std::string& to) {
  to = from == nullptr ? "" : from;
}

void copy(const amp_fsi_Health& from, wire::Health& to) {
  to.min_rho = from.min_rho;
  to.min_p = from.min_p;
  to.min_det_F = from.min_det_F;
  to.min_cell_quality = from.min_cell_quality;
  to.first_order_fallbacks = from.first_order_fallbacks;
  to.floors = from.floors;
}

void copy(const amp_fsi_ModalResponse& from, wire::ModalResponse& to) {
  to.modes = from.modes;
  copy(from.S, to.S);
  copy(from.g, to.g);
  copy(from.N, to.N);
  copy(from.q_dot, to.q_dot);
}

template <class... Vectors>
std::size_t bytes_of(const Vectors&... vectors) {
  return (... + (vectors.size() * sizeof(vectors[0])));
}

}  // namespace

char* borrow(const std::string& text) {
  return const_cast<char*>(text.c_str());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

bool same(const char* incoming, const std::string& text) {
  return incoming != nullptr && text == incoming;
}

Borrowed<amp_fsi_Hello, amp_fsi_InterfaceInfo> borrow(const wire::Hello& hello) {
  Borrowed<amp_fsi_Hello, amp_fsi_InterfaceInfo> result;
  for (const wire::InterfaceInfo& info : hello.interfaces) {
    result.parts.push_back(
        {.name = borrow(info.name), .dimension = info.dimension, .x = borrow(info.x), .n = borrow(info.n)});
  }
  result.sample = {.protocol = hello.protocol,
                   .run = borrow(hello.run),
                   .role = borrow(hello.role),
                   .name = borrow(hello.name),
                   .law = borrow(hello.law),
                   .config_digest = borrow(hello.config_digest),
                   .host = borrow(hello.host),
                   .pid = hello.pid,
                   .points = hello.points,
                   .interfaces = borrowed<dds_sequence_amp_fsi_InterfaceInfo>(result.parts)};
  return result;
}

Borrowed<amp_fsi_Telemetry, amp_fsi_InterfaceTelemetry> borrow(const wire::Telemetry& telemetry) {
  Borrowed<amp_fsi_Telemetry, amp_fsi_InterfaceTelemetry> result;
  for (const wire::Telemetry::Interface& side : telemetry.interfaces) {
    result.parts.push_back({.name = borrow(side.name),
                            .velocity_jump = side.velocity_jump,
                            .traction_jump = side.traction_jump,
                            .gap = side.gap,
                            .power = side.power,
                            .p_min = side.p_min,
                            .p_max = side.p_max,
                            .v_min = side.v_min,
                            .v_max = side.v_max,
                            .closed = side.closed,
                            .s = borrow(side.s),
                            .x = borrow(side.x),
                            .p_predicted = borrow(side.p_predicted),
                            .p_predicted_solid = borrow(side.p_predicted_solid),
                            .p_projected = borrow(side.p_projected),
                            .v_predicted = borrow(side.v_predicted),
                            .v_predicted_gas = borrow(side.v_predicted_gas),
                            .v_projected = borrow(side.v_projected)});
  }
  result.sample = {.run = borrow(telemetry.run),
                   .from = borrow(telemetry.from),
                   .role = borrow(telemetry.role),
                   .state = borrow(telemetry.state),
                   .host = borrow(telemetry.host),
                   .pid = telemetry.pid,
                   .step = telemetry.step,
                   .t = telemetry.t,
                   .t_end = telemetry.t_end,
                   .dt = telemetry.dt,
                   .dt_reason = borrow(telemetry.dt_reason),
                   .compute_s = telemetry.compute_s,
                   .wait_s = telemetry.wait_s,
                   .point_updates_per_s = telemetry.point_updates_per_s,
                   .health = borrow(telemetry.health),
                   .noise = borrow(telemetry.noise),
                   .messages = telemetry.messages,
                   .bytes = telemetry.bytes,
                   .round_trip_p50_us = telemetry.round_trip_p50_us,
                   .round_trip_p99_us = telemetry.round_trip_p99_us,
                   .interfaces = borrowed<dds_sequence_amp_fsi_InterfaceTelemetry>(result.parts)};
  return result;
}

amp_fsi_PredictedInterface borrow(const wire::PredictedInterface& predicted) {
  return {.run = borrow(predicted.run),
          .from = borrow(predicted.from),
          .interface_name = borrow(predicted.interface),
          .step = predicted.step,
          .t = predicted.t,
          .dt_bid = predicted.dt_bid,
          .dt_reason = borrow(predicted.dt_reason),
          .x = borrow(predicted.x),
          .v = borrow(predicted.v),
          .w = borrow(predicted.w),
          .p = borrow(predicted.p),
          .z_f = borrow(predicted.z_f),
          .rho = borrow(predicted.rho),
          .gamma = borrow(predicted.gamma),
          .Z = borrow(predicted.Z),
          .z_p = predicted.z_p,
          .is_fixed = borrow(predicted.fixed),
          .p_e = predicted.p_e,
          .modal = borrow(predicted.modal),
          .health = borrow(predicted.health),
          .compute_s = predicted.compute_s,
          .wait_s = predicted.wait_s};
}

amp_fsi_ProjectedInterface borrow(const wire::ProjectedInterface& projected) {
  return {.run = borrow(projected.run),
          .to = borrow(projected.to),
          .interface_name = borrow(projected.interface),
          .step = projected.step,
          .t = projected.t,
          .n = borrow(projected.n),
          .v_n = borrow(projected.v_n),
          .w_n = borrow(projected.w_n),
          .v = borrow(projected.v),
          .a = borrow(projected.a),
          .q_dot = borrow(projected.q_dot),
          .z_f = borrow(projected.z_f),
          .robin_t = borrow(projected.robin_t),
          .robin_r = borrow(projected.robin_r),
          .dt_next = projected.dt_next,
          .t_next = projected.t_next,
          .substeps_next = projected.substeps_next,
          .x_next = borrow(projected.x_next),
          .write_output = projected.write_output,
          .write_checkpoint = projected.write_checkpoint,
          .stop = projected.stop,
          .stop_reason = borrow(projected.stop_reason)};
}

amp_fsi_Abort borrow(const wire::Abort& abort) {
  return {.run = borrow(abort.run),
          .from = borrow(abort.from),
          .exit_code = abort.exit_code,
          .reason = borrow(abort.reason)};
}

amp_fsi_Control borrow(const wire::Control& control) {
  return {.run = borrow(control.run), .command = borrow(control.command)};
}

amp_fsi_Waiting borrow(const wire::Waiting& waiting) {
  return {.run = borrow(waiting.run),
          .from = borrow(waiting.from),
          .to = borrow(waiting.to),
          .topic = borrow(waiting.topic),
          .step = waiting.step};
}

void copy(const amp_fsi_Hello& from, wire::Hello& to) {
  to.protocol = from.protocol;
  copy(from.run, to.run);
  copy(from.role, to.role);
  copy(from.name, to.name);
  copy(from.law, to.law);
  copy(from.config_digest, to.config_digest);
  copy(from.host, to.host);
  to.pid = from.pid;
  to.points = from.points;
  to.interfaces.resize(from.interfaces._length);
  for (std::uint32_t k = 0; k < from.interfaces._length; ++k) {
    const amp_fsi_InterfaceInfo& info = from.interfaces._buffer[k];
    copy(info.name, to.interfaces[k].name);
    to.interfaces[k].dimension = info.dimension;
    copy(info.x, to.interfaces[k].x);
    copy(info.n, to.interfaces[k].n);
  }
}

void copy(const amp_fsi_Telemetry& from, wire::Telemetry& to) {
  copy(from.run, to.run);
  copy(from.from, to.from);
  copy(from.role, to.role);
  copy(from.state, to.state);
  copy(from.host, to.host);
  to.pid = from.pid;
  to.step = from.step;
  to.t = from.t;
  to.t_end = from.t_end;
  to.dt = from.dt;
  copy(from.dt_reason, to.dt_reason);
  to.compute_s = from.compute_s;
  to.wait_s = from.wait_s;
  to.point_updates_per_s = from.point_updates_per_s;
  copy(from.health, to.health);
  copy(from.noise, to.noise);
  to.messages = from.messages;
  to.bytes = from.bytes;
  to.round_trip_p50_us = from.round_trip_p50_us;
  to.round_trip_p99_us = from.round_trip_p99_us;
  to.interfaces.resize(from.interfaces._length);
  for (std::uint32_t k = 0; k < from.interfaces._length; ++k) {
    const amp_fsi_InterfaceTelemetry& in = from.interfaces._buffer[k];
    wire::Telemetry::Interface& out = to.interfaces[k];
    copy(in.name, out.name);
    out.velocity_jump = in.velocity_jump;
    out.traction_jump = in.traction_jump;
    out.gap = in.gap;
    out.power = in.power;
    out.p_min = in.p_min;
    out.p_max = in.p_max;
    out.v_min = in.v_min;
    out.v_max = in.v_max;
    out.closed = in.closed;
    copy(in.s, out.s);
    copy(in.x, out.x);
    copy(in.p_predicted, out.p_predicted);
    copy(in.p_predicted_solid, out.p_predicted_solid);
    copy(in.p_projected, out.p_projected);
    copy(in.v_predicted, out.v_predicted);
    copy(in.v_predicted_gas, out.v_predicted_gas);
    copy(in.v_projected, out.v_projected);
  }
}

void copy(const amp_fsi_PredictedInterface& from, wire::PredictedInterface& to) {
  copy(from.run, to.run);
  copy(from.from, to.from);
  copy(from.interface_name, to.interface);
  to.step = from.step;
  to.t = from.t;
  to.dt_bid = from.dt_bid;
  copy(from.dt_reason, to.dt_reason);
  copy(from.x, to.x);
  copy(from.v, to.v);
  copy(from.w, to.w);
  copy(from.p, to.p);
  copy(from.z_f, to.z_f);
  copy(from.rho, to.rho);
  copy(from.gamma, to.gamma);
  copy(from.Z, to.Z);
  to.z_p = from.z_p;
  copy(from.is_fixed, to.fixed);
  to.p_e = from.p_e;
  copy(from.modal, to.modal);
  copy(from.health, to.health);
  to.compute_s = from.compute_s;
  to.wait_s = from.wait_s;
}

void copy(const amp_fsi_ProjectedInterface& from, wire::ProjectedInterface& to) {
  copy(from.run, to.run);
  copy(from.to, to.to);
  copy(from.interface_name, to.interface);
  to.step = from.step;
  to.t = from.t;
  copy(from.n, to.n);
  copy(from.v_n, to.v_n);
  copy(from.w_n, to.w_n);
  copy(from.v, to.v);
  copy(from.a, to.a);
  copy(from.q_dot, to.q_dot);
  copy(from.z_f, to.z_f);
  copy(from.robin_t, to.robin_t);
  copy(from.robin_r, to.robin_r);
  to.dt_next = from.dt_next;
  to.t_next = from.t_next;
  to.substeps_next = from.substeps_next;
  copy(from.x_next, to.x_next);
  to.write_output = from.write_output;
  to.write_checkpoint = from.write_checkpoint;
  to.stop = from.stop;
  copy(from.stop_reason, to.stop_reason);
}

void copy(const amp_fsi_Abort& from, wire::Abort& to) {
  copy(from.run, to.run);
  copy(from.from, to.from);
  to.exit_code = from.exit_code;
  copy(from.reason, to.reason);
}

void copy(const amp_fsi_Control& from, wire::Control& to) {
  copy(from.run, to.run);
  copy(from.command, to.command);
}

void copy(const amp_fsi_Waiting& from, wire::Waiting& to) {
  copy(from.run, to.run);
  copy(from.from, to.from);
  copy(from.to, to.to);
  copy(from.topic, to.topic);
  to.step = from.step;
}

bool same_state(const amp_fsi_PredictedInterface& incoming, const wire::PredictedInterface& state) {
  const auto same = [](const amp_fsi_Numbers& one, const std::vector<double>& other) {
    return one._length == other.size() &&
           (other.empty() || std::memcmp(one._buffer, other.data(), other.size() * sizeof(double)) == 0);
  };
  return same(incoming.x, state.x) && same(incoming.v, state.v) && same(incoming.w, state.w) &&
         same(incoming.p, state.p) && same(incoming.z_f, state.z_f) && same(incoming.rho, state.rho) &&
         same(incoming.gamma, state.gamma) && same(incoming.Z, state.Z);
}

std::size_t payload(const wire::PredictedInterface& m) {
  return bytes_of(m.x, m.v, m.w, m.p, m.z_f, m.rho, m.gamma, m.Z, m.fixed, m.modal.S.row, m.modal.S.column,
                  m.modal.S.value, m.modal.N.row, m.modal.N.column, m.modal.N.value, m.modal.g,
                  m.modal.q_dot);
}

std::size_t payload(const wire::ProjectedInterface& m) {
  return bytes_of(m.n, m.v_n, m.w_n, m.v, m.a, m.q_dot, m.z_f, m.robin_t, m.robin_r, m.x_next);
}

}  // namespace fsi::bus
