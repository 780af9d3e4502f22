#pragma once
/// The solid on one component grid: its fields, their update and their boundary conditions. A domain is a
/// list of these; what couples them (interpolation between grids) belongs to the owner of the list. Unused
/// points of a composite grid stay at zero; interpolated ones are not advanced.

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "common/grid/moving_grid.hpp"
#include "common/ranks/rows/rank_rows.hpp"
#include "solid_solver/boundary/solid_boundary.hpp"
#include "solid_solver/kernels/sweep/dissipation.hpp"
#include "solid_solver/kernels/sweep/godunov_sweep.hpp"
#include "solid_solver/solid_part.hpp"
#include "solid_solver/solid_points.hpp"

namespace fsi::solid {

template <Law L>
class SolidComponent {
 public:
  /// `index`: of the grid among those of the body.
  SolidComponent(SolidPart part, int index, SolidPoints points, const L& law, const SolidOptions& options);
  SolidComponent(const SolidComponent&) = delete;
  SolidComponent& operator=(const SolidComponent&) = delete;

  const grid::MovingGrid& grid() const { return grid_; }
  const ReferenceMetrics& metrics() const { return metrics_; }
  const SolidPoints& points() const { return points_; }
  const SolidBoundary<L>& boundary() const { return boundary_; }
  Layout layout() const { return q_.layout(); }
  ConstFieldView q() const { return q_.view(); }
  FieldView q() { return q_.view(); }

  void assign(const StateFunction& state, double t);
  /// P := P(F(u)) at discretised points, F by central differences with one-sided ends.
  void assign_stress();
  void set_body_force(VectorFunction force);
  void choose(const ChosenSolution& solution);
  /// Null where there is none.
  const ChosenSolution* chosen() const { return chosen_ ? &*chosen_ : nullptr; }
  /// Paper eq. (35) to paper eq. (41) beside the present state, which gets half of the step's source of a
  /// chosen solution. Points that broke are counted in `measured`.
  void predict(double t, double dt, Look look);
  /// The present state without that half of the source (to round-off), when a grid of the body broke.
  void give_back();
  /// What was predicted becomes the state at t + dt, boundary conditions not applied.
  void complete(double t, double dt);
  void apply_boundary(double t, std::span<const InterfaceValues> projected) {
    boundary_.apply(q_.view(), t, projected);
  }
  /// Ghost points beside interpolated points, after these have new values.
  void refresh_ghosts(double t) { boundary_.refresh_ghosts(q_.view(), t); }
  /// Wave speeds and health of the present state.
  void measure() { measured_ = sweep(0.0, Look::all); }
  /// Of the last sweep; the waves are those of the last one that looked at them.
  const SweepResult& measured() const { return measured_; }
  /// Ghost points of all steps so far that took the acoustic matrix of the body beside them.
  double settled() const { return settled_; }
  /// Side points of all steps so far that kept their prediction, since the body carries no waves there.
  double waveless() const { return boundary_.waveless(); }
  /// F at a point by central differences of u inside, one-sided
  /// ones of second order at the sides (no ghost points).
  Tensor2 deformation_gradient(int i, int j) const;
  /// Everything the next steps depend on.
  void archive(Archive& archive);
  /// The first point that broke: "point (14, 3): det F = -0.02"; nothing where all are well.
  std::optional<Diverged> breakdown(double dt) const;

  // Where several ranks share the body: those rows of it that this one has to do with.

  /// `beside`: rows around its own that it may read and set conditions in.
  void take_rows(RankRows rows);
  const RankRows& rows() const { return rows_; }
  /// What the step of a rank found; in its place comes what all have found.
  SweepResult& measured() { return measured_; }
  /// Fields of which a rank has its rows only, in an order that all grids have.
  std::vector<FieldView> scattered_fields();
  /// Conditions on the sides, of which a rank knows those in its rows.
  SolidBoundary<L>& boundary() { return boundary_; }
  void set_settled(double settled) { settled_ = settled; }
  void set_waveless(double waveless) { boundary_.set_waveless(waveless); }

 private:
  std::string breakdown_at(int i, int j, double dt) const;
  SweepResult sweep(double dt, Look look);
  template <class Row, class Gradient>
  SweepResult sweep_with(double dt, Look look);
  template <class Row, class Gradient, class Sweep>
  SweepResult run_sweep(const Sweep& sweep, double dt);
  template <class Row, class Gradient>
  void dissipate(const DissipationBetas& betas, double dt, RowRun run);
  void diffuse(double dt, RowRun run);
  void evaluate_force(double t);
  void evaluate_source(double t);
  void add_source(double weight);
  void add_relaxation_offset(double t, double dt);
  void keep_tractions(double t, double dt);

  grid::MovingGrid grid_;
  SolidPoints points_;
  L law_;
  SolidOptions options_;
  ReferenceMetrics metrics_;
  SolidBoundary<L> boundary_;
  RankRows rows_;
  Field q_, next_, work_, force_;
  VectorFunction body_force_;
  std::optional<ChosenSolution> chosen_;
  Field source_;             ///< of the chosen solution, at the time of the state
  bool has_source_ = false;  ///< it was evaluated
  double added_ = 0;         ///< weight of the source in the present state while a step is under way
  SweepResult measured_;
  double settled_ = 0;
};

template <Law L>
SolidComponent<L>::SolidComponent(SolidPart part, int index, SolidPoints points, const L& law,
                                  const SolidOptions& options)
    : grid_(std::move(part.grid)),
      points_(std::move(points)),
      law_(law),
      options_(options),
      metrics_(grid_.x()),
      boundary_(
          {.name = grid_.name(), .index = index, .x = grid_.x(), .metrics = &metrics_, .points = &points_},
          law_, options_.rho, std::move(part.boundaries), options_.limiter,
          1.0 / (metrics_.largest_rate(grid_.layout()) *
                 std::sqrt((law_.lambda + 2.0 * law_.mu) / options_.rho))),
      q_(grid_.layout(), plane::count),
      next_(grid_.layout(), plane::count),
      work_(sweep_work, 1) {}

template <Law L>
void SolidComponent<L>::assign(const StateFunction& state, double t) {
  const ConstFieldView x = grid_.x();
  for (int j = 0; j < layout().n2; ++j) {
    for (const auto& [begin, end] : points_.valid(j)) {
      for (int i = begin; i < end; ++i) {
        store(q_.view(), layout().at(i, j), state(x(0, i, j), x(1, i, j), t));
      }
    }
  }
}

template <Law L>
void SolidComponent<L>::assign_stress() {
  for (int j = 0; j < layout().n2; ++j) {
    for (const auto& [begin, end] : points_.discretised(j)) {
      for (int i = begin; i < end; ++i) {
        SolidState s = load(q_.view(), layout().at(i, j));
        s.P = law_.P(deformation_gradient(i, j));
        store(q_.view(), layout().at(i, j), s);
      }
    }
  }
}

template <Law L>
void SolidComponent<L>::set_body_force(VectorFunction force) {
  body_force_ = std::move(force);
  force_ = body_force_ ? Field(layout(), 2) : Field();
}

/// Where the prediction needs it; at ghost points, where a formula may have no value, that of the point beside them.
template <Law L>
void SolidComponent<L>::evaluate_force(double t) {
  if (!body_force_) return;
  const ConstFieldView x = grid_.x();
  const auto force_at = [&](int i, int j) -> Vec2 { return body_force_(x(0, i, j), x(1, i, j), t); };
  const auto evaluate = [&](int j, const grid::Interval& run) {
    for (int i = run.begin; i < run.end; ++i) {
      Vec2 force = force_at(i, j);
      if (!force.allFinite())
        force = force_at(std::clamp(i, 0, layout().n1 - 1), std::clamp(j, 0, layout().n2 - 1));
      force_(0, i, j) = force.x();
      force_(1, i, j) = force.y();
    }
  };
  for (int j = -1; j <= layout().n2; ++j) {
    if (!rows_.has(j)) continue;
    for (const grid::Interval& run : points_.beside(j)) evaluate(j, run);
    if (j < 0 || j == layout().n2) continue;
    for (const grid::Interval& run : points_.discretised(j)) evaluate(j, run);
  }
}

template <Law L>
void SolidComponent<L>::choose(const ChosenSolution& solution) {
  chosen_ = solution;
  boundary_.choose(&*chosen_);
  source_ = Field(layout(), plane::count);
  has_source_ = false;
}

/// At points that have a value and at their ghosts.
template <Law L>
void SolidComponent<L>::evaluate_source(double t) {
  constexpr int g = Layout::ghosts;
  const ConstFieldView x = grid_.x();
  for (int j = -g; j < layout().n2 + g; ++j) {
    if (!rows_.has(j)) continue;
    for (int i = -g; i < layout().n1 + g; ++i) {
      if (!points_.is_valid(std::clamp(i, 0, layout().n1 - 1), std::clamp(j, 0, layout().n2 - 1))) continue;
      store(source_.view(), layout().at(i, j), chosen_->source(x(0, i, j), x(1, i, j), t));
    }
  }
  has_source_ = true;
}

template <Law L>
void SolidComponent<L>::add_source(double weight) {
  std::span<double> q = q_.values();
  const std::span<const double> source = source_.values();
  for (std::size_t k = 0; k < q.size(); ++k) q[k] += weight * source[k];
}

/// Paper eq. (41) then pulls P towards P(F(u)) + offset. The state it sees is at t with half of the step's
/// source, and so is the difference of its P to P(F): the offset is taken at half time.
template <Law L>
void SolidComponent<L>::add_relaxation_offset(double t, double dt) {
  const double beta = options_.relaxation.at(dt);
  if (beta == 0) return;
  const ConstFieldView x = grid_.x();
  for (int j = 0; j < layout().n2; ++j) {
    if (!rows_.owns(j)) continue;
    for (const auto& [begin, end] : points_.discretised(j)) {
      for (int i = begin; i < end; ++i) {
        const std::ptrdiff_t at = layout().at(i, j);
        const SolidState offset = {
            .u = Vec2::Zero(), .v = Vec2::Zero(), .P = chosen_->offset(x(0, i, j), x(1, i, j), t)};
        store(next_.view(), at, sum_of(load(next_.view(), at), beta, offset));
      }
    }
  }
}

/// Of loaded sides, where paper eq. (41) must not change them.
template <Law L>
void SolidComponent<L>::keep_tractions(double t, double dt) {
  const double beta = options_.relaxation.at(dt), half = t + 0.5 * dt;
  if (beta == 0) return;
  if (metrics_.cartesian()) {
    boundary_.template correct_relaxation<CartesianGradient4>(q_.view(), next_.view(), beta, half);
  } else {
    boundary_.template correct_relaxation<MappedGradient4>(q_.view(), next_.view(), beta, half);
  }
}

template <Law L>
template <class Row, class Gradient>
SweepResult SolidComponent<L>::sweep_with(double dt, Look look) {
  const SweepData data = {
      .points = &points_,
      .q = q_.view(),
      .next = next_.view(),
      .force = force_.view(),
      .work = work_.view(),
      .rho = options_.rho,
      .dt = dt,
      .look = look,
      .measures_spread = options_.relaxation.active() || options_.tangential_stress.active(),
      .coupling_limit = coupling_limit(options_.relaxation.at(dt)),
      .softened = measured_.coupled > 0,
      .loaded = boundary_.sides().loaded(),
      .rows = rows_.all ? grid::RowRange{0, layout().n2} : rows_.own};
  if (options_.limiter == Limiter::minmod)
    return run_sweep<Row, Gradient>(GodunovSweep<L, Row, Limiter::minmod>(data, metrics_, law_), dt);
  if (options_.limiter == Limiter::mc)
    return run_sweep<Row, Gradient>(GodunovSweep<L, Row, Limiter::mc>(data, metrics_, law_), dt);
  return run_sweep<Row, Gradient>(GodunovSweep<L, Row, Limiter::none>(data, metrics_, law_), dt);
}

/// With dissipation and relaxation: what most solids have of them is one with the sweep, the rest acts on runs of points
/// whose step was made, while their rows are in cache.
template <Law L>
template <class Row, class Gradient, class Sweep>
SweepResult SolidComponent<L>::run_sweep(const Sweep& sweep, double dt) {
  const DissipationBetas betas = {.P = options_.tangential_stress.at(dt),
                                  .u = options_.displacement.at(dt),
                                  .r = options_.relaxation.at(dt)};
  if (betas.P == 0 || betas.u == 0 || betas.r == 0) {
    return sweep.run([](int) { return NoTerms(); },
                     [&](RowRun run) { dissipate<Row, Gradient>(betas, dt, run); });
  }
  const auto all = [&](int j) {
    return AllDissipation(ConstFieldView(q_.view()), Row(metrics_, j), Gradient(grid_.x(), metrics_, j), law_,
                          betas, j);
  };
  return sweep.run(all, [&](RowRun run) { diffuse(dt, run); });
}

template <Law L>
SweepResult SolidComponent<L>::sweep(double dt, Look look) {
  return metrics_.cartesian() ? sweep_with<CartesianRow, CartesianGradient4>(dt, look)
                              : sweep_with<MappedRow, MappedGradient4>(dt, look);
}

template <Law L>
template <class Row, class Gradient>
void SolidComponent<L>::dissipate(const DissipationBetas& betas, double dt, RowRun run) {
  const ConstFieldView q = q_.view();
  const FieldView next = next_.view();
  if (betas.P != 0) add_tangential_stress_dissipation<Row>(q, next, metrics_, betas.P, run);
  const Gradient gradient(grid_.x(), metrics_, run.j);
  if (betas.u != 0) add_displacement_dissipation(q, next, gradient, betas.u, run);
  if (betas.r != 0) add_relaxation(q, next, gradient, law_, betas.r, run);
  diffuse(dt, run);
}

template <Law L>
void SolidComponent<L>::diffuse(double dt, RowRun run) {
  const double bulk = options_.bulk_diffusion * dt;
  if (bulk != 0) add_bulk_diffusion(q_.view(), next_.view(), bulk, run);
}

template <Law L>
void SolidComponent<L>::predict(double t, double dt, Look look) {
  evaluate_force(t + 0.5 * dt);
  if (chosen_) {
    if (!has_source_) evaluate_source(t);
    added_ = 0.5 * dt;
    add_source(added_);
  }
  SweepResult met = sweep(dt, look);
  settled_ += met.settled;
  if (look == Look::soundness) {
    met.rate_squared = measured_.rate_squared;
    met.spread_squared = measured_.spread_squared;
    met.coupled = measured_.coupled;
    met.min_phi_s = measured_.min_phi_s;
  }
  measured_ = met;
}

template <Law L>
void SolidComponent<L>::give_back() {
  if (added_ != 0) add_source(-added_);
  added_ = 0;
}

template <Law L>
void SolidComponent<L>::complete(double t, double dt) {
  const double beta_u = options_.displacement.at(dt);
  if (beta_u != 0) correct_displacement_dissipation(boundary_.sides(), q_.view(), next_.view(), beta_u);
  if (chosen_) add_relaxation_offset(t + 0.5 * dt, dt);
  keep_tractions(t, dt);
  std::swap(q_, next_);
  added_ = 0;
  if (!chosen_) return;
  evaluate_source(t + dt);
  add_source(0.5 * dt);
}

template <Law L>
Tensor2 SolidComponent<L>::deformation_gradient(int i, int j) const {
  const ConstFieldView q = q_.view();
  const std::ptrdiff_t here = layout().at(i, j);
  const auto difference = [&](int k, int direction) {
    const int at = direction == 0 ? i : j, n = direction == 0 ? layout().n1 : layout().n2;
    const std::ptrdiff_t step = direction == 0 ? 1 : layout().stride;
    const double* values = q.plane(k) + here;
    const auto value = [=](int m) { return values[(m - at) * step]; };
    if (grid_.periodic(direction) && (at == 0 || at == n - 1)) return 0.5 * (value(1) - value(n - 2));
    if (at == 0) return 0.5 * (4.0 * (value(1) - value(0)) - (value(2) - value(0)));
    if (at == n - 1) return -0.5 * (4.0 * (value(n - 2) - value(n - 1)) - (value(n - 3) - value(n - 1)));
    return 0.5 * (value(at + 1) - value(at - 1));
  };
  const PointMetrics m = metrics_.at(i, j);
  Tensor2 F = {1.0, 0.0, 0.0, 1.0};
  F = plus_dyad(F, {difference(plane::u1, 0), difference(plane::u2, 0)}, m.r1);
  return plus_dyad(F, {difference(plane::u1, 1), difference(plane::u2, 1)}, m.r2);
}

template <Law L>
void SolidComponent<L>::archive(Archive& archive) {
  archive.values("state", q_.values());
  archive.values("next", next_.values());
  archive.number("rate_squared", measured_.rate_squared);
  archive.number("spread_squared", measured_.spread_squared);
  archive.number("coupled", measured_.coupled);
  archive.number("min_det_F", measured_.min_det_F);
  archive.number("min_phi_s", measured_.min_phi_s);
  archive.number("settled", settled_);
  archive.inside("boundary", [&] { boundary_.archive(archive); });
  if (!chosen_) return;
  archive.values("source", source_.values());
  archive.number("has_source", has_source_);
}

}  // namespace fsi::solid
