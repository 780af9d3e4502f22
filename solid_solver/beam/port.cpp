#include "solid_solver/beam/port.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "common/core/failure.hpp"
#include "common/wire/sparse.hpp"

namespace fsi::beam {

namespace {

constexpr std::array<const char*, 12> quantities{"u1",  "u2",  "v1",    "v2", "P11", "P12",
                                                 "P21", "P22", "theta", "N",  "Q",   "M"};

/// The inner line of the fields lies beside the centre line, so much of the way to the outline: what is on
/// its two sides then does not share a line with other points.
constexpr double beside = 0.01;

/// Nominal stress at the distance y from the centre line: axial force and moment make it linear across the
/// section, the shear force a parabola.
/// @param angle of the section at rest  @param theta its rotation
Mat2 nominal_stress(const Section& section, const Resultants& force, double y, double angle, double theta) {
  const double d = std::sqrt(12 * section.EI / section.EA);
  const double axial = force.N / d - 12 * force.M * y / (d * d * d);
  const double shear = 1.5 * force.Q / d * std::max(0.0, 1 - 4 * y * y / (d * d));
  const Vec2 along(std::cos(angle + theta), std::sin(angle + theta)), across(-along.y(), along.x());
  return Vec2(std::cos(angle), std::sin(angle)) * (axial * along + shear * across).transpose();
}

std::vector<double> numbers(const Eigen::VectorXd& values) {
  return {values.begin(), values.end()};
}

/// Length of the outline that belongs to each point.
std::vector<double> point_lengths(const std::vector<double>& x) {
  const std::size_t n = x.size() / 2;
  std::vector<double> ds(n);
  for (std::size_t k = 1; k < n; ++k) {
    const double half = 0.5 * std::hypot(x[k] - x[k - 1], x[n + k] - x[n + k - 1]);
    ds[k - 1] += half;
    ds[k] += half;
  }
  return ds;
}

/// Whether nothing but the gas acts on the beam.
bool is_surrounded(const SolidSpec& spec) {
  const bool free = std::ranges::all_of(spec.beam->ends, [](BeamEnd end) { return end == BeamEnd::free; });
  return free && !spec.body_force && !spec.body_fitted.empty() && spec.body_fitted.front().curve.closed();
}

}  // namespace

BeamParticipant::BeamParticipant(const Setup& setup, const SolidSpec& spec)
    : setup_(setup),
      spec_(spec),
      from_case_(beam_from_case(spec)),
      motion_(from_case_.motion),
      skins_(from_case_.skins),
      fields_(setup.run_dir, "solid_" + spec.name),
      initial_(totals()) {
  if (!from_case_.meets_gas && !setup.problem.time.dt) {
    throw UserMistake(fmt::format(
        "solid \"{}\" is a beam without a gas: its implicit scheme has no largest step; write `time.dt`",
        spec.name));
  }
  place_grids();
  open_tables();
}

wire::Hello BeamParticipant::hello() const {
  wire::Hello hello;
  hello.role = "solid";
  hello.name = spec_.name;
  hello.law = spec_.law;
  hello.config_digest = setup_.problem.digest;
  hello.points = static_cast<std::uint64_t>(motion_.model().nodes());
  if (!from_case_.meets_gas) return hello;
  const std::vector<std::string> gases = gases_at(spec_);
  for (std::size_t k = 0; k < skins_.size(); ++k) {
    const std::vector<double>& x = skins_[k].outline().x;
    hello.interfaces.push_back(
        {.name = interface_name(spec_, gases[k]), .dimension = 2, .x = x, .n = skins_[k].normals(x)});
  }
  return hello;
}

TimeStepBid BeamParticipant::compute_time_step() const {
  return {.dt = std::numeric_limits<double>::infinity(), .reason = "a beam is integrated implicitly"};
}

void BeamParticipant::fill(std::size_t k, wire::PredictedInterface& predicted) const {
  const Skin& skin = skins_[k];
  SkinState state = skin.state(motion_);
  wire::ModalResponse& modal = predicted.modal;
  modal.modes = static_cast<std::int32_t>(motion_.modes());
  wire::put_entries(skin.mode_vectors(state, skin.normals(state.x)), modal.N);
  modal.q_dot = numbers(motion_.q_dot());
  modal.g.assign(static_cast<std::size_t>(motion_.modes()), 0);
  predicted.x = std::move(state.x);
  predicted.v = std::move(state.v);
  predicted.fixed = skin.freedom();
  if (dt_ == 0) return;
  const Response response = motion_.lower_response();
  wire::put_entries(response.S, modal.S);
  modal.g = numbers(response.g);
}

void BeamParticipant::apply_bcs(double /*t*/, ProjectedStates projected) {
  if (projected.empty()) return;  // the prediction is the motion
  if (dt_ > 0)
    motion_.correct(Eigen::Map<const Eigen::VectorXd>(projected.front()->q_dot.data(), motion_.modes()));
  std::vector<NormalSide> gas;
  std::vector<double> lengths;
  std::vector<Eigen::SparseMatrix<double>> modes;
  for (std::size_t k = 0; k < projected.size(); ++k) {
    const wire::ProjectedInterface& answer = *projected[k];
    const SkinState state = skins_[k].state(motion_);
    const std::vector<double> ds = point_lengths(state.x);
    for (std::size_t i = 0; i < skins_[k].points(); ++i)
      gas.push_back({.z = answer.z_f[i], .v_n = answer.v_n[i], .w_n = answer.w_n[i]});
    lengths.insert(lengths.end(), ds.begin(), ds.end());
    modes.push_back(skins_[k].mode_vectors(state, answer.n));
    const rigid::GasLoad load = rigid::load_of_gas(state.x, answer.n, answer.w_n, answer.v_n);
    load_ = k == 0 ? load : load_ + load;
  }
  added_mass_.take(modes.size() == 1 ? modes.front() : side_by_side(modes));
  gas_ = &added_mass_.load(gas, lengths);
  impulse_.add(load_, dt_);
}

/// Any number of substeps is one.
void BeamParticipant::advance(double t, double dt, int /*substeps*/, ProjectedStates /*projected*/) {
  dt_ = dt;
  motion_.advance(dt, own_load(t + dt), gas_);
}

std::array<double, 12> BeamParticipant::values_at(const Attached& point, const Vec2& x_bar) const {
  const BeamModel& model = motion_.model();
  const int element = std::min(static_cast<int>(point.s), model.elements() - 1);
  const Resultants force = model.resultants(motion_.u(), element);
  const PointState at = state_of(motion_, point);
  const double angle = model.angle(element), y = Vec2(-std::sin(angle), std::cos(angle)).dot(point.r);
  const Mat2 P = nominal_stress(model.section(element), force, y, angle, at.theta);
  const Vec2 u = at.x - x_bar;
  return {u[0],    u[1],    at.v[0],  at.v[1], P(0, 0), P(0, 1),
          P(1, 0), P(1, 1), at.theta, force.N, force.Q, force.M};
}

std::vector<io::GridOutput> BeamParticipant::fields() {
  std::vector<io::GridOutput> grids;
  for (std::size_t l = 0; l < skins_.size(); ++l) {
    Drawn& drawn = drawn_[l];
    for (int i = 0; i < drawn.reference.layout().n1; ++i) {
      const Attached& place = skins_[l].place(static_cast<std::size_t>(i));
      Attached foot = place;
      foot.r *= beside;
      for (const auto& [j, point] : {std::pair{0, place}, std::pair{1, foot}}) {
        const auto values = values_at(point, {drawn.reference(0, i, j), drawn.reference(1, i, j)});
        for (std::size_t k = 0; k < values.size(); ++k) drawn.state(static_cast<int>(k), i, j) = values[k];
      }
    }
    std::vector<io::NamedPlane> planes;
    for (std::size_t k = 0; k < quantities.size(); ++k)
      planes.push_back({quantities[k], drawn.state.view(), static_cast<int>(k)});
    grids.push_back({.grid = drawn.grid,
                     .x = drawn.reference.view(),
                     .u = drawn.state.view(),
                     .fields = std::move(planes)});
  }
  return grids;
}

void BeamParticipant::write_fields(double t, std::uint64_t step) {
  fields_.write(t, step, fields());
}

/// The beam as it is: predicted where the others broke.
void BeamParticipant::write_last_state(double t, std::uint64_t step) {
  fields_.write_apart("last_state", t, step, fields());
}

void BeamParticipant::archive(Archive& archive) {
  archive.inside("motion", [&] { motion_.archive(archive); });
  archive.inside("load", [&] { load_.archive(archive); });
  archive.inside("impulse", [&] { impulse_.archive(archive); });
  archive.number("dt", dt_);
  archive.inside("fields", [&] { fields_.archive(archive); });
  archive.inside("forces", [&] { forces_->archive(archive); });
  archive.inside("energies", [&] { energies_->archive(archive); });
  if (probe_table_) archive.inside("probes", [&] { probe_table_->archive(archive); });
}

void BeamParticipant::write_tables(double t, double /*dt*/, ProjectedStates /*projected*/) {
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
  forces_->row(t, load_, {.centre = centre, .velocity = v, .angle = angle / weight});
  energies_->row({t, motion_.kinetic_energy(), model.strain_energy(motion_.u()), impulse_.sum().power});
  if (!probe_table_) return;
  std::vector<double> row{t};
  for (std::size_t k = 0; k < probes_.size(); ++k) {
    const auto values = values_at(probes_[k], probe_places_[k]);
    row.insert(row.end(), values.begin(), values.end());
  }
  probe_table_->row(row);
}

void BeamParticipant::report(double /*t*/, io::Part& part) const {
  part.health["min_det_F"] = 1;
  part.conservation = rigid::conservation_of(totals(), initial_, impulse_.sum(), is_surrounded(spec_));
}

rigid::BodyTotals BeamParticipant::totals() const {
  return {.momentum = motion_.momentum(),
          .angular_momentum = motion_.angular_momentum(),
          .energy = motion_.kinetic_energy() + motion_.model().strain_energy(motion_.u())};
}

/// The mass of a node, or its volume where the beam has no mass.
double BeamParticipant::node_weight(int node) const {
  const BeamModel& model = motion_.model();
  if (spec_.rho > 0) return model.mass()[freedom_of(node)];
  const auto half = [&](int element) {
    const Section& section = model.section(element);
    return 0.5 * model.length(element) * std::sqrt(12 * section.EI / section.EA);
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

void BeamParticipant::open_tables() {
  forces_.emplace(setup_, spec_.name);
  energies_.emplace(setup_.run_dir + "/energies_" + spec_.name + ".csv",
                    std::vector<std::string>{"t [time]", "kinetic [energy/depth]", "strain [energy/depth]",
                                             "work [energy/depth]"},
                    setup_.opening());
  probe_places_ = rigid::probe_places(setup_, spec_.name);
  for (const Vec2& place : probe_places_) probes_.push_back(attach(motion_.model().line(), place));
  probe_table_ = rigid::probe_table(setup_, spec_.name, quantities);
}

void BeamParticipant::place_grids() {
  for (std::size_t l = 0; l < skins_.size(); ++l) {
    const Skin& skin = skins_[l];
    const std::vector<double>& x = skin.outline().x;
    const auto n = static_cast<int>(skin.points());
    Drawn& drawn = drawn_.emplace_back();
    drawn.grid = l == 0 ? "beam" : "beam_" + gases_at(spec_)[l];
    drawn.reference = Field(Layout(n, 2), 2);
    drawn.state = Field(Layout(n, 2), static_cast<int>(quantities.size()));
    for (int i = 0; i < n; ++i) {
      for (int c = 0; c < 2; ++c) {
        const double on_outline = x[static_cast<std::size_t>(c * n + i)];
        drawn.reference(c, i, 0) = on_outline;
        drawn.reference(c, i, 1) = on_outline - (1 - beside) * skin.place(static_cast<std::size_t>(i)).r[c];
      }
    }
  }
}

}  // namespace fsi::beam
