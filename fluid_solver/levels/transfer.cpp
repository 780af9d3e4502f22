#include "fluid_solver/levels/transfer.hpp"

#include <algorithm>
#include <cstddef>

#include "fluid_solver/kernels/limiter.hpp"
#include "fluid_solver/kernels/rows.hpp"

namespace fsi::fluid {

Members members_of(int k, int fine_points, const std::array<Beyond, 2>& ends) {
  constexpr double third = 1.0 / refinement_ratio;
  const int middle = refinement_ratio * k, last = fine_points - 1;
  if (middle > 0 && middle < last)
    return {.n = 3, .at = {middle - 1, middle, middle + 1}, .weight = {third, third, third}};
  const bool low = middle == 0;
  const int inside = low ? 1 : last - 1;
  switch (ends[low ? 0 : 1]) {
    case Beyond::period:
      return {.n = 3, .at = {last - 1, low ? 0 : last, 1}, .weight = {third, third, third}};
    case Beyond::mirror:
      return {.n = 2, .at = {middle, inside, 0}, .weight = {third, 2 * third, 0}, .mirrored = true};
    default:
      return {.n = 1, .at = {middle, 0, 0}, .weight = {1, 0, 0}};
  }
}

namespace {

/// Asks early for the states of a run: short runs, one above the other, are far away in memory.
template <bool written>
void fetch(ConstFieldView q, int j, grid::Interval run) {
  constexpr int line = 8;  // points
  const int first = std::max(run.begin, -Layout::ghosts),
            end = std::min(run.end, q.layout.n1 + Layout::ghosts);
  if (j < -Layout::ghosts || j >= q.layout.n2 + Layout::ghosts) return;
  for (int plane = 0; plane < 4; ++plane) {
    const double* row = q.row(plane, j);
    for (int i = first; i < end; i += line) __builtin_prefetch(row + i, written ? 1 : 0);
    if (first < end) __builtin_prefetch(row + end - 1, written ? 1 : 0);
  }
}

/// Rows between what is asked for early and what is worked on: at a rim there is little to do in each.
constexpr int ahead = 4;

/// For a row of coarse points their states, `around` rows and columns of them, and those of the fine points in their
/// control volumes.
template <bool coarse_written>
void fetch_row(const grid::RowSets& points, int j, int around, ConstFieldView coarse, ConstFieldView fine) {
  if (j >= points.rows()) return;
  for (const auto& [begin, end] : points.row(j)) {
    for (int row = j - around; row <= j + around; ++row)
      fetch<coarse_written>(coarse, row, {begin - around, end + around});
    for (int row = refinement_ratio * j - 1; row <= refinement_ratio * j + 1; ++row)
      fetch<!coarse_written>(fine, row, {refinement_ratio * begin - 1, refinement_ratio * end - 1});
  }
}

/// `before`: to be done before each row.
template <class Before, class Action>
void each_point(const grid::RowSets& points, const Before& before, const Action& action) {
  for (int j = 0; j < points.rows(); ++j) {
    before(j);
    for (const grid::Interval& run : points.row(j)) {
      for (int i = run.begin; i < run.end; ++i) action(i, j);
    }
  }
}

/// Of a 3 x 3 block of points, row by row; loops over all twelve are whole vectors. The last three repeat the middle.
constexpr int parts = refinement_ratio * refinement_ratio, padded_parts = 12, middle_part = parts / 2;
using Parts = std::array<double, padded_parts>;
/// Of four variables.
using PartStates = std::array<Parts, 4>;

/// Position of each part from the middle, and what the polynomial's terms are there.
struct PartTable {
  Parts a{}, b{}, ab{}, aa{}, bb{};
  constexpr PartTable() {
    for (int k = 0; k < parts; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const int column = k % refinement_ratio - 1, row = k / refinement_ratio - 1;
      a[at] = column, b[at] = row;
    }
    for (std::size_t k = 0; k < padded_parts; ++k)
      ab[k] = a[k] * b[k], aa[k] = 3 * a[k] * a[k] - 2, bb[k] = 3 * b[k] * b[k] - 2;
  }
};
constexpr PartTable table;

PartStates load_around(ConstFieldView q, int i, int j) {
  PartStates states;
  for (int plane = 0; plane < 4; ++plane) {
    double* to = states[static_cast<std::size_t>(plane)].data();
    for (int b = -1; b <= 1; ++b) {
      const double* row = q.row(plane, j + b) + i;
      for (int a = -1; a <= 1; ++a) *to++ = row[a];
    }
    std::fill_n(to, padded_parts - parts, q(plane, i, j));
  }
  return states;
}

void make_conserved(PartStates& q, double gamma) {
  const double per_gamma = 1 / (gamma - 1);
  for (std::size_t k = 0; k < padded_parts; ++k) {
    const double v1 = q[1][k], v2 = q[2][k];
    q[1][k] = q[0][k] * v1, q[2][k] = q[0][k] * v2;
    q[3][k] = per_gamma * q[3][k] + 0.5 * (q[1][k] * v1 + q[2][k] * v2);
  }
}

void make_primitive(PartStates& q, double gamma) {
  for (std::size_t k = 0; k < padded_parts; ++k) {
    const double specific = 1 / q[0][k], v1 = specific * q[1][k], v2 = specific * q[2][k];
    q[3][k] = (gamma - 1) * (q[3][k] - 0.5 * (q[1][k] * v1 + q[2][k] * v2));
    q[1][k] = v1, q[2][k] = v2;
  }
}

/// Smallest and largest value.
struct Bounds {
  double low, high;
};
/// Four at a time: a loop over all with one result would wait for each before the next.
Bounds bounds_of(const Parts& values) {
  constexpr std::size_t four = 4;
  std::array<double, four> low{}, high{};
  for (std::size_t k = 0; k < four; ++k) {
    low[k] = smaller(smaller(values[k], values[k + four]), values[k + 2 * four]);
    high[k] = larger(larger(values[k], values[k + four]), values[k + 2 * four]);
  }
  return {smaller(smaller(low[0], low[1]), smaller(low[2], low[3])),
          larger(larger(high[0], high[1]), larger(high[2], high[3]))};
}

/// The nine fine values of the middle one of 3 x 3 coarse ones:
/// q0 + s1 x + s2 y + m x y + c1/2 (x^2 - 1/12) + c2/2 (y^2 - 1/12), averaged over the parts. Those that repeat the middle
/// get what it gets.
void become_parts(Parts& q) {
  const double q0 = q[middle_part];
  const double s1 = (q[5] - q[3]) / 6, s2 = (q[7] - q[1]) / 6, m = (q[8] - q[6] - q[2] + q[0]) / 36;
  const double c1 = (q[5] - 2 * q0 + q[3]) / 54, c2 = (q[7] - 2 * q0 + q[1]) / 54;
  Parts deviation;
  for (std::size_t k = 0; k < padded_parts; ++k)
    deviation[k] = s1 * table.a[k] + s2 * table.b[k] + m * table.ab[k] + c1 * table.aa[k] + c2 * table.bb[k];
  const auto [low, high] = bounds_of(deviation);
  const auto [least, most] = bounds_of(q);
  const double up = high > most - q0 ? (most - q0) / high : 1.0;
  const double down = low < least - q0 ? (least - q0) / low : 1.0;
  const double part = std::min(up, down);
  for (std::size_t k = 0; k < padded_parts; ++k) q[k] = q0 + part * deviation[k];
}

/// The state of the whole control volume in all parts.
PartStates middle_of(ConstFieldView q, int i, int j) {
  PartStates states;
  for (int plane = 0; plane < 4; ++plane) states[static_cast<std::size_t>(plane)].fill(q(plane, i, j));
  return states;
}

/// In the fine points of a control volume that there are.
void store_parts(const PartStates& states, FieldView fine, int i, int j) {
  const int middle = refinement_ratio * i;
  const bool left = middle > 0, right = middle + 1 < fine.layout.n1;
  for (int plane = 0; plane < 4; ++plane) {
    const double* from = states[static_cast<std::size_t>(plane)].data();
    for (int b = -1; b <= 1; ++b, from += refinement_ratio) {
      const int row = refinement_ratio * j + b;
      if (row < 0 || row >= fine.layout.n2) continue;
      double* to = fine.row(plane, row) + middle;
      if (left) to[-1] = from[0];
      to[0] = from[1];
      if (right) to[1] = from[2];
    }
  }
}

/// Coarse points of a run that are averaged together.
constexpr int chunk = 64;
constexpr double ninth = 1.0 / parts;
constexpr int vector = 8;  // points; a row of a field can be read so far beyond its end
constexpr auto columns_of_chunk = static_cast<std::size_t>(refinement_ratio * chunk);

/// The conserved variables, mass, momentum (2) and energy, of some columns.
using Columns = std::array<std::array<double, columns_of_chunk>, 4>;

/// Sums over rows j - 1, j, j + 1; of whole vectors of columns, for those of a short run fill hardly one.
void sum_rows(ConstFieldView fine, int j, grid::Interval columns, double gamma, Columns& sums) {
  const double per_gamma = 1 / (gamma - 1);
  const int n = (columns.end - columns.begin + vector - 1) / vector * vector;
  const StateRow<const double> low = StateRow<const double>(fine, j - 1).shifted(columns.begin),
                               middle = StateRow<const double>(fine, j).shifted(columns.begin),
                               high = StateRow<const double>(fine, j + 1).shifted(columns.begin);
  double *mass = sums[0].data(), *momentum1 = sums[1].data(), *momentum2 = sums[2].data(),
         *energy = sums[3].data();
#pragma omp simd
  for (int a = 0; a < n; ++a) {
    const double low1 = low.rho[a] * low.v1[a], low2 = low.rho[a] * low.v2[a];
    const double middle1 = middle.rho[a] * middle.v1[a], middle2 = middle.rho[a] * middle.v2[a];
    const double high1 = high.rho[a] * high.v1[a], high2 = high.rho[a] * high.v2[a];
    mass[a] = low.rho[a] + middle.rho[a] + high.rho[a];
    momentum1[a] = low1 + middle1 + high1;
    momentum2[a] = low2 + middle2 + high2;
    energy[a] = per_gamma * (low.p[a] + middle.p[a] + high.p[a]) +
                0.5 * (low1 * low.v1[a] + low2 * low.v2[a] + middle1 * middle.v1[a] + middle2 * middle.v2[a] +
                       high1 * high.v1[a] + high2 * high.v2[a]);
  }
}

/// Averages of a run of points away from the sides.
void average_run(ConstFieldView fine, FieldView coarse, int j, grid::Interval run, double gamma) {
  Columns sums;
  sum_rows(fine, refinement_ratio * j, {refinement_ratio * run.begin - 1, refinement_ratio * run.end - 1},
           gamma, sums);
  for (int i = run.begin; i < run.end; ++i) {
    const auto a = static_cast<std::size_t>(refinement_ratio * (i - run.begin));
    StateVector mean;
    for (std::size_t k = 0; k < 4; ++k)
      mean[static_cast<int>(k)] = ninth * (sums[k][a] + sums[k][a + 1] + sums[k][a + 2]);
    store(coarse, {i, j}, primitive(mean, gamma));
  }
}

/// The same for the density alone.
void average_density_run(ConstFieldView fine, FieldView coarse, int j, grid::Interval run) {
  const int first = refinement_ratio * run.begin - 1,
            n = (refinement_ratio * run.end - 1 - first + vector - 1) / vector * vector;
  const double *low = fine.row(0, refinement_ratio * j - 1) + first,
               *middle = fine.row(0, refinement_ratio * j) + first,
               *high = fine.row(0, refinement_ratio * j + 1) + first;
  std::array<double, columns_of_chunk> sums;
#pragma omp simd
  for (int a = 0; a < n; ++a) sums[static_cast<std::size_t>(a)] = low[a] + middle[a] + high[a];
  double* mean = coarse.row(0, j) + run.begin;
  const double* three = sums.data();
  for (int i = 0; i < run.end - run.begin; ++i, three += refinement_ratio)
    mean[i] = ninth * (three[0] + three[1] + three[2]);
}

/// The control volume of a coarse point on a side of the rectangle.
struct SideVolume {
  Members m1, m2;

  /// The mean of value(i, j) of its fine points.
  template <class Value>
  auto mean(const Value& value) const {
    using Sum = decltype(value(0, 0));
    Sum sum = 0.0 * value(m1.at[0], m2.at[0]);
    for (std::size_t b = 0; b < static_cast<std::size_t>(m2.n); ++b) {
      Sum row = 0.0 * sum;
      for (std::size_t a = 0; a < static_cast<std::size_t>(m1.n); ++a)
        row += m1.weight[a] * value(m1.at[a], m2.at[b]);
      sum += m2.weight[b] * row;
    }
    return sum;
  }
};

/// Calls inside(j, run) for runs of points away from the sides, of which so many can be averaged together, and on_side(i, j,
/// volume) for the others; `before`: to be done before each row.
template <class Before, class Inside, class OnSide>
void each_volume(const grid::RowSets& points, const Layout& shape, const Layout& fine, const Ends& ends,
                 const Before& before, const Inside& inside, const OnSide& on_side) {
  for (int j = 0; j < shape.n2; ++j) {
    before(j);
    const bool side = j == 0 || j + 1 == shape.n2;
    const auto one = [&](int i) {
      on_side(
          i, j,
          SideVolume{members_of(i, fine.n1, {ends[0], ends[1]}), members_of(j, fine.n2, {ends[2], ends[3]})});
    };
    for (const auto& [begin, end] : points.row(j)) {
      for (int i = begin; side && i < end; ++i) one(i);
      if (side) continue;
      if (begin == 0) one(0);
      const int last = std::min(end, shape.n1 - 1);
      for (int i = std::max(begin, 1); i < last; i += chunk)
        inside(j, grid::Interval{i, std::min(i + chunk, last)});
      if (end == shape.n1) one(shape.n1 - 1);
    }
  }
}

}  // namespace

void restrict_to(const grid::RowSets& points, FieldView coarse, ConstFieldView fine, const Ends& ends,
                 double gamma) {
  each_volume(
      points, coarse.layout, fine.layout, ends,
      [&](int j) { fetch_row<true>(points, j + ahead, 0, coarse, fine); },
      [&](int j, grid::Interval run) { average_run(fine, coarse, j, run, gamma); },
      [&](int i, int j, const SideVolume& volume) {
        StateVector mean = volume.mean([&](int a, int b) -> StateVector {
          return conserved(load(fine, {a, b}), gamma);
        });
        if (volume.m1.mirrored) mean[1] = 0;
        if (volume.m2.mirrored) mean[2] = 0;
        store(coarse, {i, j}, primitive(mean, gamma));
      });
}

void restrict_density(const grid::RowSets& points, FieldView coarse, ConstFieldView fine, const Ends& ends) {
  each_volume(
      points, coarse.layout, fine.layout, ends, [](int) {},
      [&](int j, grid::Interval run) { average_density_run(fine, coarse, j, run); },
      [&](int i, int j, const SideVolume& volume) {
        coarse(0, i, j) = volume.mean([&](int a, int b) { return fine(0, a, b); });
      });
}

void prolong_from(const grid::RowSets& points, ConstFieldView coarse, FieldView fine, double gamma) {
  const auto ask = [&](int j) { fetch_row<false>(points, j + ahead, 1, coarse, fine); };
  each_point(points, ask, [&](int i, int j) {
    PartStates states = load_around(coarse, i, j);
    make_conserved(states, gamma);
    for (Parts& variable : states) become_parts(variable);
    make_primitive(states, gamma);
    const bool positive = bounds_of(states[0]).low > 0 && bounds_of(states[3]).low > 0;
    if (!positive) states = middle_of(coarse, i, j);
    store_parts(states, fine, i, j);
  });
}

}  // namespace fsi::fluid
