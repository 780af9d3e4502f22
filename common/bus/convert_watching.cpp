/// What watchers say and hear.

#include "common/bus/convert.hpp"
#include "common/bus/convert_parts.hpp"

namespace fsi::bus {

template <>
struct Members<wire::Telemetry::Interface> {
  using Sample = amp_fsi_InterfaceTelemetry;
  using Ours = wire::Telemetry::Interface;
  static constexpr std::tuple list{Member{&Sample::name, &Ours::name},
                                   Member{&Sample::velocity_jump, &Ours::velocity_jump},
                                   Member{&Sample::traction_jump, &Ours::traction_jump},
                                   Member{&Sample::gap, &Ours::gap},
                                   Member{&Sample::power, &Ours::power},
                                   Member{&Sample::shear, &Ours::shear},
                                   Member{&Sample::velocity_scale, &Ours::velocity_scale},
                                   Member{&Sample::traction_scale, &Ours::traction_scale},
                                   Member{&Sample::p_min, &Ours::p_min},
                                   Member{&Sample::p_max, &Ours::p_max},
                                   Member{&Sample::v_min, &Ours::v_min},
                                   Member{&Sample::v_max, &Ours::v_max},
                                   Member{&Sample::closed, &Ours::closed},
                                   Member{&Sample::s, &Ours::s},
                                   Member{&Sample::x, &Ours::x},
                                   Member{&Sample::x_start, &Ours::x_start},
                                   Member{&Sample::p_predicted, &Ours::p_predicted},
                                   Member{&Sample::p_predicted_solid, &Ours::p_predicted_solid},
                                   Member{&Sample::p_projected, &Ours::p_projected},
                                   Member{&Sample::w_tangential, &Ours::w_tangential},
                                   Member{&Sample::v_predicted, &Ours::v_predicted},
                                   Member{&Sample::v_predicted_gas, &Ours::v_predicted_gas},
                                   Member{&Sample::v_projected, &Ours::v_projected}};
};

template <>
struct Members<wire::Traffic> {
  using Sample = amp_fsi_Traffic;
  using Ours = wire::Traffic;
  static constexpr std::tuple list{Member{&Sample::interface_name, &Ours::interface},
                                   Member{&Sample::from, &Ours::from},
                                   Member{&Sample::messages, &Ours::messages},
                                   Member{&Sample::bytes, &Ours::bytes},
                                   Member{&Sample::missing, &Ours::missing},
                                   Member{&Sample::dropped, &Ours::dropped},
                                   Member{&Sample::latency_p50_us, &Ours::latency_p50_us},
                                   Member{&Sample::latency_p99_us, &Ours::latency_p99_us}};
};

template <>
struct Members<wire::StepsLimited> {
  using Sample = amp_fsi_StepsLimited;
  using Ours = wire::StepsLimited;
  static constexpr std::tuple list{Member{&Sample::by, &Ours::by}, Member{&Sample::steps, &Ours::steps}};
};

template <>
struct Members<wire::Telemetry> {
  using Sample = amp_fsi_Telemetry;
  using Ours = wire::Telemetry;
  static constexpr std::tuple list{Member{&Sample::run, &Ours::run},
                                   Member{&Sample::from, &Ours::from},
                                   Member{&Sample::role, &Ours::role},
                                   Member{&Sample::state, &Ours::state},
                                   Member{&Sample::host, &Ours::host},
                                   Member{&Sample::pid, &Ours::pid},
                                   Member{&Sample::step, &Ours::step},
                                   Member{&Sample::t, &Ours::t},
                                   Member{&Sample::t_end, &Ours::t_end},
                                   Member{&Sample::dt, &Ours::dt},
                                   Member{&Sample::dt_reason, &Ours::dt_reason},
                                   Member{&Sample::proposed_dt, &Ours::proposed_dt},
                                   Member{&Sample::limited_by, &Ours::limited_by},
                                   Member{&Sample::compute_s, &Ours::compute_s},
                                   Member{&Sample::wait_s, &Ours::wait_s},
                                   Member{&Sample::point_updates_per_s, &Ours::point_updates_per_s},
                                   Member{&Sample::health, &Ours::health},
                                   Member{&Sample::noise, &Ours::noise},
                                   Member{&Sample::messages, &Ours::messages},
                                   Member{&Sample::bytes, &Ours::bytes},
                                   Member{&Sample::round_trip_p50_us, &Ours::round_trip_p50_us},
                                   Member{&Sample::round_trip_p99_us, &Ours::round_trip_p99_us}};
};

template <>
struct Members<wire::Picture::Grid> {
  using Sample = amp_fsi_PictureGrid;
  using Ours = wire::Picture::Grid;
  static constexpr std::tuple list{
      Member{&Sample::name, &Ours::name}, Member{&Sample::n1, &Ours::n1},
      Member{&Sample::n2, &Ours::n2},     Member{&Sample::straight, &Ours::straight},
      Member{&Sample::x, &Ours::x},       Member{&Sample::level, &Ours::level}};
};

template <>
struct Members<wire::Picture> {
  using Sample = amp_fsi_Picture;
  using Ours = wire::Picture;
  static constexpr std::tuple list{
      Member{&Sample::run, &Ours::run},           Member{&Sample::from, &Ours::from},
      Member{&Sample::quantity, &Ours::quantity}, Member{&Sample::role, &Ours::role},
      Member{&Sample::step, &Ours::step},         Member{&Sample::t, &Ours::t},
      Member{&Sample::low, &Ours::low},           Member{&Sample::high, &Ours::high}};
};

BorrowedTelemetry borrow(const wire::Telemetry& telemetry) {
  BorrowedTelemetry result;
  result.sample = lent(telemetry);
  result.parts = lent(telemetry.interfaces);
  result.traffic = lent(telemetry.traffic);
  result.limits = lent(telemetry.limits);
  result.sample.interfaces = borrowed<dds_sequence_amp_fsi_InterfaceTelemetry>(result.parts);
  result.sample.traffic = borrowed<dds_sequence_amp_fsi_Traffic>(result.traffic);
  result.sample.limits = borrowed<dds_sequence_amp_fsi_StepsLimited>(result.limits);
  return result;
}

void copy(const amp_fsi_Telemetry& from, wire::Telemetry& to) {
  take(from, to);
  take(from.interfaces, to.interfaces);
  take(from.traffic, to.traffic);
  take(from.limits, to.limits);
}

Borrowed<amp_fsi_Watch, char*> borrow(const wire::Watch& watch) {
  Borrowed<amp_fsi_Watch, char*> result;
  for (const std::string& wish : watch.wishes) result.parts.push_back(borrow(wish));
  result.sample = {.run = borrow(watch.run), .wishes = borrowed<amp_fsi_Words>(result.parts)};
  return result;
}

void copy(const amp_fsi_Watch& from, wire::Watch& to) {
  take(from.run, to.run);
  take(from.wishes, to.wishes);
}

Borrowed<amp_fsi_Picture, amp_fsi_PictureGrid> borrow(const wire::Picture& picture) {
  Borrowed<amp_fsi_Picture, amp_fsi_PictureGrid> result{.sample = lent(picture),
                                                        .parts = lent(picture.grids)};
  result.sample.grids = borrowed<dds_sequence_amp_fsi_PictureGrid>(result.parts);
  return result;
}

void copy(const amp_fsi_Picture& from, wire::Picture& to) {
  take(from, to);
  take(from.grids, to.grids);
}

}  // namespace fsi::bus
