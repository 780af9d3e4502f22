/// What watchers say and hear.

#include <cstdint>

#include "common/bus/convert.hpp"
#include "common/bus/convert_parts.hpp"

namespace fsi::bus {

namespace {

using bus::copy;

void copy(const amp_fsi_InterfaceTelemetry& in, wire::Telemetry::Interface& out) {
  copy(in.name, out.name);
  out.velocity_jump = in.velocity_jump;
  out.traction_jump = in.traction_jump;
  out.gap = in.gap;
  out.power = in.power;
  out.shear = in.shear;
  out.velocity_scale = in.velocity_scale;
  out.traction_scale = in.traction_scale;
  out.p_min = in.p_min;
  out.p_max = in.p_max;
  out.v_min = in.v_min;
  out.v_max = in.v_max;
  out.closed = in.closed;
  copy(in.s, out.s);
  copy(in.x, out.x);
  copy(in.x_start, out.x_start);
  copy(in.p_predicted, out.p_predicted);
  copy(in.p_predicted_solid, out.p_predicted_solid);
  copy(in.p_projected, out.p_projected);
  copy(in.w_tangential, out.w_tangential);
  copy(in.v_predicted, out.v_predicted);
  copy(in.v_predicted_gas, out.v_predicted_gas);
  copy(in.v_projected, out.v_projected);
}

void copy(const amp_fsi_Traffic& in, wire::Traffic& out) {
  copy(in.interface_name, out.interface);
  copy(in.from, out.from);
  out.messages = in.messages;
  out.bytes = in.bytes;
  out.missing = in.missing;
  out.dropped = in.dropped;
  out.latency_p50_us = in.latency_p50_us;
  out.latency_p99_us = in.latency_p99_us;
}

/// The elements of a sequence of plain numbers.
template <class Sequence, class Element>
void copy_elements(const Sequence& from, std::vector<Element>& to) {
  to.assign(from._buffer, from._buffer + from._length);
}

}  // namespace

BorrowedTelemetry borrow(const wire::Telemetry& telemetry) {
  BorrowedTelemetry result;
  for (const wire::Telemetry::Interface& side : telemetry.interfaces) {
    result.parts.push_back({.name = borrow(side.name),
                            .velocity_jump = side.velocity_jump,
                            .traction_jump = side.traction_jump,
                            .gap = side.gap,
                            .power = side.power,
                            .shear = side.shear,
                            .velocity_scale = side.velocity_scale,
                            .traction_scale = side.traction_scale,
                            .p_min = side.p_min,
                            .p_max = side.p_max,
                            .v_min = side.v_min,
                            .v_max = side.v_max,
                            .closed = side.closed,
                            .s = borrow(side.s),
                            .x = borrow(side.x),
                            .x_start = borrow(side.x_start),
                            .p_predicted = borrow(side.p_predicted),
                            .p_predicted_solid = borrow(side.p_predicted_solid),
                            .p_projected = borrow(side.p_projected),
                            .w_tangential = borrow(side.w_tangential),
                            .v_predicted = borrow(side.v_predicted),
                            .v_predicted_gas = borrow(side.v_predicted_gas),
                            .v_projected = borrow(side.v_projected)});
  }
  for (const wire::StepsLimited& limit : telemetry.limits)
    result.limits.push_back({.by = borrow(limit.by), .steps = limit.steps});
  for (const wire::Traffic& heard : telemetry.traffic) {
    result.traffic.push_back({.interface_name = borrow(heard.interface),
                              .from = borrow(heard.from),
                              .messages = heard.messages,
                              .bytes = heard.bytes,
                              .missing = heard.missing,
                              .dropped = heard.dropped,
                              .latency_p50_us = heard.latency_p50_us,
                              .latency_p99_us = heard.latency_p99_us});
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
                   .dt_bid = telemetry.dt_bid,
                   .limited_by = borrow(telemetry.limited_by),
                   .limits = borrowed<dds_sequence_amp_fsi_StepsLimited>(result.limits),
                   .compute_s = telemetry.compute_s,
                   .wait_s = telemetry.wait_s,
                   .point_updates_per_s = telemetry.point_updates_per_s,
                   .health = borrow(telemetry.health),
                   .noise = borrow(telemetry.noise),
                   .messages = telemetry.messages,
                   .bytes = telemetry.bytes,
                   .round_trip_p50_us = telemetry.round_trip_p50_us,
                   .round_trip_p99_us = telemetry.round_trip_p99_us,
                   .interfaces = borrowed<dds_sequence_amp_fsi_InterfaceTelemetry>(result.parts),
                   .traffic = borrowed<dds_sequence_amp_fsi_Traffic>(result.traffic)};
  return result;
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
  to.dt_bid = from.dt_bid;
  copy(from.limited_by, to.limited_by);
  to.limits.resize(from.limits._length);
  for (std::uint32_t k = 0; k < from.limits._length; ++k) {
    copy(from.limits._buffer[k].by, to.limits[k].by);
    to.limits[k].steps = from.limits._buffer[k].steps;
  }
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
  for (std::uint32_t k = 0; k < from.interfaces._length; ++k)
    copy(from.interfaces._buffer[k], to.interfaces[k]);
  to.traffic.resize(from.traffic._length);
  for (std::uint32_t k = 0; k < from.traffic._length; ++k) copy(from.traffic._buffer[k], to.traffic[k]);
}

Borrowed<amp_fsi_Watch, char*> borrow(const wire::Watch& watch) {
  Borrowed<amp_fsi_Watch, char*> result;
  for (const std::string& wish : watch.wishes) result.parts.push_back(borrow(wish));
  result.sample = {.run = borrow(watch.run), .wishes = borrowed<amp_fsi_Words>(result.parts)};
  return result;
}

void copy(const amp_fsi_Watch& from, wire::Watch& to) {
  copy(from.run, to.run);
  to.wishes.resize(from.wishes._length);
  for (std::uint32_t k = 0; k < from.wishes._length; ++k) copy(from.wishes._buffer[k], to.wishes[k]);
}

Borrowed<amp_fsi_Picture, amp_fsi_PictureGrid> borrow(const wire::Picture& picture) {
  Borrowed<amp_fsi_Picture, amp_fsi_PictureGrid> result;
  for (const wire::Picture::Grid& grid : picture.grids) {
    result.parts.push_back({.name = borrow(grid.name),
                            .n1 = grid.n1,
                            .n2 = grid.n2,
                            .straight = grid.straight,
                            .x = borrowed<amp_fsi_Places>(grid.x),
                            .level = borrowed<amp_fsi_Levels>(grid.level)});
  }
  result.sample = {.run = borrow(picture.run),
                   .from = borrow(picture.from),
                   .quantity = borrow(picture.quantity),
                   .role = borrow(picture.role),
                   .step = picture.step,
                   .t = picture.t,
                   .low = picture.low,
                   .high = picture.high,
                   .grids = borrowed<dds_sequence_amp_fsi_PictureGrid>(result.parts)};
  return result;
}

void copy(const amp_fsi_Picture& from, wire::Picture& to) {
  copy(from.run, to.run);
  copy(from.from, to.from);
  copy(from.quantity, to.quantity);
  copy(from.role, to.role);
  to.step = from.step;
  to.t = from.t;
  to.low = from.low;
  to.high = from.high;
  to.grids.resize(from.grids._length);
  for (std::uint32_t k = 0; k < from.grids._length; ++k) {
    const amp_fsi_PictureGrid& in = from.grids._buffer[k];
    wire::Picture::Grid& out = to.grids[k];
    copy(in.name, out.name);
    out.n1 = in.n1;
    out.n2 = in.n2;
    out.straight = in.straight;
    copy_elements(in.x, out.x);
    copy_elements(in.level, out.level);
  }
}

}  // namespace fsi::bus
