/// What watchers say and hear.

#include "common/bus/convert.hpp"
#include "common/bus/convert_parts.hpp"

namespace fsi::bus {

template <>
struct Members<wire::Telemetry::Interface> {
  using Sample = amp_fsi_InterfaceTelemetry;
  using Ours = wire::Telemetry::Interface;
  static constexpr std::tuple list{MemberPair{&Sample::name, &Ours::name},
                                   MemberPair{&Sample::velocity_jump, &Ours::velocity_jump},
                                   MemberPair{&Sample::traction_jump, &Ours::traction_jump},
                                   MemberPair{&Sample::gap, &Ours::gap},
                                   MemberPair{&Sample::power, &Ours::power},
                                   MemberPair{&Sample::shear, &Ours::shear},
                                   MemberPair{&Sample::velocity_scale, &Ours::velocity_scale},
                                   MemberPair{&Sample::traction_scale, &Ours::traction_scale},
                                   MemberPair{&Sample::p_min, &Ours::p_min},
                                   MemberPair{&Sample::p_max, &Ours::p_max},
                                   MemberPair{&Sample::v_min, &Ours::v_min},
                                   MemberPair{&Sample::v_max, &Ours::v_max},
                                   MemberPair{&Sample::closed, &Ours::closed},
                                   MemberPair{&Sample::s, &Ours::s},
                                   MemberPair{&Sample::x, &Ours::x},
                                   MemberPair{&Sample::x_start, &Ours::x_start},
                                   MemberPair{&Sample::p_predicted, &Ours::p_predicted},
                                   MemberPair{&Sample::p_predicted_solid, &Ours::p_predicted_solid},
                                   MemberPair{&Sample::p_projected, &Ours::p_projected},
                                   MemberPair{&Sample::w_tangential, &Ours::w_tangential},
                                   MemberPair{&Sample::v_predicted, &Ours::v_predicted},
                                   MemberPair{&Sample::v_predicted_gas, &Ours::v_predicted_gas},
                                   MemberPair{&Sample::v_projected, &Ours::v_projected}};
};

template <>
struct Members<wire::Traffic> {
  using Sample = amp_fsi_Traffic;
  using Ours = wire::Traffic;
  static constexpr std::tuple list{MemberPair{&Sample::interface_name, &Ours::interface},
                                   MemberPair{&Sample::from, &Ours::from},
                                   MemberPair{&Sample::messages, &Ours::messages},
                                   MemberPair{&Sample::bytes, &Ours::bytes},
                                   MemberPair{&Sample::missing, &Ours::missing},
                                   MemberPair{&Sample::dropped, &Ours::dropped},
                                   MemberPair{&Sample::latency_p50_us, &Ours::latency_p50_us},
                                   MemberPair{&Sample::latency_p99_us, &Ours::latency_p99_us}};
};

template <>
struct Members<wire::StepsLimited> {
  using Sample = amp_fsi_StepsLimited;
  using Ours = wire::StepsLimited;
  static constexpr std::tuple list{MemberPair{&Sample::by, &Ours::by},
                                   MemberPair{&Sample::steps, &Ours::steps}};
};

template <>
struct Members<wire::Telemetry> {
  using Sample = amp_fsi_Telemetry;
  using Ours = wire::Telemetry;
  static constexpr std::tuple list{MemberPair{&Sample::run, &Ours::run},
                                   MemberPair{&Sample::from, &Ours::from},
                                   MemberPair{&Sample::role, &Ours::role},
                                   MemberPair{&Sample::state, &Ours::state},
                                   MemberPair{&Sample::host, &Ours::host},
                                   MemberPair{&Sample::pid, &Ours::pid},
                                   MemberPair{&Sample::step, &Ours::step},
                                   MemberPair{&Sample::t, &Ours::t},
                                   MemberPair{&Sample::t_end, &Ours::t_end},
                                   MemberPair{&Sample::dt, &Ours::dt},
                                   MemberPair{&Sample::dt_reason, &Ours::dt_reason},
                                   MemberPair{&Sample::proposed_dt, &Ours::proposed_dt},
                                   MemberPair{&Sample::limited_by, &Ours::limited_by},
                                   MemberPair{&Sample::compute_s, &Ours::compute_s},
                                   MemberPair{&Sample::wait_s, &Ours::wait_s},
                                   MemberPair{&Sample::point_updates_per_s, &Ours::point_updates_per_s},
                                   MemberPair{&Sample::health, &Ours::health},
                                   MemberPair{&Sample::noise, &Ours::noise},
                                   MemberPair{&Sample::messages, &Ours::messages},
                                   MemberPair{&Sample::bytes, &Ours::bytes},
                                   MemberPair{&Sample::round_trip_p50_us, &Ours::round_trip_p50_us},
                                   MemberPair{&Sample::round_trip_p99_us, &Ours::round_trip_p99_us}};
};

template <>
struct Members<wire::Picture::Grid> {
  using Sample = amp_fsi_PictureGrid;
  using Ours = wire::Picture::Grid;
  static constexpr std::tuple list{
      MemberPair{&Sample::name, &Ours::name}, MemberPair{&Sample::n1, &Ours::n1},
      MemberPair{&Sample::n2, &Ours::n2},     MemberPair{&Sample::straight, &Ours::straight},
      MemberPair{&Sample::x, &Ours::x},       MemberPair{&Sample::level, &Ours::level}};
};

template <>
struct Members<wire::Picture> {
  using Sample = amp_fsi_Picture;
  using Ours = wire::Picture;
  static constexpr std::tuple list{
      MemberPair{&Sample::run, &Ours::run},           MemberPair{&Sample::from, &Ours::from},
      MemberPair{&Sample::quantity, &Ours::quantity}, MemberPair{&Sample::role, &Ours::role},
      MemberPair{&Sample::step, &Ours::step},         MemberPair{&Sample::t, &Ours::t},
      MemberPair{&Sample::low, &Ours::low},           MemberPair{&Sample::high, &Ours::high}};
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
