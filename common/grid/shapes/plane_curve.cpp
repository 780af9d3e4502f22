#include "common/grid/shapes/plane_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/core/failure.hpp"

namespace fsi::grid {

namespace {

/// Five-point Gauss quadrature of |dx/ds|: the arclength between two nearby parameters.
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

/// Arclength from 0 up to parameters between which the curve is smooth.
struct ArclengthTable {
  std::vector<double> s, length;

  explicit ArclengthTable(const PlaneCurve& curve) {
    constexpr int pieces = 512;
    for (int m = 0; m <= pieces; ++m) s.push_back(static_cast<double>(m) / pieces);
    s.insert(s.end(), curve.corners.begin(), curve.corners.end());
    std::ranges::sort(s);
    const auto [first, last] = std::ranges::unique(s);
    s.erase(first, last);
    length.assign(s.size(), 0.0);
    for (std::size_t m = 1; m < s.size(); ++m) length[m] = length[m - 1] + arclength(curve, s[m - 1], s[m]);
  }
};

/// Parameter at a given arclength, by Newton from the table's line.
double parameter_at(const PlaneCurve& curve, const ArclengthTable& table, double length) {
  const auto above = std::upper_bound(table.length.begin() + 1, table.length.end() - 1, length);
  const auto m = static_cast<std::size_t>(above - table.length.begin()) - 1;
  const double s_a = table.s[m], s_b = table.s[m + 1];
  double s = s_a + (length - table.length[m]) / (table.length[m + 1] - table.length[m]) * (s_b - s_a);
  for (int iteration = 0; iteration < 8; ++iteration) {
    const double miss = table.length[m] + arclength(curve, s_a, s) - length;
    s -= miss / curve.slope(s).norm();
    if (std::abs(miss) < 1e-15 * table.length.back()) break;
  }
  return s;
}

/// The curve's corners as parts of its length.
std::vector<double> corner_places(const PlaneCurve& curve) {
  if (curve.even || curve.corners.empty()) return curve.corners;
  const ArclengthTable table(curve);
  std::vector<double> places;
  for (const double s : curve.corners) {
    const auto node = std::ranges::lower_bound(table.s, s);
    places.push_back(table.length[static_cast<std::size_t>(node - table.s.begin())] / table.length.back());
  }
  return places;
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

/// A point of the curve that has a number: its index where it is a real one, and where it is rounded.
struct Pin {
  double place, index;
  int number;
};

/// The ends and the corners: every corner is a point, and the points between two of them are spread evenly.
/// @throws UserMistake where the points are too few
std::vector<Pin> pins_of(const std::vector<double>& corners, int n, std::span<const PointWeight> weights,
                         Curve ends) {
  const double total = index_at(1.0, weights, ends).value;
  std::vector<Pin> pins{{.place = 0, .index = 0, .number = 0}};
  for (const double place : corners) {
    if (!(place > 0 && place < 1)) continue;
    const double index = index_at(place, weights, ends).value / total * (n - 1);
    const int number = std::max(static_cast<int>(std::lround(index)), pins.back().number + 1);
    pins.push_back({place, index, number});
  }
  pins.push_back({1, static_cast<double>(n - 1), n - 1});
  for (std::size_t k = pins.size() - 1; k > 0; --k)
    pins[k - 1].number = std::min(pins[k - 1].number, pins[k].number - 1);
  if (pins.front().number == 0) return pins;
  throw UserMistake(fmt::format(
      "{} points on a curve with {} corners are too few for a point at each of them", n, pins.size() - 2));
}

/// Arclength (part of the total) where the index is a part of its largest value.
double place_of(double part, double total, std::span<const PointWeight> weights, Curve ends) {
  const double wanted = total * part;
  double low = 0, high = 1, r = part;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const IndexAt here = index_at(r, weights, ends);
    if (!(here.slope > 0))
      throw UserMistake("point weights turn the points back; write a smaller negative strength");
    (here.value < wanted ? low : high) = r;
    double next = r - (here.value - wanted) / here.slope;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const bool done = std::abs(next - r) < 1e-16;
    r = next;
    if (done) break;
  }
  return r;
}

/// Arclengths (parts of the total) at which the index takes n values, evenly spaced from corner to corner.
std::vector<double> weighted_places(int n, std::span<const PointWeight> weights, const PlaneCurve& curve) {
  const std::vector<Pin> pins = pins_of(corner_places(curve), n, weights, curve.ends);
  const double total = index_at(1.0, weights, curve.ends).value;
  std::vector<double> places(static_cast<std::size_t>(n));
  std::size_t piece = 0;
  for (int k = 0; k < n; ++k) {
    while (piece + 2 < pins.size() && k >= pins[piece + 1].number) ++piece;
    const Pin &a = pins[piece], &b = pins[piece + 1];
    const double index = a.index + (b.index - a.index) * (k - a.number) / (b.number - a.number);
    places[static_cast<std::size_t>(k)] =
        k == a.number ? a.place : place_of(index / (n - 1), total, weights, curve.ends);
  }
  places.back() = 1;
  return places;
}

}  // namespace

double length_of(const PlaneCurve& curve) {
  if (curve.even) return curve.slope(0).norm();
  return ArclengthTable(curve).length.back();
}

std::vector<double> distribute(const PlaneCurve& curve, int n, std::span<const PointWeight> weights) {
  if (n < 3) throw UserMistake(fmt::format("{} points on a curve are too few; write at least 3", n));
  std::vector<double> places = weighted_places(n, weights, curve);
  if (curve.even) return places;
  const ArclengthTable table(curve);
  for (double& place : places) place = parameter_at(curve, table, place * table.length.back());
  places.back() = 1;
  // Corners to the bit: the curve's direction there is that of neither side.
  for (const double corner : curve.corners) {
    *std::ranges::min_element(places, {}, [corner](double s) { return std::abs(s - corner); }) = corner;
  }
  return places;
}

std::vector<double> points_at(const PlaneCurve& curve, std::span<const double> s) {
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

std::vector<double> points_on(const PlaneCurve& curve, int n, std::span<const PointWeight> weights) {
  return points_at(curve, distribute(curve, n, weights));
}

std::vector<int> corners_among(const PlaneCurve& curve, std::span<const double> s) {
  std::vector<int> corners;
  for (std::size_t k = 0; k < s.size(); ++k) {
    if (std::ranges::find(curve.corners, s[k]) != curve.corners.end()) corners.push_back(static_cast<int>(k));
  }
  return corners;
}

}  // namespace fsi::grid
