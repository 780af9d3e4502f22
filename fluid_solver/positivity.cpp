#include "fluid_solver/positivity.hpp"

#include <algorithm>
#include <cmath>

namespace fsi::fluid {

namespace {

bool is_thin(const SweepTask& task, double p_floor, PointIndex point) {
  const auto [i, j] = point;
  const double rho = task.q_new(0, i, j), p = task.q_new(3, i, j);
  return !(rho > thin_part * task.q(0, i, j) && p > std::max(thin_part * task.q(3, i, j), p_floor) &&
           p < 1e300);
}

class Thinness {
 public:
  Thinness(const SweepTask& task, const Scheme& scheme, const PositivityTask& positive)
      : task_(task),
        scheme_(scheme),
        output_(positive.output),
        beyond_(positive.beyond),
        ranks_(positive.ranks) {}

  Positivity treat() {
    SweepRuns runs = task_.runs;
    while (find_thin(runs)) {
      runs = around_thin();
      const SweepTask again{.q = task_.q,
                            .q_new = task_.q_new,
                            .grid = task_.grid,
                            .runs = runs,
                            .dt = task_.dt,
                            .guarded = guarded_,
                            .imposed = task_.imposed};
      sweep(again, scheme_, {output_.work, {}, unused_, output_.edges, output_.noted, output_.edge_lines});
    }
    lift();
    for (int j = 0; j < runs.rows(); ++j) {
      if (!runs.advanced(j).empty()) result_.rows.push_back(j);
    }
    return std::move(result_);
  }

 private:
  const SweepTask& task_;
  const Scheme& scheme_;
  const SweepOutput& output_;
  const std::array<Beyond, 4>& beyond_;
  Ranks& ranks_;
  std::vector<PointIndex> guarded_;  ///< thin points and their images, sorted
  std::vector<PointIndex> unused_;   ///< fallbacks of the second sweep: counted in the first
  Positivity result_;

  int n1() const { return task_.q.layout.n1; }
  int n2() const { return task_.q.layout.n2; }

  /// Adds the thin points of some runs; true if there were new ones, of whatever rank.
  bool find_thin(const SweepRuns& runs) {
    const std::size_t before = result_.thin.size();
    for (int j = 0; j < runs.rows(); ++j) {
      for (const Range& run : runs.advanced(j)) {
        for (int i = run.first; i < run.last; ++i) {
          const PointIndex point{i, j};
          if (!is_thin(task_, scheme_.p_floor, point)) continue;
          if (std::ranges::binary_search(guarded_, point)) continue;
          result_.thin.push_back(point);
        }
      }
    }
    std::vector<double> mine;
    for (std::size_t k = before; k < result_.thin.size(); ++k)
      mine.insert(mine.end(),
                  {static_cast<double>(result_.thin[k].i), static_cast<double>(result_.thin[k].j)});
    const std::vector<double> found = ranks_.together(mine);
    if (found.empty()) return false;
    for (std::size_t k = 0; k < found.size(); k += 2)
      add_images({static_cast<int>(found[k]), static_cast<int>(found[k + 1])});
    std::ranges::sort(guarded_);
    const auto doubles = std::ranges::unique(guarded_);
    guarded_.erase(doubles.begin(), doubles.end());
    return true;
  }

  /// The point and where it is seen again: in the next period, or behind a mirror.
  void add_images(const PointIndex& point) {
    for (const int i : images(point.i, n1(), beyond_[0], beyond_[1])) {
      for (const int j : images(point.j, n2(), beyond_[2], beyond_[3])) guarded_.push_back({i, j});
    }
  }

  /// Ghost lines next to the grid only: fluxes further out are not asked for.
  static std::vector<int> images(int k, int n, Beyond lower, Beyond upper) {
    std::vector<int> all{k};
    if (lower == Beyond::mirror && k == 1) all.push_back(-1);
    if (upper == Beyond::mirror && k == n - 2) all.push_back(n);
    if (lower != Beyond::period) return all;
    if (k <= 1) all.push_back(k + n - 1);
    if (k >= n - 2) all.push_back(k - n + 1);
    return all;
  }

  /// Here and elsewhere, the advanced ones among the guarded points and their neighbours.
  SweepRuns around_thin() const {
    std::vector<std::vector<Range>> rows(static_cast<std::size_t>(n2()));
    for (const auto& [i, j] : guarded_) {
      for (const PointIndex& point : {PointIndex{i, j}, PointIndex{i - 1, j}, PointIndex{i + 1, j},
                                      PointIndex{i, j - 1}, PointIndex{i, j + 1}}) {
        if (is_advanced(point)) rows[static_cast<std::size_t>(point.j)].push_back({point.i, point.i + 1});
      }
    }
    SweepRuns runs;
    runs.assign(rows, task_.runs.here());
    return runs;
  }

  bool is_advanced(const PointIndex& point) const {
    if (point.j < 0 || point.j >= n2()) return false;
    return std::ranges::any_of(task_.runs.advanced_anywhere(point.j),
                               [&](const Range& run) { return point.i >= run.first && point.i < run.last; });
  }

  /// The last resort, which is not conservative.
  void lift() {
    for (const auto& [i, j] : result_.thin) {
      double& p = task_.q_new(3, i, j);
      if (!(p < scheme_.p_floor)) continue;
      p = scheme_.p_floor;
      ++result_.floors;
    }
  }
};

/// The stencil of point k of an interpolation list.
struct Donors {
  std::ptrdiff_t first;
  int width, stride;

  double middle(const double* plane) const { return width == 3 ? plane[first + stride + 1] : plane[first]; }
  /// The smallest one that is positive; 0 where none is.
  double smallest(const double* plane) const {
    double least = 0;
    for (int m = 0; m < width; ++m) {
      for (int l = 0; l < width; ++l) {
        const double value = plane[first + static_cast<std::ptrdiff_t>(m) * stride + l];
        if (value > 0 && (least == 0 || value < least)) least = value;
      }
    }
    return least;
  }
};

constexpr int density = 0, pressure = 3;

}  // namespace

Positivity keep_positive(const SweepTask& task, const Scheme& scheme, const PositivityTask& positive) {
  return Thinness(task, scheme, positive).treat();
}

std::size_t keep_positive(const grid::InterpolationList& list, std::span<const FieldView> fields,
                          const RankRows& rows) {
  const FieldView target = fields[static_cast<std::size_t>(list.target_grid)];
  const ConstFieldView donor = fields[static_cast<std::size_t>(list.donor_grid)];
  std::size_t lifted = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Donors donors{.first = list.donor[k], .width = list.width, .stride = donor.layout.stride};
    bool thin = false;
    for (const int plane : {density, pressure}) {
      double& value = target.plane(plane)[list.target[k]];
      if (value > thin_part * donors.middle(donor.plane(plane))) continue;
      value = donors.smallest(donor.plane(plane));
      thin = true;
    }
    if (!thin) continue;
    const int j = (list.target[k] - Layout::lead + Layout::ghosts) / target.layout.stride - Layout::ghosts;
    lifted += rows.owns(j) ? 1 : 0;
  }
  return lifted;
}

}  // namespace fsi::fluid
