#include "fluid_solver/levels/transfer.hpp"

#include <algorithm>

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
      return {.n = 3,
              .at = {low ? last - 1 : last, low ? 0 : last, low ? 1 : last - 1},
              .weight = {third, third, third}};
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

template <class Action>
void each_point(const grid::RowSets& points, const Action& action) {
  for (int j = 0; j < points.rows(); ++j) {
    for (const grid::Interval& run : points.row(j)) {
      for (int i = run.begin; i < run.end; ++i) action(i, j);
    }
  }
}

/// Nine fine values from 3 x 3 coarse ones, component by component.
class Parabolas {
 public:
  Parabolas(ConstFieldView coarse, int i, int j, double gamma) {
    for (int b = 0; b < 3; ++b) {
      for (int a = 0; a < 3; ++a) values_[b][a] = conserved(load(coarse, {i + a - 1, j + b - 1}), gamma);
    }
    for (int k = 0; k < 4; ++k) fit(k);
  }
  /// Primitive state of the fine point a, b = 0, 1, 2 of the control volume.
  StateVector at(int a, int b, double part, double gamma) const {
    return primitive(values_[1][1] + part * deviation_[b][a], gamma);
  }

 private:
  std::array<std::array<StateVector, 3>, 3> values_, deviation_;

  /// q0 + s1 x + s2 y + m x y + c1/2 (x^2 - 1/12) + c2/2 (y^2 - 1/12), averaged over the parts.
  void fit(int k) {
    const auto q = [&](int a, int b) { return values_[b + 1][a + 1][k]; };
    const double s1 = (q(1, 0) - q(-1, 0)) / 6, s2 = (q(0, 1) - q(0, -1)) / 6;
    const double m = (q(1, 1) - q(-1, 1) - q(1, -1) + q(-1, -1)) / 36;
    const double c1 = (q(1, 0) - 2 * q(0, 0) + q(-1, 0)) / 54, c2 = (q(0, 1) - 2 * q(0, 0) + q(0, -1)) / 54;
    double low = 0, high = 0, least = q(0, 0), most = q(0, 0);
    for (int b = -1; b <= 1; ++b) {
      for (int a = -1; a <= 1; ++a) {
        const double d = s1 * a + s2 * b + m * a * b + c1 * (3 * a * a - 2) + c2 * (3 * b * b - 2);
        deviation_[b + 1][a + 1][k] = d;
        low = std::min(low, d), high = std::max(high, d);
        least = std::min(least, q(a, b)), most = std::max(most, q(a, b));
      }
    }
    const double up = high > most - q(0, 0) ? (most - q(0, 0)) / high : 1.0;
    const double down = low < least - q(0, 0) ? (least - q(0, 0)) / low : 1.0;
    for (auto& row : deviation_) {
      for (StateVector& d : row) d[k] *= std::min(up, down);
    }
  }
};

}  // namespace

namespace {

/// Sums of the conserved variables over three fine points of a row.
struct Sums {
  double mass = 0, momentum1 = 0, momentum2 = 0, kinetic = 0, p = 0;
};

/// Averages of a run of points away from the sides.
void average_run(ConstFieldView fine, FieldView coarse, int j, const grid::Interval& run, double gamma) {
  constexpr double ninth = 1.0 / (refinement_ratio * refinement_ratio);
  const std::array rows{refinement_ratio * j - 1, refinement_ratio * j, refinement_ratio * j + 1};
  for (int i = run.begin; i < run.end; ++i) {
    Sums sum;
    for (const int row : rows) {
      const double *rho = fine.row(0, row), *v1 = fine.row(1, row), *v2 = fine.row(2, row),
                   *p = fine.row(3, row);
      for (int a = refinement_ratio * i - 1; a <= refinement_ratio * i + 1; ++a) {
        const double m1 = rho[a] * v1[a], m2 = rho[a] * v2[a];
        sum.mass += rho[a], sum.momentum1 += m1, sum.momentum2 += m2;
        sum.kinetic += m1 * v1[a] + m2 * v2[a], sum.p += p[a];
      }
    }
    const double energy = sum.p / (gamma - 1) + 0.5 * sum.kinetic;
    store(coarse, {i, j},
          primitive(ninth * StateVector(sum.mass, sum.momentum1, sum.momentum2, energy), gamma));
  }
}

}  // namespace

void restrict_to(const grid::RowSets& points, FieldView coarse, ConstFieldView fine, const Ends& ends,
                 double gamma) {
  const Layout& shape = coarse.layout;
  for (int j = 1; j + 1 < shape.n2; ++j) {
    for (const grid::Interval& run : points.row(j))
      average_run(fine, coarse, j, {std::max(run.begin, 1), std::min(run.end, shape.n1 - 1)}, gamma);
  }
  each_point(points, [&](int i, int j) {
    if (i > 0 && i + 1 < shape.n1 && j > 0 && j + 1 < shape.n2) return;
    const Members m1 = members_of(i, fine.layout.n1, {ends[0], ends[1]});
    const Members m2 = members_of(j, fine.layout.n2, {ends[2], ends[3]});
    StateVector sum = StateVector::Zero();
    for (int b = 0; b < m2.n; ++b) {
      StateVector row = StateVector::Zero();
      for (int a = 0; a < m1.n; ++a) row += m1.weight[a] * conserved(load(fine, {m1.at[a], m2.at[b]}), gamma);
      sum += m2.weight[b] * row;
    }
    if (m1.mirrored) sum[1] = 0;
    if (m2.mirrored) sum[2] = 0;
    store(coarse, {i, j}, primitive(sum, gamma));
  });
}

void prolong_from(const grid::RowSets& points, ConstFieldView coarse, FieldView fine, double gamma) {
  const Layout& shape = fine.layout;
  each_point(points, [&](int i, int j) {
    const Parabolas parts(coarse, i, j, gamma);
    double part = 1;
    for (int b = 0; b < 3; ++b) {
      for (int a = 0; a < 3; ++a) {
        const StateVector q = parts.at(a, b, 1, gamma);
        if (!(q[0] > 0 && q[3] > 0)) part = 0;
      }
    }
    for (int b = 0; b < 3; ++b) {
      for (int a = 0; a < 3; ++a) {
        const int i_fine = refinement_ratio * i + a - 1, j_fine = refinement_ratio * j + b - 1;
        if (i_fine < 0 || i_fine >= shape.n1 || j_fine < 0 || j_fine >= shape.n2) continue;
        store(fine, {i_fine, j_fine}, parts.at(a, b, part, gamma));
      }
    }
  });
}

}  // namespace fsi::fluid
