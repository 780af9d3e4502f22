#include "fluid_solver/levels/transfer.hpp"

#include <algorithm>
#include <cstddef>

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

StateVector conserved(const StateVector& q, double gamma) {
  return {q[0], q[0] * q[1], q[0] * q[2], q[3] / (gamma - 1) + 0.5 * q[0] * (q[1] * q[1] + q[2] * q[2])};
}

StateVector primitive(const StateVector& c, double gamma) {
  const double v1 = c[1] / c[0], v2 = c[2] / c[0];
  return {c[0], v1, v2, (gamma - 1) * (c[3] - 0.5 * (c[1] * v1 + c[2] * v2))};
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

/// Nine fine values from 3 x 3 coarse ones, component by component.
class Parabolas {
 public:
  Parabolas(ConstFieldView coarse, int i, int j, double gamma) {
    for (int b = -1; b <= 1; ++b) {
      for (int a = -1; a <= 1; ++a) values_[place(a, b)] = conserved(load(coarse, {i + a, j + b}), gamma);
    }
    for (int k = 0; k < 4; ++k) fit(k);
  }
  /// Of the nine points or parts that of a, b = -1, 0, 1.
  static std::size_t place(int a, int b) { return static_cast<std::size_t>(3 * (b + 1) + a + 1); }
  /// Primitive state of the fine point a, b of the control volume.
  StateVector at(int a, int b, double gamma) const {
    return primitive(values_[place(0, 0)] + deviation_[place(a, b)], gamma);
  }
  /// Primitive state of the whole control volume.
  StateVector mean(double gamma) const { return primitive(values_[place(0, 0)], gamma); }

 private:
  std::array<StateVector, 9> values_, deviation_;

  /// q0 + s1 x + s2 y + m x y + c1/2 (x^2 - 1/12) + c2/2 (y^2 - 1/12), averaged over the parts.
  void fit(int k) {
    const auto q = [&](int a, int b) { return values_[place(a, b)][k]; };
    const double s1 = (q(1, 0) - q(-1, 0)) / 6, s2 = (q(0, 1) - q(0, -1)) / 6;
    const double m = (q(1, 1) - q(-1, 1) - q(1, -1) + q(-1, -1)) / 36;
    const double c1 = (q(1, 0) - 2 * q(0, 0) + q(-1, 0)) / 54, c2 = (q(0, 1) - 2 * q(0, 0) + q(0, -1)) / 54;
    double low = 0, high = 0, least = q(0, 0), most = q(0, 0);
    for (int b = -1; b <= 1; ++b) {
      for (int a = -1; a <= 1; ++a) {
        const double d = s1 * a + s2 * b + m * a * b + c1 * (3 * a * a - 2) + c2 * (3 * b * b - 2);
        deviation_[place(a, b)][k] = d;
        low = std::min(low, d), high = std::max(high, d);
        least = std::min(least, q(a, b)), most = std::max(most, q(a, b));
      }
    }
    const double up = high > most - q(0, 0) ? (most - q(0, 0)) / high : 1.0;
    const double down = low < least - q(0, 0) ? (least - q(0, 0)) / low : 1.0;
    for (StateVector& d : deviation_) d[k] *= std::min(up, down);
  }
};

/// Coarse points of a run that are averaged together.
constexpr int chunk = 64;
constexpr auto columns_of_chunk = static_cast<std::size_t>(refinement_ratio * chunk);

/// The conserved variables, mass, momentum (2) and energy, of some columns.
using Columns = std::array<std::array<double, columns_of_chunk>, 4>;

/// Sums over rows j - 1, j, j + 1.
void sum_rows(ConstFieldView fine, int j, grid::Interval columns, double gamma, Columns& sums) {
  const double per_gamma = 1 / (gamma - 1);
  const StateRow<const double> low = StateRow<const double>(fine, j - 1).shifted(columns.begin),
                               middle = StateRow<const double>(fine, j).shifted(columns.begin),
                               high = StateRow<const double>(fine, j + 1).shifted(columns.begin);
  double *mass = sums[0].data(), *momentum1 = sums[1].data(), *momentum2 = sums[2].data(),
         *energy = sums[3].data();
#pragma omp simd
  for (int a = 0; a < columns.end - columns.begin; ++a) {
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
  constexpr double ninth = 1.0 / (refinement_ratio * refinement_ratio);
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

}  // namespace

void restrict_to(const grid::RowSets& points, FieldView coarse, ConstFieldView fine, const Ends& ends,
                 double gamma) {
  const Layout& shape = coarse.layout;
  for (int j = 1; j + 1 < shape.n2; ++j) {
    fetch_row<true>(points, j + 1, 0, coarse, fine);
    for (const grid::Interval& run : points.row(j)) {
      const int end = std::min(run.end, shape.n1 - 1);
      for (int i = std::max(run.begin, 1); i < end; i += chunk)
        average_run(fine, coarse, j, {i, std::min(i + chunk, end)}, gamma);
    }
  }
  const auto nothing = [](int) {};
  each_point(points, nothing, [&](int i, int j) {
    if (i > 0 && i + 1 < shape.n1 && j > 0 && j + 1 < shape.n2) return;
    const Members m1 = members_of(i, fine.layout.n1, {ends[0], ends[1]});
    const Members m2 = members_of(j, fine.layout.n2, {ends[2], ends[3]});
    StateVector sum = StateVector::Zero();
    for (std::size_t b = 0; b < static_cast<std::size_t>(m2.n); ++b) {
      StateVector row = StateVector::Zero();
      for (std::size_t a = 0; a < static_cast<std::size_t>(m1.n); ++a)
        row += m1.weight[a] * conserved(load(fine, {m1.at[a], m2.at[b]}), gamma);
      sum += m2.weight[b] * row;
    }
    if (m1.mirrored) sum[1] = 0;
    if (m2.mirrored) sum[2] = 0;
    store(coarse, {i, j}, primitive(sum, gamma));
  });
}

void prolong_from(const grid::RowSets& points, ConstFieldView coarse, FieldView fine, double gamma) {
  const Layout& shape = fine.layout;
  std::array<StateVector, 9> states;
  const auto ask = [&](int j) { fetch_row<false>(points, j + 1, 1, coarse, fine); };
  each_point(points, ask, [&](int i, int j) {
    const Parabolas parts(coarse, i, j, gamma);
    const auto each = [&](const auto& action) {
      for (int b = -1; b <= 1; ++b) {
        for (int a = -1; a <= 1; ++a) action(a, b, states[Parabolas::place(a, b)]);
      }
    };
    bool positive = true;
    each([&](int a, int b, StateVector& state) {
      state = parts.at(a, b, gamma);
      positive = positive && state[0] > 0 && state[3] > 0;
    });
    if (!positive) states.fill(parts.mean(gamma));
    each([&](int a, int b, const StateVector& state) {
      const int i_fine = refinement_ratio * i + a, j_fine = refinement_ratio * j + b;
      if (i_fine >= 0 && i_fine < shape.n1 && j_fine >= 0 && j_fine < shape.n2)
        store(fine, {i_fine, j_fine}, state);
    });
  });
}

}  // namespace fsi::fluid
