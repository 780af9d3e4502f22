/// What is looked for at all points of a grid after a step: the fastest waves, and how little is left.

#include <algorithm>
#include <limits>

#include "fluid_solver/component.hpp"
#include "fluid_solver/kernels/rates.hpp"

namespace fsi::fluid {

namespace {

/// Rows between what is asked for early and what is looked at.
constexpr int ahead = 3;

double least(const double* values, const grid::Interval& run) {
  double low = std::numeric_limits<double>::infinity();
#pragma omp simd reduction(min : low)
  for (int i = run.begin; i < run.end; ++i) low = values[i] < low ? values[i] : low;
  return low;
}

/// Asks early for the states of short runs: unlike those of long ones, no processor foresees them.
void fetch(ConstFieldView q, const grid::RowSets& points, int j) {
  constexpr int long_run = 256, line = 8;  // points
  if (j >= points.rows()) return;
  for (const grid::Interval& run : points.row(j)) {
    if (run.end - run.begin > long_run) continue;
    for (int plane = 0; plane < 4; ++plane) {
      const double* row = q.row(plane, j);
      for (int i = run.begin; i < run.end + line; i += line) __builtin_prefetch(row + i);
    }
  }
}

}  // namespace

/// Largest wave rate of a row's inner points.
void Component::measure_row(int j) {
  double& most = row_rates_[static_cast<std::size_t>(j)];
  most = 0;
  for (const Range& run : runs_.advanced(j)) {
    const Range inner{std::max(run.first, 1), std::min(run.last, grid_.layout().n1 - 1)};
    if (inner.first < inner.last) most = std::max(most, largest(step_rates(j, inner), inner));
  }
}

double* Component::step_rates(int j, Range range) const {
  double* rate = workspace_.row(0);
  step_rate_row(state_.view(), step_grid(), last_dt_, scheme_, j, rate, range);
  return rate;
}

/// Compares the points of a part of row j with the fastest one so far.
void Component::compare(FastestPoint& fastest, int look, int j, Range part) const {
  for (const Range& run : runs_.advanced(j)) {
    const Range range{std::max(run.first, part.first), std::min(run.last, part.last)};
    if (range.first >= range.last) continue;
    const double* rate = step_rates(j, range);
    const double most = largest(rate, range);
    if (most <= fastest.rate) continue;
    const double* point = std::max_element(rate + range.first, rate + range.last);
    fastest = {.rate = *point, .i = static_cast<int>(point - rate), .j = j, .look = look};
  }
}

/// Where the sweep knows the rates of rows.
FastestPoints Component::fastest_by_rows() const {
  const int n1 = grid_.layout().n1, n2 = grid_.layout().n2;
  FastestPoints found;
  const auto own = row_rates_.begin() + std::max(rows_.all ? 0 : rows_.own.first, 1),
             end = row_rates_.begin() + std::min(rows_.all ? n2 : rows_.own.end, n2 - 1);
  if (own < end) {
    const auto inner = std::max_element(own, end);
    found.row_rate = *inner;
    compare(found.inner, 0, static_cast<int>(inner - row_rates_.begin()), {1, n1 - 1});
  }
  compare(found.rest, 1, 0, {0, n1});
  compare(found.rest, 2, n2 - 1, {0, n1});
  for (int j = 1; j < n2 - 1; ++j) {
    compare(found.rest, 3, j, {0, 1});
    compare(found.rest, 3, j, {n1 - 1, n1});
  }
  return found;
}

void Component::lower(Smallest& smallest, int j) const {
  if (!rows_.owns(j)) return;
  const ConstFieldView q = state();
  for (const grid::Interval& run : valid_.row(j)) {
    smallest.rho = std::min(smallest.rho, least(q.row(0, j), run));
    smallest.p = std::min(smallest.p, least(q.row(3, j), run));
  }
}

FastestPoints Component::fastest_points() const {
  return rates_need_neighbours() ? extremes().fastest : fastest_by_rows();
}

Smallest Component::smallest() const {
  Smallest found;
  for (int j = 0; j < grid_.layout().n2; ++j) {
    fetch(state(), valid_, j + ahead);
    lower(found, j);
  }
  return found;
}

/// One after the other or, where rates need the neighbours' new states and the sweep cannot know them, both on the way
/// through all rows.
Extremes Component::extremes() const {
  if (!rates_need_neighbours()) return {.fastest = fastest_by_rows(), .smallest = smallest()};
  Extremes found;
  const Layout& shape = grid_.layout();
  for (int j = 0; j < shape.n2; ++j) {
    fetch(state(), valid_, j + ahead);
    compare(found.fastest.rest, 0, j, {0, shape.n1});
    lower(found.smallest, j);
  }
  return found;
}

}  // namespace fsi::fluid
