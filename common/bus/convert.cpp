#include "common/bus/convert.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include "common/bus/convert_parts.hpp"

namespace fsi::bus {

namespace {

using bus::borrow, bus::copy;

amp_fsi_Flags borrow(const std::vector<std::uint8_t>& values) {
  return borrowed<amp_fsi_Flags>(values);
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

void copy(const amp_fsi_ModalResponse& from, wire::ModalResponse& to) {
  to.modes = from.modes;
  copy(from.S, to.S);
  copy(from.g, to.g);
  copy(from.N, to.N);
  copy(from.q_dot, to.q_dot);
}

amp_fsi_Place borrow(const Place& place) {
  return {.step = place.step ? static_cast<std::int64_t>(*place.step) : -1,
          .t = place.t.value_or(std::numeric_limits<double>::quiet_NaN()),
          .program = borrow(place.program),
          .interface_name = borrow(place.interface),
          .grid = borrow(place.grid),
          .point = borrow(place.point),
          .position = borrow(place.position),
          .of_reference = place.of_reference};
}

void copy(const amp_fsi_Place& from, Place& to) {
  to.step = from.step < 0 ? std::nullopt : std::optional(static_cast<std::uint64_t>(from.step));
  to.t = std::isnan(from.t) ? std::nullopt : std::optional(from.t);
  copy(from.program, to.program);
  copy(from.interface_name, to.interface);
  copy(from.grid, to.grid);
  copy(from.point, to.point);
  copy(from.position, to.position);
  to.of_reference = from.of_reference;
}

template <class... Vectors>
std::size_t bytes_of(const Vectors&... vectors) {
  return (... + (vectors.size() * sizeof(vectors[0])));
}

}  // namespace

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
          .show = projected.show,
          .stop = projected.stop,
          .stop_reason = borrow(projected.stop_reason)};
}

amp_fsi_Abort borrow(const wire::Abort& abort) {
  return {.run = borrow(abort.run),
          .from = borrow(abort.from),
          .exit_code = abort.exit_code,
          .place = borrow(abort.place),
          .what = borrow(abort.what)};
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
  to.show = from.show;
  to.stop = from.stop;
  copy(from.stop_reason, to.stop_reason);
}

void copy(const amp_fsi_Abort& from, wire::Abort& to) {
  copy(from.run, to.run);
  copy(from.from, to.from);
  to.exit_code = from.exit_code;
  copy(from.place, to.place);
  copy(from.what, to.what);
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
