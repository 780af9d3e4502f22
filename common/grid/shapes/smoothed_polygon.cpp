#include "common/grid/shapes/smoothed_polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "common/core/failure.hpp"

namespace fsi::grid {

namespace {

/// log(2 cosh a) for any a.
double log_cosh(double a) {
  return std::abs(a) + std::log1p(std::exp(-2 * std::abs(a)));
}

/// One straight edge between the parameters `from` and `to`.
struct Edge {
  double from, to, sharpness;
  Vec2 slope;
  Vec2 base;  ///< of the line along which edges are added: the polygon's length in both directions

  /// V of numerics: what the edge adds to s.
  Vec2 rise(double s) const {
    const double steps = log_cosh(sharpness * (s - from)) - log_cosh(sharpness * (s - to));
    return (slope - base) * steps / (2 * sharpness);
  }
  /// How far the bell's averages at the edge's ends lie from the polygon at s.
  Vec2 rounding(double s) const {
    const double steps = log_cosh(sharpness * (s - from)) - sharpness * std::abs(s - from) -
                         log_cosh(sharpness * (s - to)) + sharpness * std::abs(s - to);
    return (slope - base) * steps / (2 * sharpness);
  }
  Vec2 rise_slope(double s) const {
    return 0.5 * (slope - base) * (std::tanh(sharpness * (s - from)) - std::tanh(sharpness * (s - to)));
  }
};

struct Outline {
  std::vector<Edge> edges;
  Vec2 constant;  ///< x(s) = constant + s base + sum of the edges' rises

  Vec2 position(double s) const {
    Vec2 x = constant + s * edges.front().base;
    for (const Edge& edge : edges) x += edge.rise(s);
    return x;
  }
  Vec2 slope(double s) const {
    Vec2 d = edges.front().base;
    for (const Edge& edge : edges) d += edge.rise_slope(s);
    return d;
  }
};

void check(const SmoothedPolygon& shape, std::size_t edges) {
  if (shape.corners.size() < (shape.ends == Curve::closed ? 3U : 2U)) {
    throw UserMistake(fmt::format("a smoothed polygon of {} corners; write at least 2, 3 for a closed one",
                                  shape.corners.size()));
  }
  if (!shape.sharpness_at.empty() && shape.sharpness_at.size() != edges) {
    throw UserMistake(fmt::format("{} sharpnesses for the {} edges of a smoothed polygon",
                                  shape.sharpness_at.size(), edges));
  }
  const bool positive = std::ranges::all_of(shape.sharpness_at, [](double e) { return e > 0; });
  if (!(shape.sharpness > 0) || !positive) {
    throw UserMistake("sharpness of a smoothed polygon; write a positive number (50 rounds gently)");
  }
}

/// The edges between the corners, by normalised arclength.
std::vector<Edge> edges_of(const SmoothedPolygon& shape) {
  std::vector<Vec2> corners = shape.corners;
  if (shape.ends == Curve::closed) corners.push_back(corners.front());
  const std::size_t n = corners.size() - 1;
  check(shape, n);
  double total = 0;
  for (std::size_t k = 0; k < n; ++k) total += (corners[k + 1] - corners[k]).norm();
  std::vector<Edge> edges;
  double from = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double width = (corners[k + 1] - corners[k]).norm() / total;
    if (!(width > 0))
      throw UserMistake(
          fmt::format("corners {} and {} of a smoothed polygon coincide: leave one of them out", k, k + 1));
    const double sharpness = shape.sharpness_at.empty() ? shape.sharpness : shape.sharpness_at[k];
    edges.push_back(
        {from, from + width, sharpness, (corners[k + 1] - corners[k]) / width, Vec2::Constant(total)});
    from += width;
  }
  return edges;
}

/// Open: the first and the last edge go on straight; x(0) is the first corner.
Outline open_outline(std::vector<Edge> edges, const Vec2& first) {
  edges.front().from = -1;
  edges.back().to = 2;
  Outline outline{std::move(edges), first};
  outline.constant -= outline.position(0) - first;
  return outline;
}

/// Periods on each side that an edge is felt in: e^(-2 e periods) is round-off.
int periods_felt(const std::vector<Edge>& edges) {
  constexpr double round_off = 18;  // e^-36
  const Edge& bluntest = *std::ranges::min_element(edges, {}, &Edge::sharpness);
  return std::max(2, static_cast<int>(std::ceil(round_off / bluntest.sharpness)));
}

/// Closed: neighbouring periods belong to it, and x(s) is the polygon averaged with the bell. It is placed by
/// that average at the middle of the longest edge; any other point gives the same.
Outline closed_outline(const std::vector<Edge>& edges, const std::vector<Vec2>& corners) {
  Outline outline{{}, Vec2::Zero()};
  const int periods = periods_felt(edges);
  for (int period = -periods; period <= periods; ++period) {
    for (Edge edge : edges) {
      edge.from += period;
      edge.to += period;
      outline.edges.push_back(edge);
    }
  }
  const auto longest = std::ranges::max_element(edges, {}, [](const Edge& e) { return e.to - e.from; });
  const auto k = static_cast<std::size_t>(longest - edges.begin());
  const double s = 0.5 * (longest->from + longest->to);
  Vec2 average = 0.5 * (corners[k] + corners[(k + 1) % corners.size()]);
  for (const Edge& edge : outline.edges) average += edge.rounding(s);
  outline.constant = average - outline.position(s);
  return outline;
}

/// Averages over half the curve and more draw it together to a point.
[[noreturn]] void too_blunt(const Edge& edge) {
  throw UserMistake(
      fmt::format("sharpness {:.4g} is too blunt: less than half of the polygon's length is left; write a "
                  "greater one (10 makes a square nearly round, with 50 its edges are straight)",
                  edge.sharpness));
}

/// A closed polygon with rounded corners. @throws UserMistake where nothing of it is left
PlaneCurve closed_polygon(const std::vector<Edge>& edges, const std::vector<Vec2>& corners) {
  const Edge& bluntest = *std::ranges::min_element(edges, {}, &Edge::sharpness);
  if (bluntest.sharpness < 1) too_blunt(bluntest);
  const Outline outline = closed_outline(edges, corners);
  const PlaneCurve curve{.ends = Curve::closed,
                         .position = [outline](double s) { return outline.position(s); },
                         .slope = [outline](double s) { return outline.slope(s); }};
  double length = 0;
  for (const Edge& edge : edges) length += edge.slope.norm() * (edge.to - edge.from);
  if (length_of(curve) < 0.5 * length) too_blunt(bluntest);
  return curve;
}

}  // namespace

PlaneCurve smoothed_polygon(const SmoothedPolygon& shape) {
  const std::vector<Edge> edges = edges_of(shape);
  if (shape.ends == Curve::closed) return closed_polygon(edges, shape.corners);
  const Outline outline = open_outline(edges, shape.corners.front());
  // The ends to the bit: they stand on walls.
  return {
      .ends = shape.ends,
      .position = [outline, first = shape.corners.front(), last = shape.corners.back()](double s) -> Vec2 {
        if (s == 0) return first;
        return s == 1 ? last : outline.position(s);
      },
      .slope = [outline](double s) { return outline.slope(s); }};
}

}  // namespace fsi::grid
