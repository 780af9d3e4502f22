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
    : Watch(std::move(quantities), std::move(grids)) {
  for (const WatchedQuantity& quantity : this->quantities()) ranges_.push_back(quantity.floor);
}

void RippleWatch::look(std::span<const WatchedGrid> grids, double t) {
  begin();
  for (std::size_t k = 0; k < quantities().size(); ++k) {
    for (int c = 0; c < quantities()[k].planes(); ++c) {
      Range range;
      for (const WatchedGrid& grid : grids) widen(range, grid, quantities()[k].first + c);
      ranges_[k] = std::max(ranges_[k], range.high - range.low);
    }
  }
  int component = 0;
  for (std::size_t k = 0; k < quantities().size(); ++k) {
    for (int c = 0; c < quantities()[k].planes(); ++c, ++component) {
      for (std::size_t g = 0; g < grids.size(); ++g) {
        const Place at = {.on = grids[g],
                          .plane = quantities()[k].first + c,
                          .range = ranges_[k],
                          .found = {.component = component, .grid = static_cast<int>(g), .t = t}};
        look_along_rows(at);
        look_along_columns(at);
      }
    }
  }
}

void RippleWatch::note(const Place& at, double amplitude, int i, int j) {
  Finding found = at.found;
  found.size = amplitude / at.range;
  if (!(found.size >= faintest)) return;
  found.i = i;
  found.j = j;
  found.place = {at.on.x(0, i, j), at.on.x(1, i, j)};
  keep(found);
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

std::string RippleWatch::in_words(const Finding& ripple) const {
  return fmt::format(R"({} ripples by {:.2g} % on grid "{}", point ({}, {}) at ({:.6g}, {:.6g}), t = {:.4g})",
                     component_of(ripple), 100 * ripple.size, grid_of(ripple), ripple.i, ripple.j,
                     ripple.place.x(), ripple.place.y(), ripple.t);
}

void RippleWatch::archive(Archive& archive) {
  archive.values("ranges", ranges_);
  archive_findings(archive);
}

}  // namespace fsi::grid
