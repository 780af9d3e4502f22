#include "solid_solver/beam/port.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "common/core/failure.hpp"
#include "common/interface/point_lengths.hpp"
#include "common/io/write_each.hpp"
#include "common/wire/sparse.hpp"

namespace fsi::beam {

namespace {

constexpr std::array<const char*, 12> quantities{"u1",  "u2",  "v1",    "v2", "P11", "P12",
                                                 "P21", "P22", "theta", "N",  "Q",   "M"};

/// The inner line of the fields lies beside the centre line, so much of the way to the outline: what is on
/// its two sides then does not share a line with other points.
constexpr double beside = 0.01;

double thickness(const Section& section) {
  return std::sqrt(12 * section.EI / section.EA);
}

/// At a place on the line, as the stress resultants; its logarithm is linear, so that it stays positive.
double thickness_at(const BeamModel& model, double s) {
  const auto [before, after, part] = model.middles_around(s);
  const double first = thickness(model.section(before));
  return first * std::pow(thickness(model.section(after)) / first, part);
}

}  // namespace

BeamParticipant::BeamParticipant(const Setup& setup, const SolidSpec& spec)
    : BodyParticipant(setup, spec, quantities),
      from_case_(beam_from_case(spec)),
      motion_(from_case_.motion),
      skins_(from_case_.skins),
      energies_(setup.run_dir + "/energies_" + spec.name + ".csv",
                {"t [time]", "kinetic [energy/depth]", "strain [energy/depth]", "work [energy/depth]"},
                setup.opening()) {
  if (!from_case_.meets_gas && !setup.problem.time.dt) {
    throw UserMistake(fmt::format(
        "solid \"{}\" is a beam without a gas: its implicit scheme has no largest step; write `time.dt`",
        spec.name));
  }
  for (const Vec2& place : probe_places_) probes_.push_back(attach(motion_.model().line(), place));
  Shape shape{.outlines = {},
              .points = static_cast<std::size_t>(motion_.model().nodes()),
              .meets_gas = from_case_.meets_gas};
  for (const Skin& skin : skins_) shape.outlines.push_back(skin.outline());
  const auto beside_the_line = [&](std::size_t l, std::size_t i) -> Vec2 {
    const std::vector<double>& x = skins_[l].outline().x;
    return Vec2(x[i], x[skins_[l].points() + i]) - (1 - beside) * skins_[l].place(i).r;
  };
  begin(std::move(shape), "beam", beside_the_line, false);
}

ProposedTimeStep BeamParticipant::compute_time_step() const {
  return {.dt = std::numeric_limits<double>::infinity(), .reason = "a beam is integrated implicitly"};
}

void BeamParticipant::fill(std::size_t k, wire::PredictedInterface& predicted) const {
  const Skin& skin = skins_[k];
  SkinState state = skin.state(motion_);
  wire::ModalResponse& modal = predicted.modal;
  modal.modes = static_cast<std::int32_t>(motion_.modes());
  wire::put_entries(skin.mode_vectors(state, skin.normals(state.x)), modal.N);
  modal.q_dot = bodies::numbers(motion_.q_dot());
  modal.g.assign(static_cast<std::size_t>(motion_.modes()), 0);
  predicted.x = std::move(state.x);
  predicted.v = std::move(state.v);
  predicted.fixed = skin.freedom();
  if (dt_ == 0) return;
  const Response response = motion_.lower_response();
  wire::put_entries(response.S, modal.S);
  modal.g = bodies::numbers(response.g);
}

void BeamParticipant::apply_bcs(double /*t*/, ProjectedStates projected) {
  if (projected.empty()) return;  // the prediction is the motion
  if (dt_ > 0)
    motion_.correct(Eigen::Map<const Eigen::VectorXd>(projected.front()->q_dot.data(), motion_.modes()));
  std::vector<NormalSide> gas;
  std::vector<double> lengths;
  std::vector<Eigen::SparseMatrix<double>> modes;
  std::vector<bodies::GasLoad> loads;
  for (std::size_t k = 0; k < projected.size(); ++k) {
    const wire::ProjectedInterface& answer = *projected[k];
    const SkinState state = skins_[k].state(motion_);
    std::vector<double> ds(skins_[k].points());
    point_lengths(state.x, answer.n, ds);
    for (std::size_t i = 0; i < skins_[k].points(); ++i)
      gas.push_back({.z = answer.z_f[i], .v_n = answer.v_n[i], .w_n = answer.w_n[i]});
    lengths.insert(lengths.end(), ds.begin(), ds.end());
    modes.push_back(skins_[k].mode_vectors(state, answer.n));
    loads.push_back(bodies::load_of_gas(state.x, answer.n, answer.w_n, answer.v_n));
  }
  added_mass_.take(modes.size() == 1 ? modes.front() : side_by_side(modes));
  gas_ = &added_mass_.load(gas, lengths);
  take(loads);
}

/// Any number of substeps is one.
void BeamParticipant::advance(double t, double dt, int /*substeps*/, ProjectedStates /*projected*/) {
  dt_ = dt;
  motion_.advance(dt, own_load(t + dt), gas_);
}

void BeamParticipant::values_at(const Attached& point, const Vec2& x_bar, std::span<double> values) const {
  const BeamModel& model = motion_.model();
  const Resultants force = model.resultants_at(motion_.u(), point.s);
  const PointState at = state_of(motion_, point);
  const double angle = model.angle_at(point.s), y = Vec2(-std::sin(angle), std::cos(angle)).dot(point.r);
  const Mat2 P = plate_stress(thickness_at(model, point.s), force, y, angle, at.theta);
  const Vec2 u = at.x - x_bar;
  std::ranges::copy(
      std::array<double, quantities.size()>{u[0], u[1], at.v[0], at.v[1], P(0, 0), P(0, 1), P(1, 0), P(1, 1),
                                            at.theta, force.N, force.Q, force.M},
      values.begin());
}

void BeamParticipant::values_at(const bodies::DrawnPoint& point, std::span<double> values) const {
  Attached place = skins_[point.outline].place(point.i);
  if (point.inside) place.r *= beside;
  values_at(place, point.x_bar, values);
}

void BeamParticipant::archive_motion(Archive& archive) {
  archive.inside("motion", [&] { motion_.archive(archive); });
  archive.inside("energies", [&] { energies_.archive(archive); });
}

/// That of its mass, or of its volume where it has none.
bodies::BodyMotion BeamParticipant::mean_motion() const {
  const BeamModel& model = motion_.model();
  double weight = 0, angle = 0;
  Vec2 centre = Vec2::Zero(), carried = Vec2::Zero();
  for (int node = 0; node < model.nodes(); ++node) {
    const double part = node_weight(node);
    weight += part;
    centre +=
        part * (model.line().x[static_cast<std::size_t>(node)] + motion_.u().segment<2>(freedom_of(node)));
    carried += part * motion_.u_dot().segment<2>(freedom_of(node));
    angle += part * motion_.u()[3 * node + 2];
  }
  centre /= weight;
  const Vec2 v = (spec_.rho > 0 ? motion_.momentum() : carried) / weight;
  return {.centre = centre, .velocity = v, .angle = angle / weight};
}

void BeamParticipant::write_tables(double t, double /*dt*/, ProjectedStates /*projected*/) {
  std::vector<double> probes(quantities.size() * probes_.size());
  for (std::size_t k = 0; k < probes_.size(); ++k)
    values_at(probes_[k], probe_places_[k],
              std::span(probes).subspan(k * quantities.size(), quantities.size()));
  io::write_each([&] { write_rows(t, mean_motion(), probes); },
                 [&] {
                   energies_.row({t, motion_.kinetic_energy(), motion_.model().strain_energy(motion_.u()),
                                  impulse_.sum().power});
                 });
}

void BeamParticipant::flush_tables() {
  io::write_each([&] { BodyParticipant::flush_tables(); }, [&] { energies_.flush(); });
}

bool BeamParticipant::is_surrounded() const {
  const bool free = std::ranges::all_of(spec_.beam->ends, [](BeamEnd end) { return end == BeamEnd::free; });
  return free && !spec_.body_force && !spec_.body_fitted.empty() && spec_.body_fitted.front().curve.closed();
}

bodies::BodyTotals BeamParticipant::totals() const {
  return {.momentum = motion_.momentum(),
          .angular_momentum = motion_.angular_momentum(),
          .energy = motion_.kinetic_energy() + motion_.model().strain_energy(motion_.u())};
}

/// The mass of a node, or its volume where the beam has no mass.
double BeamParticipant::node_weight(int node) const {
  const BeamModel& model = motion_.model();
  if (spec_.rho > 0) return model.mass()[freedom_of(node)];
  const auto half = [&](int element) {
    return 0.5 * model.length(element) * thickness(model.section(element));
  };
  const double before = node > 0 ? half(node - 1) : 0, after = node < model.elements() ? half(node) : 0;
  return before + after;
}

/// The body force at the nodes, on the thickness of the elements beside them.
Eigen::VectorXd BeamParticipant::own_load(double t) const {
  const BeamModel& model = motion_.model();
  Eigen::VectorXd load = Eigen::VectorXd::Zero(model.freedoms());
  if (!spec_.body_force) return load;
  for (int node = 0; node < model.nodes(); ++node) {
    const Vec2& x = model.line().x[static_cast<std::size_t>(node)];
    const Vec2 force(spec_.body_force->c1(x[0], x[1], t), spec_.body_force->c2(x[0], x[1], t));
    const double volume = spec_.rho > 0 ? node_weight(node) / spec_.rho : node_weight(node);
    load.segment<2>(freedom_of(node)) = volume * force;
  }
  return load;
}

}  // namespace fsi::beam
