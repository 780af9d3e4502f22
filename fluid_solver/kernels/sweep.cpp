#include "fluid_solver/kernels/sweep.hpp"

#include <algorithm>
#include <utility>

#include "fluid_solver/kernels/rates.hpp"
#include "fluid_solver/kernels/riemann/riemann_split.hpp"

namespace fsi::fluid {

namespace {

/// Hands out rows of the workspace in turn.
class Rows {
 public:
  explicit Rows(Workspace& work) : work_(work) {}
  double* next() { return work_.row(next_++); }
  StateRow<double> state() { return {next(), next(), next(), next()}; }
  FluxRow flux() { return {next(), next(), next(), next()}; }
  CornerRow corners() { return {next(), next(), next(), next()}; }
  FaceRow faces() { return {next(), next(), next(), next()}; }
  MetricRow metric() { return {next(), next(), next(), next(), next(), next(), next()}; }

 private:
  Workspace& work_;
  int next_ = 0;
};

double sum(const double* values, Range range) {
  double total = 0;
#pragma omp simd reduction(+ : total)
  for (int i = range.first; i < range.last; ++i) total += values[i];
  return total;
}

/// Columns swept together, about: the scratch rows of so many points stay in the second-level cache.
constexpr int block = 512;

/// The rows of a sweep over columns first <= i < last, and what it does with them.
template <class Limiter, class Riemann, bool mapped>
class Sweep {
 public:
  Sweep(const SweepTask& task, const Scheme& scheme, const Riemann& solve, const SweepOutput& output,
        Range columns)
      : task_(task),
        scheme_(scheme),
        solve_(solve),
        rows_(output.work),
        row_rates_(output.row_rates),
        fallbacks_(output.fallbacks),
        edges_(output.edges),
        noted_(output.noted),
        edge_lines_(output.edge_lines),
        viscous_(scheme.viscosity.any()),
        columns_(columns) {}

  double run() {
    const int n2 = task_.q.layout.n2;
    for (int r = -1; r <= n2; ++r) {
      fetch(r + 2);
      each(task_.runs.predicted(r), 1, [&](Range run) { predict(r, run); });
      if (r > -1) each(task_.runs.between(r), 0, [&](Range run) { flux_between(r, run); });
      if (r > 0) each(task_.runs.advanced(r - 1), 0, [&](Range run) { update(r - 1, run); });
      if (r == n2) break;
      if constexpr (mapped) next_corners(r);
      if (r > -1) each(task_.runs.advanced(r), 0, [&](Range run) { flux_along(r, run); });
      std::swap(predicted_.upper, upper_before_);
      std::swap(kappa_, kappa_before_);
      std::swap(conserved_, conserved_before_);
      std::swap(lower_, upper_);
    }
    return thin_;
  }

 private:
  const SweepTask& task_;
  const Scheme& scheme_;
  Riemann solve_;
  Rows rows_;
  std::span<double> row_rates_;
  std::vector<PointIndex>& fallbacks_;
  EdgeFluxes edges_;
  FaceFluxes* noted_;
  int edge_lines_;
  bool viscous_;
  Range columns_;
  PredictedRows predicted_{rows_.state(), rows_.state(), rows_.state(), rows_.state(), rows_.next()};
  StateRow<double> upper_before_ = rows_.state();  ///< of row r - 1
  FluxRow along_ = rows_.flux(), lower_ = rows_.flux(), upper_ = rows_.flux();
  MetricRow metric_ = rows_.metric();
  CornerRow below_ = rows_.corners(), above_ = rows_.corners();  ///< between rows r - 2, r - 1 and r - 1, r
  FaceRow face_ = rows_.faces();
  double *volume_old_ = rows_.next(), *volume_ = rows_.next();
  double *kappa_ = rows_.next(), *kappa_before_ = rows_.next();
  ConservedRow conserved_ = rows_.flux(), conserved_before_ = rows_.flux();
  double* rate_ = rows_.next();
  double thin_ = 0;

  /// The parts of runs that lie in the columns or `reach` beyond.
  template <class Action>
  void each(std::span<const Range> runs, int reach, const Action& action) const {
    for (const Range& run : runs) {
      const Range part{std::max(run.first, columns_.first - reach),
                       std::min(run.last, columns_.last + reach)};
      if (part.first < part.last) action(part);
    }
  }

  /// Asks early for the states that short runs of a row will read: unlike those of long ones, no processor
  /// foresees them.
  void fetch(int r) const {
    constexpr int long_run = 256, line = 8;  // points
    if (r > task_.q.layout.n2) return;
    each(task_.runs.predicted(r), 1, [&](Range run) {
      if (run.last - run.first > long_run) return;
      for (int plane = 0; plane < 4; ++plane) {
        const double *read = task_.q.row(plane, std::min(r + 1, task_.q.layout.n2 + 1)),
                     *written = task_.q_new.row(plane, r);
        for (int i = run.first; i < run.last + line; i += line) {
          __builtin_prefetch(read + i);
          __builtin_prefetch(written + i, 1);
        }
      }
    });
  }

  auto metric() const {
    if constexpr (mapped) {
      return MappedMetric{metric_};
    } else {
      return CartesianMetric{task_.dt / task_.grid.cartesian->dx, task_.dt / task_.grid.cartesian->dy};
    }
  }

  void predict(int r, Range run) {
    if constexpr (mapped) {
      metric_row(PointRows(task_.grid.x_old, r), PointRows(task_.grid.x, r), task_.dt, metric_, run);
    }
    const StateRows states(task_.q, r);
    predict_row<Limiter>(states, metric(), scheme_.gamma, predicted_, run);
    if (!viscous_) return;
    viscosity_row(states, metric(), scheme_.viscosity, task_.dt, kappa_, run);
    conserved_row(states.here, scheme_.gamma, conserved_, run);
  }

  /// Corners between rows r and r + 1 become those above.
  void next_corners(int r) {
    std::swap(below_, above_);
    const StepGrid& grid = task_.grid;
    each(task_.runs.between(r + 1), 0, [&](Range run) {
      const Range corners{run.first - 1, run.last};
      corner_row(PointRow(grid.x_old, r), PointRow(grid.x_old, r + 1), above_.x_old, above_.y_old, corners);
      corner_row(PointRow(grid.x, r), PointRow(grid.x, r + 1), above_.x, above_.y, corners);
    });
  }

  /// Fluxes between the row before and the one just predicted.
  void flux_between(int r, Range run) {
    if constexpr (mapped) {
      face_row_2(above_, task_.dt, face_, run);
      flux_row(upper_before_, predicted_.lower, solve_, face_, upper_, run);
    } else {
      flux_row(upper_before_.exchanged(), predicted_.lower.exchanged(), solve_, metric().dt_dy,
               upper_.exchanged(), run);
    }
    if (viscous_) add_viscous_flux_row({conserved_before_, conserved_, kappa_before_, kappa_}, upper_, run);
    if (!task_.guarded.empty()) guard_between(r, run);
    if (task_.imposed != nullptr) impose(task_.imposed->between, r, run, upper_);
    if (noted_ != nullptr) fluid::note(noted_->between, r, run, upper_);
    if (r == 1 + edge_lines_) note_between(edges_[2], run);
    if (r == task_.q.layout.n2 - 1 - edge_lines_) note_between(edges_[3], run);
  }

  void note_between(std::span<double> edge, Range run) const {
    if (edge.empty()) return;
    const auto n = static_cast<std::size_t>(task_.q.layout.n1);
    for (auto i = static_cast<std::size_t>(std::max(run.first, 0));
         i < std::min<std::size_t>(n, static_cast<std::size_t>(run.last)); ++i)
      note(edge, {n, i}, upper_.shifted(static_cast<int>(i)));
  }

  void note_along(int r, Range faces) const {
    const auto n = static_cast<std::size_t>(task_.q.layout.n2), row = static_cast<std::size_t>(r);
    for (const int k : {0, 1}) {
      const int face = k == 0 ? edge_lines_ : task_.q.layout.n1 - 2 - edge_lines_;
      const std::span<double> edge = edges_[static_cast<std::size_t>(k)];
      if (!edge.empty() && face >= faces.first && face < faces.last)
        note(edge, {n, row}, along_.shifted(face));
    }
  }

  /// Point `at` of the n points of a side.
  struct Edge {
    std::size_t n, at;
  };
  static void note(std::span<double> edge, Edge point, FluxRow flux) {
    const auto [n, at] = point;
    edge[at] = *flux.mass;
    edge[n + at] = *flux.momentum1;
    edge[2 * n + at] = *flux.momentum2;
    edge[3 * n + at] = *flux.energy;
  }

  /// Fluxes through the faces along that row on both sides of the points of a run.
  void flux_along(int r, Range run) {
    if (sum(predicted_.first_order, run) > 0) list_fallbacks(r, run);
    const Range faces{run.first - 1, run.last};
    const StateRow<const double> after = predicted_.left;
    if constexpr (mapped) {
      face_row_1(below_, above_, task_.dt, face_, faces);
      flux_row(predicted_.right, after.shifted(1), solve_, face_, along_, faces);
    } else {
      flux_row(predicted_.right, after.shifted(1), solve_, metric().dt_dx, along_, faces);
    }
    if (viscous_)
      add_viscous_flux_row({conserved_, conserved_.shifted(1), kappa_, kappa_ + 1}, along_, faces);
    if (!task_.guarded.empty()) guard_along(r, faces);
    if (task_.imposed != nullptr) impose(task_.imposed->along, r, faces, along_);
    if (noted_ != nullptr) fluid::note(noted_->along, r, faces, along_);
    note_along(r, faces);
  }

  bool guarded(int i, int j) const { return std::ranges::binary_search(task_.guarded, PointIndex{i, j}); }

  /// First-order fluxes on the faces of guarded points.
  void guard_between(int r, Range run) {
    const StateRow<const double> before(task_.q, r - 1), after(task_.q, r);
    const RiemannSplit split{scheme_.gamma};
    for (int i = run.first; i < run.last; ++i) {
      if (!guarded(i, r - 1) && !guarded(i, r)) continue;
      const Range face{i, i + 1};
      if constexpr (mapped) {
        flux_row(before, after, split, face_, upper_, face);
      } else {
        flux_row(before.exchanged(), after.exchanged(), split, metric().dt_dy, upper_.exchanged(), face);
      }
    }
  }

  void guard_along(int r, Range faces) {
    const StateRow<const double> before(task_.q, r);
    const RiemannSplit split{scheme_.gamma};
    for (int i = faces.first; i < faces.last; ++i) {
      if (!guarded(i, r) && !guarded(i + 1, r)) continue;
      const Range face{i, i + 1};
      if constexpr (mapped) {
        flux_row(before, before.shifted(1), split, face_, along_, face);
      } else {
        flux_row(before, before.shifted(1), split, metric().dt_dx, along_, face);
      }
    }
  }

  void list_fallbacks(int r, Range run) {
    for (int i = run.first; i < run.last; ++i) {
      if (predicted_.first_order[i] > 0) fallbacks_.push_back({i, r});
    }
  }

  void update(int r, Range run) {
    if constexpr (mapped) volume_row(below_, above_, volume_old_, volume_, run);
    thin_ += update_row<mapped>(StateRow<const double>(task_.q, r), {along_, lower_, upper_},
                                {volume_old_, volume_}, {scheme_.gamma, scheme_.p_floor},
                                StateRow<double>(task_.q_new, r), run);
    if (viscous_ || row_rates_.empty() || r == 0 || r == task_.q.layout.n2 - 1) return;
    const Range inner{std::max(run.first, 1), std::min(run.last, task_.q.layout.n1 - 1)};
    if (inner.first >= inner.last) return;
    step_rate_row(task_.q_new, task_.grid, task_.dt, scheme_, r, rate_, inner);
    double& most = row_rates_[static_cast<std::size_t>(r)];
    most = std::max(most, largest(rate_, inner));
  }
};

}  // namespace

double sweep(const SweepTask& task, const Scheme& scheme, const SweepOutput& output) {
  std::ranges::fill(output.row_rates, 0.0);
  return std::visit(
      [&]<class Riemann, class Limiter>(const Riemann& solve, const Limiter&) {
        double thin = 0;
        // Short runs use no more scratch memory anyway, and blocks would cut some of them.
        const bool short_runs = task.runs.longest() <= block;
        const int n1 = task.q.layout.n1, blocks = short_runs ? 1 : std::max(1, (n1 + block / 2) / block),
                  width = (n1 / blocks + 8) / 8 * 8;
        for (int first = 0; first < n1; first += width) {
          const Range columns{first, std::min(first + width, n1)};
          thin += task.grid.cartesian
                      ? Sweep<Limiter, Riemann, false>(task, scheme, solve, output, columns).run()
                      : Sweep<Limiter, Riemann, true>(task, scheme, solve, output, columns).run();
        }
        return thin;
      },
      scheme.riemann, scheme.limiter);
}

}  // namespace fsi::fluid
