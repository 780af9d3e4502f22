#include "common/bus/convert.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include "common/bus/convert_parts.hpp"

namespace fsi::bus {

template <>
struct Members<wire::SparseMatrix> {
  using Sample = amp_fsi_SparseMatrix;
  using Ours = wire::SparseMatrix;
  static constexpr std::tuple list{MemberPair{&Sample::row, &Ours::row},
                                   MemberPair{&Sample::column, &Ours::column},
                                   MemberPair{&Sample::value, &Ours::value}};
};

template <>
struct Members<wire::ModalResponse> {
  using Sample = amp_fsi_ModalResponse;
  using Ours = wire::ModalResponse;
  static constexpr std::tuple list{MemberPair{&Sample::modes, &Ours::modes}, MemberPair{&Sample::S, &Ours::S},
                                   MemberPair{&Sample::g, &Ours::g}, MemberPair{&Sample::N, &Ours::N},
                                   MemberPair{&Sample::q_dot, &Ours::q_dot}};
};

template <>
struct Members<wire::PredictedInterface> {
  using Sample = amp_fsi_PredictedInterface;
  using Ours = wire::PredictedInterface;
  static constexpr std::tuple list{MemberPair{&Sample::run, &Ours::run},
                                   MemberPair{&Sample::from, &Ours::from},
                                   MemberPair{&Sample::interface_name, &Ours::interface},
                                   MemberPair{&Sample::step, &Ours::step},
                                   MemberPair{&Sample::t, &Ours::t},
                                   MemberPair{&Sample::proposed_dt, &Ours::proposed_dt},
                                   MemberPair{&Sample::dt_reason, &Ours::dt_reason},
                                   MemberPair{&Sample::x, &Ours::x},
                                   MemberPair{&Sample::v, &Ours::v},
                                   MemberPair{&Sample::a, &Ours::a},
                                   MemberPair{&Sample::w, &Ours::w},
                                   MemberPair{&Sample::p, &Ours::p},
                                   MemberPair{&Sample::z_f, &Ours::z_f},
                                   MemberPair{&Sample::rho, &Ours::rho},
                                   MemberPair{&Sample::gamma, &Ours::gamma},
                                   MemberPair{&Sample::Z, &Ours::Z},
                                   MemberPair{&Sample::z_p, &Ours::z_p},
                                   MemberPair{&Sample::is_fixed, &Ours::fixed},
                                   MemberPair{&Sample::p_e, &Ours::p_e},
                                   MemberPair{&Sample::modal, &Ours::modal},
                                   MemberPair{&Sample::health, &Ours::health},
                                   MemberPair{&Sample::compute_s, &Ours::compute_s},
                                   MemberPair{&Sample::wait_s, &Ours::wait_s}};
};

template <>
struct Members<wire::ProjectedInterface> {
  using Sample = amp_fsi_ProjectedInterface;
  using Ours = wire::ProjectedInterface;
  static constexpr std::tuple list{MemberPair{&Sample::run, &Ours::run},
                                   MemberPair{&Sample::to, &Ours::to},
                                   MemberPair{&Sample::interface_name, &Ours::interface},
                                   MemberPair{&Sample::step, &Ours::step},
                                   MemberPair{&Sample::t, &Ours::t},
                                   MemberPair{&Sample::n, &Ours::n},
                                   MemberPair{&Sample::v_n, &Ours::v_n},
                                   MemberPair{&Sample::w_n, &Ours::w_n},
                                   MemberPair{&Sample::v, &Ours::v},
                                   MemberPair{&Sample::a, &Ours::a},
                                   MemberPair{&Sample::q_dot, &Ours::q_dot},
                                   MemberPair{&Sample::z_f, &Ours::z_f},
                                   MemberPair{&Sample::robin_t, &Ours::robin_t},
                                   MemberPair{&Sample::robin_r, &Ours::robin_r},
                                   MemberPair{&Sample::dt_next, &Ours::dt_next},
                                   MemberPair{&Sample::t_next, &Ours::t_next},
                                   MemberPair{&Sample::substeps_next, &Ours::substeps_next},
                                   MemberPair{&Sample::x_next, &Ours::x_next},
                                   MemberPair{&Sample::write_output, &Ours::write_output},
                                   MemberPair{&Sample::write_checkpoint, &Ours::write_checkpoint},
                                   MemberPair{&Sample::show, &Ours::show},
                                   MemberPair{&Sample::stop, &Ours::stop},
                                   MemberPair{&Sample::stop_reason, &Ours::stop_reason}};
};

template <>
struct Members<wire::InterfaceInfo> {
  using Sample = amp_fsi_InterfaceInfo;
  using Ours = wire::InterfaceInfo;
  static constexpr std::tuple list{MemberPair{&Sample::name, &Ours::name},
                                   MemberPair{&Sample::dimension, &Ours::dimension},
                                   MemberPair{&Sample::x, &Ours::x}, MemberPair{&Sample::n, &Ours::n}};
};

template <>
struct Members<wire::Hello> {
  using Sample = amp_fsi_Hello;
  using Ours = wire::Hello;
  static constexpr std::tuple list{MemberPair{&Sample::protocol, &Ours::protocol},
                                   MemberPair{&Sample::run, &Ours::run},
                                   MemberPair{&Sample::role, &Ours::role},
                                   MemberPair{&Sample::name, &Ours::name},
                                   MemberPair{&Sample::law, &Ours::law},
                                   MemberPair{&Sample::config_digest, &Ours::config_digest},
                                   MemberPair{&Sample::host, &Ours::host},
                                   MemberPair{&Sample::pid, &Ours::pid},
                                   MemberPair{&Sample::points, &Ours::points},
                                   MemberPair{&Sample::build, &Ours::build}};
};

/// But for step and t, which it may lack.
template <>
struct Members<Place> {
  using Sample = amp_fsi_Place;
  using Ours = Place;
  static constexpr std::tuple list{
      MemberPair{&Sample::program, &Ours::program},   MemberPair{&Sample::interface_name, &Ours::interface},
      MemberPair{&Sample::grid, &Ours::grid},         MemberPair{&Sample::point, &Ours::point},
      MemberPair{&Sample::position, &Ours::position}, MemberPair{&Sample::of_reference, &Ours::of_reference}};
};

template <>
struct Members<wire::Abort> {
  using Sample = amp_fsi_Abort;
  using Ours = wire::Abort;
  static constexpr std::tuple list{
      MemberPair{&Sample::run, &Ours::run}, MemberPair{&Sample::from, &Ours::from},
      MemberPair{&Sample::exit_code, &Ours::exit_code}, MemberPair{&Sample::what, &Ours::what}};
};

template <>
struct Members<wire::Control> {
  using Sample = amp_fsi_Control;
  using Ours = wire::Control;
  static constexpr std::tuple list{MemberPair{&Sample::run, &Ours::run},
                                   MemberPair{&Sample::command, &Ours::command}};
};

template <>
struct Members<wire::Waiting> {
  using Sample = amp_fsi_Waiting;
  using Ours = wire::Waiting;
  static constexpr std::tuple list{MemberPair{&Sample::run, &Ours::run},
                                   MemberPair{&Sample::from, &Ours::from}, MemberPair{&Sample::to, &Ours::to},
                                   MemberPair{&Sample::topic, &Ours::topic},
                                   MemberPair{&Sample::step, &Ours::step}};
};

namespace {

template <class... Vectors>
std::size_t bytes_of(const Vectors&... vectors) {
  return (... + (vectors.size() * sizeof(vectors[0])));
}

}  // namespace

bool same(const char* incoming, const std::string& text) {
  return incoming != nullptr && text == incoming;
}

Borrowed<amp_fsi_Hello, amp_fsi_InterfaceInfo> borrow(const wire::Hello& hello) {
  Borrowed<amp_fsi_Hello, amp_fsi_InterfaceInfo> result{.sample = lent(hello),
                                                        .parts = lent(hello.interfaces)};
  result.sample.interfaces = borrowed<dds_sequence_amp_fsi_InterfaceInfo>(result.parts);
  return result;
}

amp_fsi_PredictedInterface borrow(const wire::PredictedInterface& predicted) {
  return lent(predicted);
}

amp_fsi_ProjectedInterface borrow(const wire::ProjectedInterface& projected) {
  return lent(projected);
}

amp_fsi_Abort borrow(const wire::Abort& abort) {
  amp_fsi_Abort sample = lent(abort);
  sample.place = lent(abort.place);
  sample.place.step = abort.place.step ? static_cast<std::int64_t>(*abort.place.step) : -1;
  sample.place.t = abort.place.t.value_or(std::numeric_limits<double>::quiet_NaN());
  return sample;
}

amp_fsi_Control borrow(const wire::Control& control) {
  return lent(control);
}

amp_fsi_Waiting borrow(const wire::Waiting& waiting) {
  return lent(waiting);
}

void copy(const amp_fsi_Hello& from, wire::Hello& to) {
  take(from, to);
  take(from.interfaces, to.interfaces);
}

void copy(const amp_fsi_PredictedInterface& from, wire::PredictedInterface& to) {
  take(from, to);
}

void copy(const amp_fsi_ProjectedInterface& from, wire::ProjectedInterface& to) {
  take(from, to);
}

void copy(const amp_fsi_Abort& from, wire::Abort& to) {
  take(from, to);
  take(from.place, to.place);
  const amp_fsi_Place& place = from.place;
  to.place.step = place.step < 0 ? std::nullopt : std::optional(static_cast<std::uint64_t>(place.step));
  to.place.t = std::isnan(place.t) ? std::nullopt : std::optional(place.t);
}

void copy(const amp_fsi_Control& from, wire::Control& to) {
  take(from, to);
}

void copy(const amp_fsi_Waiting& from, wire::Waiting& to) {
  take(from, to);
}

bool same_state(const amp_fsi_PredictedInterface& incoming, const wire::PredictedInterface& state) {
  const auto same = [](const amp_fsi_Numbers& one, const std::vector<double>& other) {
    return one._length == other.size() &&
           (other.empty() || std::memcmp(one._buffer, other.data(), other.size() * sizeof(double)) == 0);
  };
  return same(incoming.x, state.x) && same(incoming.v, state.v) && same(incoming.a, state.a) &&
         same(incoming.w, state.w) && same(incoming.p, state.p) && same(incoming.z_f, state.z_f) &&
         same(incoming.rho, state.rho) && same(incoming.gamma, state.gamma) && same(incoming.Z, state.Z);
}

std::size_t payload(const wire::PredictedInterface& m) {
  return bytes_of(m.x, m.v, m.a, m.w, m.p, m.z_f, m.rho, m.gamma, m.Z, m.fixed, m.modal.S.row,
                  m.modal.S.column, m.modal.S.value, m.modal.N.row, m.modal.N.column, m.modal.N.value,
                  m.modal.g, m.modal.q_dot);
}

std::size_t payload(const wire::ProjectedInterface& m) {
  return bytes_of(m.n, m.v_n, m.w_n, m.v, m.a, m.q_dot, m.z_f, m.robin_t, m.robin_r, m.x_next);
}

}  // namespace fsi::bus
