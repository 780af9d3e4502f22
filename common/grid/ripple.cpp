#include "common/grid/ripple.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace fsi::grid {

namespace {

/// Smallest and largest of the values of a plane that count; not finite ones are left out.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

void widen(Range& range, const WatchedGrid& grid, int plane) {
  constexpr double most = std::numeric_limits<double>::max();
  for (int j = 0; j < grid.q.layout.n2; ++j) {
    const double* values = grid.q.row(plane, j);
    for (const Interval& run : grid.points->row(j)) {
      double low = range.low, high = range.high;
#pragma omp simd reduction(min : low) reduction(max : high)
      for (int i = run.begin; i < run.end; ++i) {
        low = values[i] < low && values[i] >= -most ? values[i] : low;
        high = values[i] > high && values[i] <= most ? values[i] : high;
      }
      range = {low, high};
    }
  }
}

/// Number of points that lie above, or below, both their neighbours by more than `least`. Neighbours are
/// `step` doubles away; they may be ghost points, or points without a value.
int turns(const double* values, const Interval& run, std::ptrdiff_t step, double least) {
  int count = 0;
#pragma omp simd reduction(+ : count)
  for (int i = run.begin; i < run.end; ++i) {
    const double before = values[i] - values[i - step], after = values[i] - values[i + step];
    const double smaller = std::fabs(before) < std::fabs(after) ? std::fabs(before) : std::fabs(after);
    count += before * after > 0 && smaller > least ? 1 : 0;
  }
  return count;
}

constexpr int swings_of_a_ripple = 5;

}  // namespace

double TurnCounter::next(double value) {
  const int direction = value > last_ ? 1 : value < last_ ? -1 : direction_;
  const double before = std::exchange(last_, value);
  ++away_;
  if (direction == direction_) return 0;
  const bool turns = direction_ != 0;
  direction_ = direction;
  if (!turns) return 0;
  // The value before was a turn, away_ - 1 points after the last one.
  count_ = turned_ && away_ - 1 <= reach ? count_ + 1 : 0;
  if (count_ > 0) swings_[static_cast<std::size_t>(count_) % swings_.size()] = std::fabs(before - turn_);
  turned_ = true;
  turn_ = before;
  away_ = 1;
  return count_ < swings_of_a_ripple ? 0 : 0.5 * *std::ranges::min_element(swings_);
}

RippleWatch::RippleWatch(std::vector<WatchedQuantity> quantities, std::vector<std::string> grids)
    : quantities_(std::move(quantities)), grids_(std::move(grids)), ranges_(quantities_.size()) {
  for (const WatchedQuantity& quantity : quantities_) {
    components_.insert(components_.end(), quantity.components.begin(), quantity.components.end());
  }
}

void RippleWatch::look(std::span<const WatchedGrid> grids, double t) {
  now_ = {};
  int component = 0;
  for (std::size_t k = 0; k < quantities_.size(); ++k) {
    const auto planes = static_cast<int>(quantities_[k].components.size());
    for (int c = 0; c < planes; ++c) {
      Range range;
      for (const WatchedGrid& grid : grids) widen(range, grid, quantities_[k].first + c);
      ranges_[k] = std::max(ranges_[k], range.high - range.low);
    }
    for (int c = 0; c < planes; ++c, ++component) {
      for (std::size_t g = 0; g < grids.size(); ++g) {
        const Place at = {.on = grids[g],
                          .plane = quantities_[k].first + c,
                          .range = std::max(ranges_[k], quantities_[k].floor),
                          .found = {.component = component, .grid = static_cast<int>(g), .t = t}};
        look_along_rows(at);
        look_along_columns(at);
      }
    }
  }
  if (now_.size > worst_.size) worst_ = now_;
}

void RippleWatch::note(const Place& at, double amplitude, int i, int j) {
  const double size = amplitude / at.range;
  if (!(size > now_.size) || size < faintest) return;
  now_ = at.found;
  now_.size = size;
  now_.i = i;
  now_.j = j;
  now_.place = {at.on.x(0, i, j), at.on.x(1, i, j)};
}

void RippleWatch::look_along_rows(const Place& at) {
  TurnCounter counter;
  for (int j = 0; j < at.on.q.layout.n2; ++j) {
    const double* values = at.on.q.row(at.plane, j);
    for (const Interval& run : at.on.points->row(j)) {
      if (turns(values, run, 1, faintest * at.range) < swings_of_a_ripple) continue;
      counter.start(values[run.begin]);
      for (int i = run.begin + 1; i < run.end; ++i) {
        if (const double amplitude = counter.next(values[i]); amplitude > 0) note(at, amplitude, i - 1, j);
      }
    }
  }
}

/// Row by row, a counter for each column.
void RippleWatch::look_along_columns(const Place& at) {
  const Layout& layout = at.on.q.layout;
  int found = 0;
  for (int j = 1; j < layout.n2 - 1 && found < swings_of_a_ripple; ++j) {
    for (const Interval& run : at.on.points->row(j))
      found += turns(at.on.q.row(at.plane, j), run, layout.stride, faintest * at.range);
  }
  if (found < swings_of_a_ripple) return;
  const auto columns = static_cast<std::size_t>(layout.n1);
  if (columns_.size() < columns) columns_.resize(columns);
  column_rows_.assign(std::max(columns, column_rows_.size()), -2);
  for (int j = 0; j < layout.n2; ++j) {
    const double* values = at.on.q.row(at.plane, j);
    for (const Interval& run : at.on.points->row(j)) {
      for (int i = run.begin; i < run.end; ++i) {
        const auto column = static_cast<std::size_t>(i);
        const int before = std::exchange(column_rows_[column], j);
        if (before != j - 1) {
          columns_[column].start(values[i]);
        } else if (const double amplitude = columns_[column].next(values[i]); amplitude > 0) {
          note(at, amplitude, i, j - 1);
        }
      }
    }
  }
}

const std::string& RippleWatch::component_of(const Ripple& ripple) const {
  return components_[static_cast<std::size_t>(ripple.component)];
}

const std::string& RippleWatch::grid_of(const Ripple& ripple) const {
  return grids_[static_cast<std::size_t>(ripple.grid)];
}

std::string RippleWatch::in_words(const Ripple& ripple) const {
  return fmt::format(R"({} ripples by {:.2g} % on grid "{}", point ({}, {}) at ({:.4g}, {:.4g}), t = {:.4g})",
                     component_of(ripple), 100 * ripple.size, grid_of(ripple), ripple.i, ripple.j,
                     ripple.place.x(), ripple.place.y(), ripple.t);
}

void RippleWatch::archive(Archive& archive) {
  archive.values("ranges", ranges_);
  for (auto& [name, ripple] : {std::pair<const char*, Ripple&>("now", now_), {"worst", worst_}}) {
    archive.inside(name, [&archive, &ripple = ripple] {
      archive.number("size", ripple.size);
      archive.number("component", ripple.component);
      archive.number("grid", ripple.grid);
      archive.number("i", ripple.i);
      archive.number("j", ripple.j);
      archive.values("place", {ripple.place.data(), 2});
      archive.number("t", ripple.t);
    });
  }
}

}  // namespace fsi::grid
