#include "common/grid/shapes/plane_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/core/failure.hpp"

namespace fsi::grid {

namespace {

/// Pieces of the parameter range between which the arclength is tabulated.
constexpr int pieces = 512;

/// Arclength between two nearby parameters: five-point Gauss quadrature of |dx/ds|.
double arclength(const PlaneCurve& curve, double s_a, double s_b) {
  constexpr double node[] = {0.0, 0.5384693101056831, 0.9061798459386640};
  constexpr double weight[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const double middle = 0.5 * (s_a + s_b), half = 0.5 * (s_b - s_a);
  double sum = weight[0] * curve.slope(middle).norm();
  for (int k = 1; k < 3; ++k) {
    sum += weight[k] *
           (curve.slope(middle - half * node[k]).norm() + curve.slope(middle + half * node[k]).norm());
  }
  return half * sum;
}

/// Arclength from 0 to m / pieces, m = 0 .. pieces.
std::vector<double> arclength_table(const PlaneCurve& curve) {
  std::vector<double> table(pieces + 1, 0.0);
  for (std::size_t m = 0; m < pieces; ++m) {
    table[m + 1] =
        table[m] + arclength(curve, static_cast<double>(m) / pieces, static_cast<double>(m + 1) / pieces);
  }
  return table;
}

/// Parameter at a given arclength, by Newton from the table's line.
double parameter_at(const PlaneCurve& curve, const std::vector<double>& table, double length) {
  const auto above = std::upper_bound(table.begin() + 1, table.end() - 1, length);
  const auto m = static_cast<std::size_t>(above - table.begin()) - 1;
  const double s_a = static_cast<double>(m) / pieces;
  double s = s_a + (length - table[m]) / (table[m + 1] - table[m]) / pieces;
  for (int iteration = 0; iteration < 8; ++iteration) {
    const double miss = table[m] + arclength(curve, s_a, s) - length;
    s -= miss / curve.slope(s).norm();
    if (std::abs(miss) < 1e-15 * table.back()) break;
  }
  return s;
}

/// Index as a function of the arclength r in [0, 1], up to a factor, and its derivative.
struct IndexAt {
  double value, slope;
};

IndexAt index_at(double r, std::span<const PointWeight> weights, Curve ends) {
  IndexAt index{r, 1.0};
  const int periods = ends == Curve::closed ? 1 : 0;
  for (const PointWeight& w : weights) {
    for (int period = -periods; period <= periods; ++period) {
      const double from = std::tanh(w.sharpness * (-w.place - period));
      const double to = std::tanh(w.sharpness * (r - w.place - period));
      index.value += 0.5 * w.strength * (to - from);
      index.slope += 0.5 * w.strength * w.sharpness * (1 - to * to);
    }
  }
  return index;
}

/// Arclengths (parts of the total) at which the index takes n evenly spaced values.
std::vector<double> weighted_places(int n, std::span<const PointWeight> weights, Curve ends) {
  std::vector<double> places(static_cast<std::size_t>(n));
  const double total = index_at(1.0, weights, ends).value;
  for (int k = 0; k < n; ++k) {
    const double wanted = total * k / (n - 1);
    double low = 0, high = 1, r = static_cast<double>(k) / (n - 1);
    for (int iteration = 0; iteration < 100; ++iteration) {
      const IndexAt here = index_at(r, weights, ends);
      if (!(here.slope > 0)) {
        throw UserMistake("point weights turn the points back; write a smaller negative strength");
      }
      (here.value < wanted ? low : high) = r;
      double next = r - (here.value - wanted) / here.slope;
      if (!(next >= low && next <= high)) next = 0.5 * (low + high);
      const bool done = std::abs(next - r) < 1e-16;
      r = next;
      if (done) break;
    }
    places[static_cast<std::size_t>(k)] = r;
  }
  places.back() = 1;
  return places;
}

}  // namespace

double length_of(const PlaneCurve& curve) {
  if (curve.even) return curve.slope(0).norm();
  return arclength_table(curve).back();
}

std::vector<double> distribute(const PlaneCurve& curve, int n, std::span<const PointWeight> weights) {
  if (n < 3) throw UserMistake(fmt::format("{} points on a curve are too few; write at least 3", n));
  std::vector<double> places = weighted_places(n, weights, curve.ends);
  if (curve.even) return places;
  const std::vector<double> table = arclength_table(curve);
  for (double& place : places) place = parameter_at(curve, table, place * table.back());
  places.back() = 1;
  return places;
}

std::vector<double> points_on(const PlaneCurve& curve, int n, std::span<const PointWeight> weights) {
  const std::vector<double> s = distribute(curve, n, weights);
  const std::size_t count = s.size();
  std::vector<double> x(2 * count);
  for (std::size_t k = 0; k < count; ++k) {
    const Vec2 position = curve.position(s[k]);
    x[k] = position[0];
    x[count + k] = position[1];
  }
  if (curve.ends == Curve::closed) {
    x[count - 1] = x[0];
    x[2 * count - 1] = x[count];
  }
  return x;
}

}  // namespace fsi::grid
