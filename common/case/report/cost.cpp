#include "common/case/report/cost.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "common/case/grids/composite_from_case.hpp"
#include "common/case/grids/curve_side.hpp"
#include "common/case/grids/grid_points.hpp"
#include "common/case/schema/laws.hpp"
#include "common/core/failure.hpp"
#include "common/core/time/time_schedule.hpp"

namespace fsi {

namespace {

/// Points that one core advances in a second, and the time of a step's messages for some hundreds of points
/// [s]. `updates` in the summary of a run says its own: 13 and 5.5 million in shock_ellipse with AVX-512; the
/// estimate is for slower processors.
constexpr double gas_speed = 8e6, solid_speed = 4e6, exchange = 1e-3;

/// Of a grid that moves [s]: to connect a point of it in a step, and to march a point once. Processor time of the gas
/// for a rigid ellipse with semi-axes 0.5 x 0.12, 0.06 and 0.03 at h = 1/40, with and without 25 to 110 more steps:
/// 0.19, 0.21 and 0.67 millionths a point and step. Its points are 1, 2 and up to 12 times as close as its lines, and a
/// line is marched to in as many steps; `bench_grid` has 0.05 millionths for one.
constexpr double connecting = 0.14e-6, marching = 0.05e-6;

/// 1 / dt of one cell for waves of speed 1.
struct CellRate {
  double rate = 0;
  const std::string* grid = nullptr;
  Vec2 x = Vec2::Zero(), cell = Vec2::Zero();
};

/// Sum of |grad r| over both directions of the cell between the positions a, a + along, a + across.
CellRate rate_of(const Vec2& a, const Vec2& along, const Vec2& across, const std::string& name) {
  const double area = std::abs(along[0] * across[1] - along[1] * across[0]);
  const double length = along.norm(), width = across.norm();
  return {.rate = (length + width) / area, .grid = &name, .x = a, .cell = {length, width}};
}

/// Without the two outermost lines, which are interpolated.
void append_rates(const BodyFittedSpec& spec, const grid::MovingGrid& grid, std::vector<CellRate>& rates) {
  const ConstFieldView x = grid.x();
  constexpr int interpolated = 2;
  const int first = spec.side == Side::top ? interpolated : 0;
  const int end = x.layout.n2 - 1 - (spec.side == Side::top ? 0 : interpolated);
  for (int j = first; j < end; ++j) {
    for (int i = 0; i + 1 < x.layout.n1; ++i) {
      const Vec2 a(x(0, i, j), x(1, i, j)), b(x(0, i + 1, j), x(1, i + 1, j)),
          c(x(0, i, j + 1), x(1, i, j + 1));
      rates.push_back(rate_of(a, b - a, c - a, spec.name));
    }
  }
}

/// A lattice has one cell, a mapped grid is looked at in 64 x 64 places.
void append_rates(const GridSpec& spec, std::vector<CellRate>& rates) {
  constexpr int samples = 64;
  const bool lattice = spec.kind == GridSpec::Kind::rectangle;
  const int step1 = lattice ? spec.n1 : std::max(1, (spec.n1 - 1) / samples);
  const int step2 = lattice ? spec.n2 : std::max(1, (spec.n2 - 1) / samples);
  for (int j = 0; j + 1 < spec.n2; j += step2) {
    for (int i = 0; i + 1 < spec.n1; i += step1) {
      const Vec2 a = position(spec, i, j, 0);
      rates.push_back(
          rate_of(a, position(spec, i + 1, j, 0) - a, position(spec, i, j + 1, 0) - a, spec.name));
    }
  }
}

/// Area a body's outline encloses, closed along the wall where it stands on one [length^2].
double area_within(const CurveSpec& curve) {
  const int n = curve.points();
  double twice = 0;
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i), next = static_cast<std::size_t>((i + 1) % n);
    const auto y = static_cast<std::size_t>(n);
    twice += curve.x[k] * curve.x[y + next] - curve.x[next] * curve.x[y + k];
  }
  return 0.5 * std::abs(twice);
}

/// The lattice's points that lie within an area of that size, all of them at most. [-]
double points_within(double area, const GridSpec& lattice) {
  const double cells = (lattice.n1 - 1.0) * (lattice.n2 - 1.0);
  const double whole = (lattice.x_b - lattice.x_a) * (lattice.y_b - lattice.y_a);
  return std::min(cells * area / whole, static_cast<double>(lattice.n1) * lattice.n2);
}

/// Points of a lattice that a gas's bodies, or what lies outside a solid's outline, leave unused.
double unused_points(const FluidSpec& fluid) {
  if (fluid.grid.kind != GridSpec::Kind::rectangle) return 0;
  double unused = 0;
  for (const BodyFittedSpec& fitted : fluid.body_fitted) {
    if (!fitted.solid.empty()) unused += points_within(area_within(fitted.curve), fluid.grid);
  }
  return unused;
}

double unused_points(const SolidSpec& solid) {
  if (solid.body_fitted.size() != 1 || solid.grid.kind != GridSpec::Kind::rectangle) return 0;
  return static_cast<double>(solid.grid.n1) * solid.grid.n2 -
         points_within(area_within(solid.body_fitted.front().curve), solid.grid);
}

/// In how many steps a grid is marched to its next line: as many as keep them about as short as its points are
/// apart (common/grid/marching/hyperbolic.cpp, `steps_from`).
double steps_to_a_line(const BodyFittedSpec& fitted) {
  const std::vector<double>& x = fitted.curve.x;
  const std::size_t n = x.size() / 2;
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < n; ++k)
    shortest = std::min(shortest, std::hypot(x[k] - x[k - 1], x[n + k] - x[n + k - 1]));
  const double steps = std::max(1.0, std::round(fitted.spacing / fitted.curve.spacing));
  if (steps == 1) return 1;
  return steps * std::max(1.0, std::round(2 * fitted.spacing / steps / shortest));
}

/// Adds what the grids around bodies that move cost in each step.
void add_moving(StepCost& cost, const FluidSpec& fluid, const std::vector<SolidSpec>& solids) {
  for (const BodyFittedSpec& fitted : fluid.body_fitted) {
    const auto solid = std::ranges::find(solids, fitted.solid, &SolidSpec::name);
    if (solid == solids.end() || solid->fixed) continue;
    const double points = static_cast<double>(fitted.curve.points()) * fitted.lines;
    cost.moving += points;
    cost.grids += points * (connecting + marching * (fitted.map ? 1 : steps_to_a_line(fitted)));
  }
}

template <class Owner>
StepCost step_of(const std::string& program, const Owner& owner, double speed) {
  std::vector<CellRate> rates;
  double fitted_points = 0;
  const std::vector<grid::MovingGrid> grids = grids_at_start(fitted_grids(owner));
  for (std::size_t k = 0; k < grids.size(); ++k) {
    const BodyFittedSpec& fitted = fitted_grids(owner)[k];
    append_rates(fitted, grids[k], rates);
    fitted_points += static_cast<double>(fitted.curve.points()) * fitted.lines;
  }
  const std::size_t fitted_cells = rates.size();
  append_rates(owner.grid, rates);
  std::ranges::sort(rates, std::ranges::greater{}, &CellRate::rate);
  const CellRate& worst = rates.front();
  const double lattice = static_cast<double>(owner.grid.n1) * owner.grid.n2;
  StepCost cost{.program = program,
                .points = fitted_points + lattice - unused_points(owner),
                .dt = 1 / (speed * worst.rate),
                .grid = *worst.grid,
                .x = worst.x,
                .cell = worst.cell,
                .has_corners = std::ranges::any_of(fitted_grids(owner), [&](const BodyFittedSpec& fitted) {
                  return fitted.name == *worst.grid && !fitted.curve.corners.empty();
                })};
  const std::size_t few = std::min(fitted_cells / 20, rates.size() - 1);
  cost.usual_dt = 1 / (speed * rates[few].rate);
  return cost;
}

/// The largest finite |v| + a of a state where there is gas on its grid.
double fastest(const GasExpressions& state, const FluidSpec& fluid) {
  constexpr int samples = 64;
  double most = 0;
  for (int j = 0; j <= samples; ++j) {
    for (int i = 0; i <= samples; ++i) {
      const Vec2 x = place(fluid.grid, static_cast<double>(i) / samples, static_cast<double>(j) / samples, 0);
      const double v = std::hypot(state.v1(x[0], x[1], 0), state.v2(x[0], x[1], 0));
      const double speed = v + std::sqrt(fluid.gamma * state.p(x[0], x[1], 0) / state.rho(x[0], x[1], 0));
      if (!std::isfinite(speed) || speed <= most) continue;
      if (std::ranges::none_of(fluid.body_fitted, [&](const BodyFittedSpec& fitted) {
            return lies_behind(fitted, fluid.grid, x);
          }))
        most = speed;
    }
  }
  return most;
}

/// 0: the states come from a reference solution.
double wave_speed_of(const FluidSpec& fluid) {
  double most = fluid.initial ? fastest(*fluid.initial, fluid) : 0;
  for (const BoundarySpec& side : fluid.boundary) {
    if (side.state) most = std::max(most, fastest(*side.state, fluid));
  }
  return most;
}

/// (45) with the parts of the betas that are in proportion to 1/dt.
double part_left(const SolidScheme& scheme) {
  const double beta =
      0.5 * std::max(scheme.tangential_stress.scaled + scheme.relaxation.scaled, scheme.displacement.scaled);
  return std::sqrt(std::max(0.0, 1 - beta * beta));
}

StepCost step_of(const SolidSpec& solid) {
  if (!is_continuum(solid.law)) return {.program = solid.name, .dt = std::numeric_limits<double>::infinity()};
  StepCost cost = step_of(solid.name, solid, std::sqrt((solid.lambda + 2 * solid.mu) / solid.rho));
  cost.dt *= part_left(solid.scheme);
  cost.usual_dt *= part_left(solid.scheme);
  return cost;
}

std::string time_text(double seconds) {
  if (seconds < 90) return fmt::format("{:.2g} s", seconds);
  if (seconds < 5400) return fmt::format("{:.2g} min", seconds / 60);
  return fmt::format("{:.2g} h", seconds / 3600);
}

}  // namespace

int RunCost::substeps(const StepCost& program) const {
  constexpr double round_off = 1e-9;
  return std::isfinite(program.dt)
             ? static_cast<int>(std::clamp(std::ceil(dt / program.dt - round_off), 1.0, 1e9))
             : 1;
}

double RunCost::seconds_of(const StepCost& program) const {
  return substeps(program) * program.points / (program.is_gas ? gas_speed : solid_speed) + program.grids;
}

namespace {

/// Steps that all programs take together: as small as the gas needs, or without `multirate` as anybody does.
void take_steps(RunCost& cost, const TimeSpec& time, bool multirate) {
  const bool gas_decides = multirate && std::ranges::any_of(cost.programs, &StepCost::is_gas);
  cost.dt = time.dt.value_or(std::numeric_limits<double>::infinity());
  for (const StepCost& program : cost.programs) {
    if (!gas_decides || program.is_gas) cost.dt = std::min(cost.dt, program.dt);
  }
  if (!std::isfinite(cost.dt)) return;
  cost.steps = std::ceil(time.end / cost.dt);
  double slowest = 0;
  for (const StepCost& program : cost.programs) slowest = std::max(slowest, cost.seconds_of(program));
  cost.seconds = cost.steps * (slowest + exchange);
}

/// Could `time.multirate` be written where it is not?
bool may_have_substeps(const Case& problem) {
  return !problem.time.multirate && !problem.fluids.empty() && !problem.time.dt &&
         problem.interface.projection != Projection::traditional;
}

}  // namespace

RunCost cost_of(const Case& problem) {
  RunCost cost;
  for (const FluidSpec& fluid : problem.fluids) {
    const double speed = wave_speed_of(fluid);
    if (speed == 0) return {};
    cost.programs.push_back(step_of(fluid.name, fluid, speed));
    cost.programs.back().is_gas = true;
    cost.programs.back().levels = fluid.refine.levels;
    add_moving(cost.programs.back(), fluid, problem.solids);
  }
  for (const SolidSpec& solid : problem.solids) cost.programs.push_back(step_of(solid));
  for (StepCost& program : cost.programs) {
    program.dt *= problem.time.cfl;
    program.usual_dt *= problem.time.cfl;
  }
  take_steps(cost, problem.time, problem.time.multirate);
  cost.h = 0.1 / problem.grid_factor;
  for (std::size_t k = 0; k < cost.programs.size() && cost.seconds > 0; ++k) {
    RunCost other = cost;
    other.programs[k].dt = other.programs[k].usual_dt;
    take_steps(other, problem.time, problem.time.multirate);
    cost.programs[k].saved = 1 - other.seconds / cost.seconds;
  }
  if (may_have_substeps(problem)) {
    RunCost other = cost;
    take_steps(other, problem.time, true);
    cost.multirate_steps = other.steps;
    cost.multirate_seconds = other.seconds;
  }
  return cost;
}

namespace {

/// What makes a run long, where it is; "" where it is not.
std::string why_long(const RunCost& cost, const std::string& steps) {
  constexpr double hour = 3600, most = 0.5;
  if (cost.seconds <= hour) return "";
  const auto slowest = std::ranges::max_element(
      cost.programs, {}, [&](const StepCost& program) { return cost.seconds_of(program); });
  const std::string moving =
      slowest->grids > most * cost.seconds_of(*slowest)
          ? fmt::format(
                ", most of the time for the {:.0f} of its grids that move, which are laid anew each step",
                slowest->moving)
          : "";
  return fmt::format(
      "\n  more than an hour: {} steps with {:.0f} points in {}{}; with half the grid.factor an "
      "eighth of it, where bends and thin places do not set the grids; write them rounder or thicker "
      "where they do",
      steps, slowest->points, slowest->program, moving);
}

}  // namespace

void refuse_endless(const RunCost& cost) {
  for (const StepCost& program : cost.programs) {
    const double substeps = cost.dt / program.dt;
    if (!(substeps > most_substeps)) continue;
    throw UserMistake(
        fmt::format("solids.{}: takes about {:.0f} substeps in a step, {:.0f} are possible: dt about {:.2g}, "
                    "set by cells {:.2g} x "
                    "{:.2g} of grid \"{}\"; look at its points, and at the units of its rho and moduli, "
                    "which make its waves that fast",
                    program.program, substeps, most_substeps, program.dt, program.cell[0], program.cell[1],
                    program.grid));
  }
  constexpr double most_steps = 1e11;
  if (!(cost.steps > most_steps)) return;
  const StepCost& slowest =
      *std::ranges::min_element(cost.programs, {}, [](const StepCost& program) { return program.dt; });
  throw UserMistake(fmt::format(
      "time.end is {:.2g} steps of {:.3g} away, more than any run can take ({:.0e}): write a smaller "
      "time.end, or "
      "find out what makes the steps of {} so small: cells {:.2g} x {:.2g} of grid \"{}\", or fast waves "
      "there",
      cost.steps, cost.dt, most_steps, slowest.program, slowest.cell[0], slowest.cell[1], slowest.grid));
}

namespace {

/// Where a solid makes the gas take small steps too; "" where it does not.
std::string multirate_text(const RunCost& cost) {
  constexpr double worth_it = 1.5;
  if (!(cost.multirate_steps > 0 && cost.steps > worth_it * cost.multirate_steps)) return "";
  double of_gas = std::numeric_limits<double>::infinity();
  for (const StepCost& program : cost.programs)
    of_gas = std::min(of_gas, program.is_gas ? program.dt : of_gas);
  std::vector<std::string> small;  // solids whose steps are
  for (const StepCost& program : cost.programs) {
    if (!program.is_gas && program.dt < of_gas) small.push_back(program.program);
  }
  return fmt::format(
      "  {}: all programs take steps as small, {:.2g} times as many as the gas needs; not so with "
      "`time.multirate: true`: about {:.0f} steps, {}\n",
      fmt::join(small, ", "), cost.steps / cost.multirate_steps, cost.multirate_steps,
      time_text(cost.multirate_seconds));
}

/// A solid that takes most of the time since its outline asks for cells much smaller than h; "" without one.
std::string fine_solid_text(const RunCost& cost) {
  constexpr double minute = 60, much_smaller = 0.2;
  const StepCost& slowest = *std::ranges::max_element(
      cost.programs, {}, [&](const StepCost& program) { return cost.seconds_of(program); });
  const double cell = std::max(slowest.cell[0], slowest.cell[1]);
  if (slowest.is_gas || !std::isfinite(slowest.dt) || slowest.has_corners || cost.seconds < minute ||
      cell > much_smaller * cost.h)
    return "";
  return fmt::format(
      "  {}: takes most of the time: its sharpest bend and thinnest place ask for cells {:.2g} times as "
      "small as h = {:.2g}; make it thicker, round it more, or not at all (`radius: 0` of a polygon)\n",
      slowest.program, cost.h / cell, cost.h);
}

}  // namespace

std::string cost_text(const RunCost& cost) {
  if (cost.steps == 0) return "";
  std::string text, warning;
  for (const StepCost& program : cost.programs) {
    if (!std::isfinite(program.dt)) continue;
    const int substeps = cost.substeps(program);
    text += fmt::format(
        "  {}: dt about {:.2g}, set by cells {:.2g} x {:.2g} of grid \"{}\" near ({:.3g}, {:.3g}){}\n",
        program.program, program.dt, program.cell[0], program.cell[1], program.grid, program.x[0],
        program.x[1], substeps > 1 ? fmt::format("; {} substeps in a step", substeps) : "");
    constexpr double much = 1.0 / 3;
    if (program.saved > much)
      warning += fmt::format(
          "  {}: a twentieth of the cells, near that place, makes the step {:.2g} times smaller than "
          "the others need: {}write a greater `spacing` or fewer `points` for that grid\n",
          program.program, program.usual_dt / program.dt,
          program.has_corners
              ? ""
              : "round the outline more there, or not at all (`radius: 0` of a polygon), or ");
  }
  warning += fine_solid_text(cost) + multirate_text(cost);
  const bool levels =
      std::ranges::any_of(cost.programs, [](const StepCost& program) { return program.levels > 1; });
  constexpr double countable = 1e9;  // no run takes more: the digits of such a number say nothing
  const std::string steps =
      cost.steps < countable ? fmt::format("{:.0f}", cost.steps) : fmt::format("{:.2g}", cost.steps);
  return text + warning +
         fmt::format("  about {} steps of {:.2g}; about {} with a core for each program{}", steps, cost.dt,
                     time_text(cost.seconds), levels ? ", less by what the levels save" : "") +
         why_long(cost, steps);
}

}  // namespace fsi
