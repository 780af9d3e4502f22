#include "fluid_solver/program/port.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/grid/geometry/quality.hpp"
#include "common/io/write_each.hpp"
#include "common/program/grid_from_case.hpp"
#include "common/program/reference_from_case.hpp"
#include "fluid_solver/program/from_case.hpp"

namespace fsi::fluid {

namespace {

/// Mean of |rho - exact| over the grid points: what is left to measure where the solution jumps.
double mean_density_error(const GasSolver& solver, const StateField& exact, double t) {
  double sum = 0;
  for (int k = 0; k < solver.grids(); ++k) {
    const ConstFieldView q = solver.state(k), x = solver.grid(k).x();
    for (int j = 0; j < q.layout.n2; ++j) {
      for (const grid::Interval& run : solver.valid(k).row(j)) {
        for (int i = run.begin; i < run.end; ++i)
          sum += std::abs(q(0, i, j) - exact(x(0, i, j), x(1, i, j), t).rho);
      }
    }
  }
  return sum / static_cast<double>(solver.points());
}

}  // namespace

FluidParticipant::FluidParticipant(const Setup& setup)
    : setup_(setup),
      spec_(fluid_of(setup)),
      reference_(reference_from_case(setup.problem, setup.run_dir)),
      solver_(gas_at_start(setup.problem, spec_, reference_)),
      crew_(setup.ranks, solver_),
      fields_(setup.run_dir, fields_name(spec_)) {
  for (const Side side : all_sides) {
    const BoundarySpec& boundary = spec_.boundary[static_cast<std::size_t>(side)];
    if (boundary.kind == BoundaryKind::interface)
      interfaces_.push_back({0, side, name_of_interface(boundary.solid)});
  }
  for (std::size_t k = 0; k < spec_.body_fitted.size(); ++k) {
    const BodyFittedSpec& fitted = spec_.body_fitted[k];
    if (!fitted.solid.empty())
      interfaces_.push_back({static_cast<int>(k) + 1, fitted.side, name_of_interface(fitted.solid)});
  }
  chosen_ = is_chosen(setup.problem, reference_);
  initial_totals_ = solver_.totals();
  open_budget();
  watch_fields();

  std::vector<std::string> columns{"t [time]"};
  for (const ProbeSpec& probe : setup.problem.output.probes) {
    if (probe.in != spec_.name) continue;
    probes_.push_back(probe);
    for (const char* quantity : {"rho", "v1", "v2", "p"})
      columns.push_back(fmt::format("{}.{}", probe.name, quantity));
  }
  if (!probes_.empty())
    probe_table_.emplace(setup.run_dir + "/parts/probes_" + spec_.name + ".csv", columns, setup.opening());
  solver_.share(setup.ranks, {.every = setup.recut});
}

wire::Hello FluidParticipant::hello() const {
  wire::Hello hello;
  hello.role = "fluid";
  hello.name = setup_.name;
  hello.law = fmt::format("ideal gas, gamma = {:g}", spec_.gamma);
  hello.config_digest = setup_.problem.digest;
  hello.points = solver_.points();
  for (const InterfaceSide& interface : interfaces_) {
    hello.interfaces.push_back({.name = interface.name,
                                .dimension = 2,
                                .x = solver_.grid(interface.grid).side_points(interface.side),
                                .n = {}});
  }
  return hello;
}

ProposedTimeStep FluidParticipant::compute_time_step() const {
  crew_.look();
  const TimeStep step = solver_.compute_time_step();
  return {.dt = step.dt, .reason = step.reason};
}

FluidParticipant::ChosenValues FluidParticipant::chosen_at(const InterfaceSide& interface) const {
  const std::vector<double> x = solver_.grid(interface.grid).side_points(interface.side);
  const std::size_t n = x.size() / 2;
  ChosenValues values{std::vector<double>(2 * n), std::vector<double>(n)};
  for (std::size_t k = 0; chosen_ && k < n; ++k) {
    const exact::GasState gas = reference_->gas(x[k], x[n + k], solver_.time());
    values.v[k] = gas.v1;
    values.v[n + k] = gas.v2;
    values.p[k] = gas.p - spec_.p_e;
  }
  return values;
}

/// With a chosen solution, the differences to it: v and p - p_e.
void FluidParticipant::fill(std::size_t k, wire::PredictedInterface& predicted) const {
  GasInterface state = solver_.interface_state(interfaces_[k].side, interfaces_[k].grid);
  if (chosen_) {
    const ChosenValues exact = chosen_at(interfaces_[k]);
    for (std::size_t i = 0; i < state.v.size(); ++i) state.v[i] -= exact.v[i];
    for (std::size_t i = 0; i < state.p.size(); ++i) state.p[i] -= exact.p[i];
  }
  predicted.x = std::move(state.x);
  predicted.v = std::move(state.v);
  predicted.p = std::move(state.p);
  predicted.z_f = std::move(state.z_f);
  predicted.gamma.assign(state.rho.size(), spec_.gamma);
  predicted.rho = std::move(state.rho);
  predicted.p_e = spec_.p_e;
}

void FluidParticipant::apply_bcs(double t, ProjectedStates projected) {
  std::vector<InterfaceValues> values;
  std::vector<ChosenValues> sums(projected.size());  // projected differences and the chosen values
  for (std::size_t k = 0; k < projected.size(); ++k) {
    const wire::ProjectedInterface& p = *projected[k];
    if (chosen_) {
      const ChosenValues exact = chosen_at(interfaces_[k]);
      sums[k] = {p.v_n, p.w_n};
      const std::size_t n = p.v_n.size();
      for (std::size_t i = 0; i < n; ++i) {
        sums[k].v[i] += p.n[i] * exact.v[i] + p.n[n + i] * exact.v[n + i];
        sums[k].p[i] -= exact.p[i];
      }
    }
    values.push_back({.side = interfaces_[k].side,
                      .n = p.n,
                      .v_n = chosen_ ? std::as_const(sums[k]).v : p.v_n,
                      .w_n = chosen_ ? std::as_const(sums[k]).p : p.w_n,
                      .v = p.v,
                      .a = p.a,
                      .grid = interfaces_[k].grid});
  }
  crew_.apply_bcs(t, values);
}

void FluidParticipant::advance(double t, double dt, int /*substeps*/, ProjectedStates projected) {
  std::vector<grid::SideCommand> commands;
  for (std::size_t k = 0; k < projected.size(); ++k)
    commands.push_back({interfaces_[k].side, projected[k]->x_next, interfaces_[k].grid});
  const double t_next = projected.empty() ? t + dt : projected.front()->t_next;
  crew_.move(t_next, dt, commands);
  for (int k = 0; k < solver_.grids(); ++k) {
    const grid::MovingGrid& grid = solver_.grid(k);
    if (grid.moves()) worst_cells_ = std::min(worst_cells_, grid::cell_quality(grid.x()));
  }
  lap(io::Work::grids);
  crew_.advance(t_next, dt);
}

std::vector<io::GridOutput> FluidParticipant::fields(bool last) const {
  std::vector<io::GridOutput> grids;
  for (int k = 0; k < solver_.grids(); ++k) {
    const ConstFieldView q = last ? solver_.last_state(k) : solver_.state(k);
    grids.push_back(
        {.grid = solver_.grid(k).name(),
         .x = last ? solver_.last_x(k) : solver_.grid(k).x(),
         .u = {},
         .fields = {{"rho", q, 0}, {"v1", q, 1}, {"v2", q, 2}, {"p", q, 3}},
         .kinds = solver_.levels() == nullptr ? kinds_of(solver_.composite(), k) : solver_.kinds(k),
         .sparse = solver_.is_level(k)});
  }
  return grids;
}

std::vector<io::GridOutput> FluidParticipant::fields_now() {
  crew_.collect();
  return fields(false);
}

void FluidParticipant::write_fields(double t, std::uint64_t step) {
  crew_.collect();
  io::write_each([&] { fields_.write(t, step, fields(true)); },
                 [&] {
                   if (!budget_) return;
                   const Totals defect = budget_->defect(solver_);
                   budget_table_->row({t, defect.mass, defect.momentum1, defect.momentum2, defect.energy});
                 });
}

void FluidParticipant::flush_tables() {
  io::write_each(
      [&] {
        if (probe_table_) probe_table_->flush();
      },
      [&] {
        if (budget_table_) budget_table_->flush();
      });
}

void FluidParticipant::write_last_state(double t, std::uint64_t step) {
  crew_.collect_all();
  fields_.write_apart("last_state", t, step, fields(true));
}

void FluidParticipant::archive(Archive& archive) {
  if (!archive.loading()) crew_.collect_all();
  solver_.archive(archive);
  if (archive.loading()) crew_.loaded();
  archive.number("worst_cells", worst_cells_);
  archive.inside("fields", [&] { fields_.archive(archive); });
  if (probe_table_) archive.inside("probes", [&] { probe_table_->archive(archive); });
  archive.inside("ripples", [&] { ripples_->archive(archive); });
  if (disagreement_) archive.inside("disagreement", [&] { disagreement_->archive(archive); });
  if (shocks_) archive.inside("strong_shocks", [&] { shocks_->archive(archive); });
  if (budget_) archive.inside("budget", [&] { budget_->archive(archive); });
  if (budget_table_) archive.inside("budget_table", [&] { budget_table_->archive(archive); });
}

void FluidParticipant::open_budget() {
  if (!has_budget(setup_.problem, spec_, reference_)) return;
  budget_.emplace(solver_);
  budget_table_.emplace(
      setup_.run_dir + "/budget_" + spec_.name + ".csv",
      std::vector<std::string>{"t [time]", "mass_defect [mass/depth]", "momentum1_defect [force*time/depth]",
                               "momentum2_defect [force*time/depth]", "energy_defect [force*length/depth]"},
      setup_.opening());
}

/// What the tables are made of.
std::vector<Strip> FluidParticipant::strips_of_tables() const {
  std::vector<Strip> strips;
  for (const ProbeSpec& probe : probes_) {
    const std::vector<Strip> cells = solver_.probe_strips(probe.x, probe.y);
    strips.insert(strips.end(), cells.begin(), cells.end());
  }
  if (!budget_) return strips;
  for (const Side side : all_sides) {
    if (solver_.lets_pass(side)) continue;
    for (const int k : solver_.backgrounds()) add_side_strips(solver_.grid(k).layout(), side, strips, k);
  }
  return strips;
}

void FluidParticipant::write_tables(double t, double dt, ProjectedStates projected) {
  if (!crew_.alone() && (budget_ || probe_table_)) crew_.fetch(strips_of_tables());
  if (budget_) {
    std::vector<InterfaceLoad> loads;
    for (std::size_t k = 0; k < projected.size(); ++k) {
      const wire::ProjectedInterface& p = *projected[k];
      loads.push_back(
          {.side = interfaces_[k].side, .grid = interfaces_[k].grid, .n = p.n, .v_n = p.v_n, .w_n = p.w_n});
    }
    budget_->add(solver_, loads, dt);
  }
  if (!probe_table_) return;
  std::vector<double> row{t};
  for (const ProbeSpec& probe : probes_) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const State q = solver_.probe(probe.x, probe.y).value_or(State{nan, nan, nan, nan});
    row.insert(row.end(), {q.rho, q.v1, q.v2, q.p});
  }
  probe_table_->row(row);
}

/// Changes below a millionth of the initial state are round-off.
void FluidParticipant::watch_fields() {
  constexpr double small = 1e-6;
  const Health start = solver_.health();
  const double sound = std::sqrt(spec_.gamma * start.min_p / start.min_rho);
  std::vector<std::string> names;
  for (int k = 0; k < solver_.grids(); ++k) names.push_back(solver_.grid(k).name());
  const std::vector<grid::WatchedQuantity> quantities{
      {.components = {"rho"}, .first = 0, .floor = small * start.min_rho},
      {.components = {"v1", "v2"}, .first = 1, .floor = small * sound},
      {.components = {"p"}, .first = 3, .floor = small * start.min_p}};
  ripples_.emplace(quantities, names);
  if (!spec_.scheme.shock_viscosity && spec_.scheme.limiter != GasLimiter::none)
    shocks_.emplace(spec_.gamma, names);
  if (const grid::CompositeGrid* composite = solver_.composite()) {
    names.resize(static_cast<std::size_t>(composite->grids()));
    disagreement_.emplace(quantities, std::move(names));
  }
}

void FluidParticipant::look_for_noise(double t) {
  crew_.collect();
  watched_.clear();
  for (int k = 0; k < solver_.grids(); ++k)
    watched_.push_back({.q = solver_.state(k), .x = solver_.grid(k).x(), .points = &solver_.valid(k)});
  ripples_->look(watched_, t);
  if (shocks_) shocks_->look(watched_, t);
  if (!disagreement_) return;
  const grid::CompositeGrid& composite = *solver_.composite();
  watched_.resize(static_cast<std::size_t>(composite.grids()));
  for (int k = 0; k < composite.grids(); ++k)
    watched_[static_cast<std::size_t>(k)].points = &solver_.discretised(k);
  disagreement_->look(composite.background(), watched_, ripples_->ranges(), t);
}

wire::Health FluidParticipant::health() const {
  crew_.look();
  const Health health = solver_.health();
  return {.min_rho = health.min_rho,
          .min_p = health.min_p,
          .min_det_F = 0,
          .min_cell_quality = health.min_cell_quality,
          .first_order_fallbacks = health.first_order_fallbacks,
          .floors = health.floors};
}

void FluidParticipant::report(double t, io::Part& part) const {
  crew_.look();
  crew_.collect();
  const Health health = solver_.health();
  part.counters["first_order_fallbacks"] = static_cast<double>(health.first_order_fallbacks);
  part.counters["first_order_fallbacks_outside_shocks"] =
      static_cast<double>(health.first_order_outside_shocks);
  part.counters["positive_fluxes"] = static_cast<double>(health.positive_fluxes);
  part.counters["positive_values"] = static_cast<double>(health.positive_values);
  part.counters["bounded_side_points"] = static_cast<double>(health.bounded_side_points);
  part.counters["floors"] = static_cast<double>(health.floors);
  part.overlap = overlap_of(solver_.composite());
  part.health["min_rho"] = health.min_rho;
  part.health["min_p"] = health.min_p;
  part.health["min_cell_quality"] = worst_cells_;
  const Totals now = solver_.totals();
  part.conservation["mass"] = now.mass - initial_totals_.mass;
  part.conservation["energy"] = now.energy - initial_totals_.energy;
  part.conservation["momentum1"] = now.momentum1 - initial_totals_.momentum1;
  part.conservation["momentum2"] = now.momentum2 - initial_totals_.momentum2;
  part.conservation["angular_momentum"] = now.angular_momentum - initial_totals_.angular_momentum;
  if (budget_) {
    const Totals defect = budget_->defect(solver_);
    part.conservation["mass_initial"] = initial_totals_.mass;
    part.conservation["mass_defect"] = defect.mass;
    part.conservation["momentum1_defect"] = defect.momentum1;
    part.conservation["momentum2_defect"] = defect.momentum2;
    part.conservation["energy_defect"] = defect.energy;
  }
  if (!reference_ || part.status == "stopped") return;
  if (const std::string missing = reference_->missing_at(t); !missing.empty()) {
    if (part.reason.empty()) part.reason = missing;
    return;
  }
  const StateField exact = field_of(reference_);
  const GasErrors errors = solver_.errors(exact, t);
  part.errors = {{"rho", errors.rho},
                 {"v1", errors.v1},
                 {"v2", errors.v2},
                 {"T", errors.T},
                 {"rho_mean", mean_density_error(solver_, exact, t)}};
}

}  // namespace fsi::fluid
