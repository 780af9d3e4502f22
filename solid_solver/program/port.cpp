#include "solid_solver/program/port.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/case/report/remarks.hpp"
#include "common/io/write_each.hpp"
#include "common/program/grid_from_case.hpp"
#include "solid_solver/kernels/state.hpp"

namespace fsi::solid {

SolidParticipant::SolidParticipant(const Setup& setup, const SolidSpec& spec, const LawKind& law)
    : setup_(setup),
      spec_(spec),
      law_(law),
      body_(setup, spec, law),
      solver_(body_.solver()),
      crew_(setup.ranks, body_),
      fields_(setup.run_dir, "solid_" + spec.name) {
  initial_totals_ = solver_.totals();
  open_tables();
  watch_ripples();
  solver_.share(setup.ranks, {.every = setup.recut});
}

wire::Hello SolidParticipant::hello() const {
  wire::Hello hello;
  hello.role = "solid";
  hello.name = spec_.name;
  hello.law = std::string(law_.name);
  hello.config_digest = setup_.problem.digest;
  hello.points = solver_.points();
  for (const Meeting& meeting : body_.meetings()) {
    SolidInterface state;
    body_.show(meeting, state);
    move_along(meeting, state.x);
    const std::vector<double> x_bar = body_.reference_points(meeting);
    hello.interfaces.push_back({.name = meeting.name,
                                .dimension = 2,
                                .x = state.x,
                                .n = body_.normals(meeting, x_bar, state.fixed)});
  }
  return hello;
}

ProposedTimeStep SolidParticipant::compute_time_step() const {
  const TimeStep step = solver_.compute_time_step();
  return {.dt = step.dt, .reason = step.reason};
}

void SolidParticipant::fill(std::size_t k, wire::PredictedInterface& predicted) const {
  const Meeting& meeting = body_.meetings()[k];
  body_.show(meeting, interface_);
  expect_waves(meeting);
  predicted.x = interface_.x;
  move_along(meeting, predicted.x);
  predicted.v = interface_.v;
  predicted.w = interface_.w;
  predicted.Z = interface_.Z;
  predicted.fixed = interface_.fixed;
  predicted.z_p = interface_.z_p;
}

void SolidParticipant::apply_bcs(double t, ProjectedStates projected) {
  crew_.apply_bcs(t, answers(projected));
}

void SolidParticipant::advance(double t, double dt, int substeps, ProjectedStates projected) {
  crew_.advance(t, dt, substeps, answers(projected), [this](io::Work work) { lap(work); });
  squeeze_.add(solver_.health().min_det_F);
}

std::vector<io::GridOutput> SolidParticipant::fields_now() {
  crew_.collect();
  return fields();
}

void SolidParticipant::write_fields(double t, std::uint64_t step) {
  fields_.write(t, step, fields_now());
}

void SolidParticipant::write_last_state(double /*t*/, std::uint64_t step) {
  fields_.write_apart("last_state", solver_.t(), step, fields_now());
}

void SolidParticipant::archive(Archive& archive) {
  if (!archive.loading()) crew_.collect_all();
  solver_.archive(archive);
  if (archive.loading()) crew_.loaded();
  archive.inside("fields", [&] { fields_.archive(archive); });
  archive.inside("ripples", [&] { ripples_->archive(archive); });
  if (forces_) archive.inside("forces", [&] { forces_->archive(archive); });
  if (probe_table_) archive.inside("probes", [&] { probe_table_->archive(archive); });
  archive.inside("received", [&] { received_.archive(archive); });
  archive.inside("squeeze", [&] { squeeze_.archive(archive); });
}

void SolidParticipant::write_tables(double t, double dt, ProjectedStates /*projected*/) {
  if (forces_ || probe_table_) crew_.fetch(strips_of_probes());
  io::write_each(
      [&] {
        if (forces_) write_forces(t, dt);
      },
      [&] {
        if (probe_table_) write_probes(t);
      });
}

void SolidParticipant::write_forces(double t, double dt) {
  const SideLoad load = whole_load();
  received_.add({load.force[0], load.force[1], load.power, load.force.norm()}, dt);
  const Pose pose = crew_.pose();
  forces_->row({t, load.force[0], load.force[1], load.moment, load.power, pose.centre[0], pose.centre[1],
                pose.velocity[0], pose.velocity[1], pose.angle});
}

void SolidParticipant::write_probes(double t) {
  std::vector<double> row{t};
  for (const ProbePoint& probe : probes_) {
    const SolidState q = solver_.value(probe);
    row.insert(row.end(), {q.u[0], q.u[1], q.v[0], q.v[1], q.P.a11, q.P.a12, q.P.a21, q.P.a22});
  }
  probe_table_->row(row);
}

void SolidParticipant::flush_tables() {
  io::write_each(
      [&] {
        if (forces_) forces_->flush();
      },
      [&] {
        if (probe_table_) probe_table_->flush();
      });
}

std::string SolidParticipant::remedy() const {
  return remedy_for(spec_.name, spec_.scheme, spec_.lambda / spec_.mu, law_.softens, squeeze_.by_load(),
                    pressure_over_stiffness(setup_.problem, spec_),
                    stagnation_over_stiffness(setup_.problem, spec_));
}

wire::Health SolidParticipant::health() const {
  return {.min_rho = 0,
          .min_p = 0,
          .min_det_F = solver_.health().min_det_F,
          .min_cell_quality = 1,
          .first_order_fallbacks = 0,
          .floors = 0};
}

void SolidParticipant::look_for_noise(double t) {
  crew_.collect();
  watched_.clear();
  for (int g = 0; g < solver_.grids(); ++g)
    watched_.push_back({.q = solver_.state(g), .x = solver_.grid(g).x(), .points = &solver_.valid(g)});
  ripples_->look(watched_, t);
}

void SolidParticipant::report(double t, io::Part& part) const {
  crew_.collect_all();
  const Health health = solver_.health();
  part.overlap = overlap_of(solver_.composite());
  part.health["min_det_F"] = health.min_det_F;
  if (health.settled > 0) part.counters["settled_ghost_points"] = health.settled;
  if (health.waveless > 0) part.counters["waveless_side_points"] = health.waveless;
  const Totals now = solver_.totals();
  part.conservation["mass"] = now.mass - initial_totals_.mass;
  part.conservation["energy"] = now.energy() - initial_totals_.energy();
  part.conservation["energy_initial"] = initial_totals_.energy();
  part.conservation["momentum1"] = now.momentum[0] - initial_totals_.momentum[0];
  part.conservation["momentum2"] = now.momentum[1] - initial_totals_.momentum[1];
  part.conservation["angular_momentum"] = now.angular_momentum - initial_totals_.angular_momentum;
  part.conservation["angular_momentum_initial"] = initial_totals_.angular_momentum;
  if (surrounded()) {
    const std::array<double, 4>& in = received_.sum();
    part.conservation["momentum1_defect"] = part.conservation["momentum1"] - in[0];
    part.conservation["momentum2_defect"] = part.conservation["momentum2"] - in[1];
    part.conservation["energy_defect"] = part.conservation["energy"] - in[2];
    part.conservation["momentum_scale"] =
        std::max(in[3], 0.1 * std::sqrt(2.0 * now.mass * now.kinetic_energy));
  }
  const StateFunction exact = body_.data().reference_state();
  if (!exact || part.status == "stopped") return;
  if (const std::string missing = body_.data().reference_missing_at(t); !missing.empty()) {
    if (part.reason.empty()) part.reason = missing;
    return;
  }
  const Errors errors = solver_.errors(exact, t);
  part.errors = {{"u_bar", errors.u}, {"v_bar", errors.v}, {"P_bar", errors.P}};
}

std::span<const Answer> SolidParticipant::answers(ProjectedStates projected) {
  answers_.clear();
  for (const wire::ProjectedInterface* p : projected)
    answers_.push_back(
        {.n = p->n, .v_n = p->v_n, .w_n = p->w_n, .gas = {.z_f = p->z_f, .t = p->robin_t, .r = p->robin_r}});
  return answers_;
}

void SolidParticipant::expect_waves(const Meeting& meeting) const {
  const std::size_t n = interface_.x.size() / 2;
  for (std::size_t k = 0; k < interface_.Z.size(); ++k) {
    if (std::isfinite(interface_.Z[k])) continue;
    const std::vector<double> x_bar = body_.reference_points(meeting);
    throw Diverged("the solid carries no waves any more: its impedance is not a number",
                   {.t = solver_.t(),
                    .interface = meeting.name,
                    .point = {static_cast<int>(k % n)},
                    .position = {x_bar[k % n], x_bar[n + k % n]},
                    .of_reference = true});
  }
}

std::vector<Strip> SolidParticipant::strips_of_probes() const {
  std::vector<Strip> strips;
  for (const ProbePoint& probe : probes_) {
    const std::vector<Strip> cell = AnySolidSolver::strips_of(probe);
    strips.insert(strips.end(), cell.begin(), cell.end());
  }
  return strips;
}

SideLoad SolidParticipant::whole_load() const {
  SideLoad sum = body_.load(body_.meetings().front());
  for (const Meeting& meeting : body_.meetings().subspan(1)) sum += body_.load(meeting);
  return sum;
}

std::vector<io::GridOutput> SolidParticipant::fields() const {
  static constexpr const char* names[] = {"u1", "u2", "v1", "v2", "P11", "P12", "P21", "P22"};
  std::vector<io::GridOutput> grids;
  for (int g = 0; g < solver_.grids(); ++g) {
    const ConstFieldView q = solver_.state(g);
    std::vector<io::NamedPlane> planes;
    for (int k = 0; k < 8; ++k) planes.push_back({names[k], q, k});
    grids.push_back({.grid = solver_.grid(g).name(),
                     .x = solver_.grid(g).x(),
                     .u = q,
                     .fields = std::move(planes),
                     .kinds = kinds_of(solver_.composite(), g)});
  }
  return grids;
}

bool SolidParticipant::surrounded() const {
  return !body_.meetings().empty() && !spec_.body_fitted.empty() &&
         spec_.body_fitted.front().curve.closed() && !spec_.body_force && !setup_.problem.interface.motion;
}

void SolidParticipant::move_along(const Meeting& meeting, std::vector<double>& x) const {
  const auto& motion = setup_.problem.interface.motion;
  if (!motion) return;
  const std::vector<double> x_bar = body_.reference_points(meeting);
  const std::size_t n = x_bar.size() / 2;
  for (std::size_t k = 0; k < n; ++k) {
    x[k] += motion->c1(x_bar[k], x_bar[n + k], solver_.t()) - x_bar[k];
    x[n + k] += motion->c2(x_bar[k], x_bar[n + k], solver_.t()) - x_bar[n + k];
  }
}

void SolidParticipant::watch_ripples() {
  constexpr double small = 1e-6;  // strains below it, and what goes with them, are round-off
  const double modulus = spec_.lambda + 2 * spec_.mu;
  const double size = std::sqrt(initial_totals_.mass / spec_.rho);
  std::vector<std::string> names;
  for (int g = 0; g < solver_.grids(); ++g) names.push_back(solver_.grid(g).name());
  ripples_.emplace(
      std::vector<grid::WatchedQuantity>{
          {.components = {"u1", "u2"}, .first = plane::u1, .floor = small * size},
          {.components = {"v1", "v2"}, .first = plane::v1, .floor = small * std::sqrt(modulus / spec_.rho)},
          {.components = {"P11", "P12", "P21", "P22"}, .first = plane::P11, .floor = small * modulus}},
      std::move(names));
}

void SolidParticipant::open_tables() {
  if (!body_.meetings().empty()) {
    forces_.emplace(
        setup_.run_dir + "/forces_" + spec_.name + ".csv",
        std::vector<std::string>{"t [time]", "force1 [force/depth]", "force2 [force/depth]",
                                 "moment [force*length/depth]", "power [power/depth]", "centre1 [length]",
                                 "centre2 [length]", "velocity1 [length/time]", "velocity2 [length/time]",
                                 "angle [rad]"},
        setup_.opening());
  }
  std::vector<std::string> columns{"t [time]"};
  for (const ProbeSpec& probe : setup_.problem.output.probes) {
    if (probe.in != spec_.name) continue;
    probes_.push_back(solver_.locate(probe.x, probe.y));
    for (const char* quantity : {"u1", "u2", "v1", "v2", "P11", "P12", "P21", "P22"}) {
      columns.push_back(fmt::format("{}.{}", probe.name, quantity));
    }
  }
  if (!probes_.empty())
    probe_table_.emplace(setup_.run_dir + "/parts/probes_" + spec_.name + ".csv", columns, setup_.opening());
}

}  // namespace fsi::solid
