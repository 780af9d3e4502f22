#include "fluid_solver/component.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "common/core/failure.hpp"
#include "fluid_solver/boundary/ghost_lines.hpp"
#include "fluid_solver/measures/shocks.hpp"
#include "fluid_solver/positivity.hpp"

namespace fsi::fluid {

namespace {

/// The lowest pressure the update may leave, as part of the largest initial one.
constexpr double floor_part = 1e-10;

/// Spacings, both positive, of a grid at rest whose points, ghosts included, lie on an unrotated lattice up to round-off.
std::optional<Spacing> lattice_of(const grid::MovingGrid& grid) {
  if (grid.moves()) return std::nullopt;
  const ConstFieldView x = grid.x();
  const Layout& shape = grid.layout();
  const double dx = (x(0, shape.n1 - 1, 0) - x(0, 0, 0)) / (shape.n1 - 1);
  const double dy = (x(1, 0, shape.n2 - 1) - x(1, 0, 0)) / (shape.n2 - 1);
  if (!(dx > 0 && dy > 0)) return std::nullopt;  // turned by 180 degrees, it is a map like others
  const double farthest = std::max({std::fabs(x(0, 0, 0)), std::fabs(x(0, shape.n1 - 1, 0)),
                                    std::fabs(x(1, 0, 0)), std::fabs(x(1, 0, shape.n2 - 1))});
  const double tolerance = 1e-11 * (dx + dy) + 4 * std::numeric_limits<double>::epsilon() * farthest;
  for (int j = -Layout::ghosts; j < shape.n2 + Layout::ghosts; ++j) {
    for (int i = -Layout::ghosts; i < shape.n1 + Layout::ghosts; ++i) {
      if (std::fabs(x(0, i, j) - x(0, 0, 0) - i * dx) > tolerance ||
          std::fabs(x(1, i, j) - x(1, 0, 0) - j * dy) > tolerance) {
        return std::nullopt;
      }
    }
  }
  return Spacing{dx, dy};
}

AnyLimiter limiter_of(Limiter limiter) {
  switch (limiter) {
    case Limiter::none:
      return LimiterNone{};
    case Limiter::mc:
      return LimiterMc{};
    case Limiter::van_leer:
      return LimiterVanLeer{};
    case Limiter::minmod:
      return LimiterMinmod{};
  }
  std::abort();  // all are there
}

/// What to change in the case where density or pressure is lost.
std::string remedy_of(const Scheme& scheme) {
  if (std::holds_alternative<LimiterNone>(scheme.limiter)) return "fluid.scheme.limiter: minmod, for jumps";
  if (scheme.viscosity.shock == 0) return "fluid.scheme.shock_viscosity: 0.5";
  return "a smaller time.cfl";
}

}  // namespace

Component::Component(grid::MovingGrid grid, const GasOptions& options, std::array<Boundary, 4> boundaries)
    : grid_(std::move(grid)),
      boundaries_(std::move(boundaries)),
      spacing_(lattice_of(grid_)),
      scheme_{.gamma = options.gamma,
              .p_floor = 0,
              .riemann = riemann_named(options.riemann, {options.gamma, options.entropy_fix}),
              .limiter = limiter_of(options.limiter),
              .viscosity = {.shock = options.shock_viscosity, .linear = options.linear_diffusion}},
      state_(grid_.layout(), 4),
      next_(grid_.layout(), 4),
      workspace_(grid_.layout().n1, sweep_rows),
      row_rates_(static_cast<std::size_t>(grid_.layout().n2)) {
  const grid::RowSets all = grid::all_points(grid_.layout().n1, grid_.layout().n2);
  use_points(all, all);
  for (const Side side : all_sides) {
    WallMotion& wall = walls_[static_cast<std::size_t>(side)];
    wall = wall_at_rest(static_cast<std::size_t>(grid_.side_size(side)));
    measure_normals(wall, grid_.x(), SidePoints(grid_.layout(), side));
  }
}

void Component::use_points(const grid::RowSets& discretised, const grid::RowSets& valid) {
  if (discretised == discretised_ && valid == valid_) return;
  discretised_ = discretised;
  valid_ = valid;
  gather_runs();
  if (sparse_) find_live_points();
}

/// A ghost needs the side's points beside its own, for directions.
void Component::find_live_points() {
  constexpr int reach = 2;
  for (const Side side : all_sides) {
    const SidePoints points(grid_.layout(), side);
    std::vector<std::uint8_t>& live = live_[static_cast<std::size_t>(side)];
    live.assign(static_cast<std::size_t>(points.n()), 0);
    for (int k = 0; k < points.n(); ++k) {
      const auto [i, j] = points.at(k, 0);
      if (!valid_.contains(i, j)) continue;
      for (int b = std::max(k - reach, 0); b <= std::min(k + reach, points.n() - 1); ++b)
        live[static_cast<std::size_t>(b)] = 1;
    }
  }
}

void Component::gather_runs() {
  const int n2 = grid_.layout().n2;
  row_runs_.resize(static_cast<std::size_t>(n2));
  for (int j = 0; j < n2; ++j) {
    std::vector<Range>& row = row_runs_[static_cast<std::size_t>(j)];
    row.clear();
    for (const grid::Interval& run : discretised_.row(j)) row.push_back({run.begin, run.end});
  }
  runs_.assign(row_runs_, rows_.all ? Range{0, n2} : Range{rows_.own.first, rows_.own.end});
}

void Component::fill(const StateField& initial, double t) {
  const Layout& shape = grid_.layout();
  double p_most = 0;
  for (int j = -Layout::ghosts; j < shape.n2 + Layout::ghosts; ++j)
    p_most = std::max(p_most, fill_row(j, initial, t));
  scheme_.p_floor = floor_part * p_most;
  if (!sparse_) std::ranges::copy(state_.values(), next_.values().begin());
}

/// Fills a row with its ghosts; returns its largest pressure at valid points.
double Component::fill_row(int j, const StateField& initial, double t) {
  const ConstFieldView x = grid_.x();
  const Layout& shape = grid_.layout();
  const FieldView q = state_.view();
  StateVector last = {1, 0, 0, 1};  // a state that does no harm
  double p_most = 0;
  for (int i = -Layout::ghosts; i < shape.n1 + Layout::ghosts; ++i) {
    const int i_in = std::clamp(i, 0, shape.n1 - 1), j_in = std::clamp(j, 0, shape.n2 - 1);
    if (valid_.contains(i_in, j_in)) {
      const State s = initial(x(0, i, j), x(1, i, j), t);
      const bool inside = i == i_in && j == j_in;
      if (inside && !(s.rho > 0 && s.p > 0 && std::isfinite(s.rho + s.p + s.v1 + s.v2))) {
        throw UserMistake(fmt::format(
            "grid \"{}\": initial state at ({:.6g}, {:.6g}): rho = {:.3g}, v = ({:.3g}, {:.3g}), p = {:.3g}; "
            "density and pressure must be positive",
            grid_.name(), x(0, i, j), x(1, i, j), s.rho, s.v1, s.v2, s.p));
      }
      if (inside) p_most = std::max(p_most, s.p);
      last = to_vector(s);
    }
    store(q, {i, j}, last);
  }
  return p_most;
}

void Component::start(double t) {
  measure_rows();
  if (grid_.moves()) measure_initial_motion(t, 0.1 / fastest_points().point().rate);
}

void Component::measure_rows() {
  if (rates_need_neighbours()) return;  // they are looked for when somebody asks
  for (int j = 1; j < grid_.layout().n2 - 1; ++j) measure_row(j);
}

/// A grid that follows commands tells nothing about its future and starts as if at rest.
void Component::measure_initial_motion(double t, double delta) {
  std::array<std::array<std::vector<double>, 4>, 4> x;  // by side and level
  for (const std::size_t level : {3U, 2U, 1U, 0U}) {
    grid_.move(t + static_cast<double>(level) * delta);
    for (const Side side : all_sides) x[static_cast<std::size_t>(side)][level] = grid_.side_points(side);
  }
  for (std::size_t s = 0; s < 4; ++s) {
    start_motion(walls_[s], x[s], delta);
    prescribed_ = prescribed_ || x[s][0] != x[s][1];
  }
}

void Component::move(double t_new, double dt, std::span<const grid::SideCommand> commands) {
  moved_ = true;
  grid_.move(t_new, commands);
  const int order = prescribed_ ? 3 : last_dt_ > 0 ? 2 : 1;
  for (const Side side : all_sides) {
    WallMotion& wall = walls_[static_cast<std::size_t>(side)];
    const SidePoints points(grid_.layout(), side);
    advance_motion(wall, grid_.x(), grid_.x_old(), points, {dt, last_dt_, dt_before_, order});
    measure_normals(wall, grid_.x(), points);
  }
  dt_before_ = last_dt_;
  last_dt_ = dt;
}

void Component::force(const StateField& exact, const Forcing::Scales& scales) {
  forcing_.emplace(exact, scheme_.gamma, scales);
  source_ = Field(grid_.layout(), 4);
  has_source_ = false;
}

/// The second half of a step's source, at its end; kept for the next step, which begins with it.
void Component::add_source(double t, double dt) {
  forcing_->evaluate(grid_.x(), t, source_.view(), rows_);
  forcing_->add(source_.view(), 0.5 * dt, state_.view(), rows_);
  has_source_ = true;
}

/// Shocks are looked for at these points only, in the state that made them fall back.
void Component::count_fallbacks() {
  const ShockField field = shock_field();
  for (const PointIndex& point : fallbacks_) {
    counters_.first_order += 1;
    if (!sees_all(field, rows_, point.j)) {
      far_fallbacks_.push_back(point);
    } else if (!inside_shock(field, point.i, point.j)) {
      counters_.first_order_outside_shocks += 1;
    }
  }
  fallbacks_.clear();
}

ShockField Component::shock_field() const {
  return {.q = state_.view(), .valid = valid_, .periodic = {grid_.periodic(0), grid_.periodic(1)}};
}

SweepTask Component::sweep_task(const StepGrid& grid, double dt) {
  return {.q = state_.view(),
          .q_new = next_.view(),
          .grid = grid,
          .runs = runs_,
          .dt = dt,
          .guarded = {},
          .imposed = &imposed_};
}

SweepOutput Component::sweep_output() {
  return {workspace_, row_rates_, fallbacks_, {edges_[0], edges_[1], edges_[2], edges_[3]},
          &noted_,    edge_lines_};
}

SweptPoints Component::sweep(double t, double dt) {
  if (forcing_ && !swept_) {
    if (!has_source_) forcing_->evaluate(grid_.x_old(), t - dt, source_.view(), rows_);
    forcing_->add(source_.view(), 0.5 * dt, state_.view(), rows_);
  }
  swept_ = true;
  for (std::vector<double>& edge : edges_) std::ranges::fill(edge, 0.0);
  fallbacks_.clear();
  const StepGrid grid = step_grid();
  if (fluid::sweep(sweep_task(grid, dt), scheme_, sweep_output()) > 0) return SweptPoints::thin;
  const ShockField field = shock_field();
  const bool far = std::ranges::any_of(
      fallbacks_, [&](const PointIndex& point) { return !sees_all(field, rows_, point.j); });
  return far ? SweptPoints::to_be_judged : SweptPoints::sound;
}

void Component::end_step(SweptPoints worst, double t, double dt) {
  count_fallbacks();
  const bool thin = worst == SweptPoints::thin;
  if (worst != SweptPoints::sound) count_far_fallbacks();
  std::vector<int> changed_rows;
  const StepGrid grid = step_grid();
  if (thin) changed_rows = keep_positive(sweep_task(grid, dt), sweep_output());
  if (sparse_) forget_edges_of_others();
  std::swap(state_, next_);
  swept_ = false;
  advanced_ = true;
  counters_.steps += 1;
  if (thin) check_numbers(t);
  for (const int j : changed_rows) measure_row(j);
  if (forcing_) add_source(t, dt);
}

void Component::note_edges(int lines) {
  edge_lines_ = lines;
  for (const Side side : all_sides)
    edges_[static_cast<std::size_t>(side)].assign(4 * static_cast<std::size_t>(grid_.side_size(side)), 0.0);
}

/// Of a level, what passes the faces before points that another level advances is that one's to say.
void Component::forget_edges_of_others() {
  for (const Side side : all_sides) {
    std::vector<double>& edge = edges_[static_cast<std::size_t>(side)];
    const SidePoints points(grid_.layout(), side);
    const auto n = static_cast<std::size_t>(points.n());
    const auto crossed = [n](std::span<const double> values, std::size_t point) {
      for (std::size_t k = point; k < values.size(); k += n) {
        if (values[k] != 0) return true;
      }
      return false;
    };
    for (std::size_t point = 0; point < n; ++point) {
      if (!crossed(edge, point)) continue;
      const auto [i, j] = points.at(static_cast<int>(point), edge_lines_ + 1);
      if (discretised_.contains(i, j)) continue;
      for (std::size_t k = point; k < edge.size(); k += n) edge[k] = 0;
    }
  }
}

std::vector<int> Component::keep_positive(const SweepTask& task, const SweepOutput& output) {
  std::array<Beyond, 4> beyond{};
  for (const Side side : all_sides) beyond[static_cast<std::size_t>(side)] = facts(side).beyond;
  Positivity done = fluid::keep_positive(task, scheme_, {output, beyond, *rows_.ranks});
  counters_.positive_fluxes += static_cast<double>(done.thin.size());
  counters_.floors += static_cast<double>(done.floors);
  return std::move(done.rows);
}

void Component::check_numbers(double t) const {
  const Layout& shape = grid_.layout();
  const ConstFieldView q = state_.view(), x = grid_.x();
  std::vector<double> broken;  // the first point that is: i, j, rho, p
  for (int j = 0; j < shape.n2 && broken.empty(); ++j) {
    for (int i = 0; rows_.owns(j) && i < shape.n1 && broken.empty(); ++i) {
      const double rho = q(0, i, j), p = q(3, i, j);
      if ((rho > 0 && std::fabs(p) < 1e300) || !discretised_.contains(i, j)) continue;
      broken = {static_cast<double>(i), static_cast<double>(j), rho, p};
    }
  }
  const std::vector<double> of_all = rows_.ranks->together(broken);  // in the order of rows
  if (of_all.empty()) return;
  const auto i = static_cast<int>(of_all[0]), j = static_cast<int>(of_all[1]);
  throw Diverged(fmt::format("rho = {:.3g}, p = {:.3g}; try {}", of_all[2], of_all[3], remedy_of(scheme_)),
                 {.t = t, .grid = grid_.name(), .point = {i, j}, .position = {x(0, i, j), x(1, i, j)}});
}

}  // namespace fsi::fluid
