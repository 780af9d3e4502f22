#include "common/grid/shapes/rounded_polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "common/core/failure.hpp"

namespace fsi::grid {

namespace {

/// A straight edge (curvature 0) or an arc, by its arclength.
struct Piece {
  double from = 0, length = 0;
  Vec2 start, direction;  ///< where it begins, and where to
  double curvature = 0;   ///< positive: turns to the left

  Vec2 normal() const { return {-direction[1], direction[0]}; }
  Vec2 position(double s) const {
    if (curvature == 0) return start + s * direction;
    const double angle = curvature * s;
    return start + (std::sin(angle) * direction + (1 - std::cos(angle)) * normal()) / curvature;
  }
  Vec2 tangent(double s) const {
    const double angle = curvature * s;
    return std::cos(angle) * direction + std::sin(angle) * normal();
  }
};

/// A corner: by how much the direction turns there, and how much of both edges its arc takes.
struct Corner {
  double turn = 0, tangent = 0;
};

Corner corner_of(const Vec2& in, const Vec2& out, double radius, const Vec2& place) {
  const double turn = std::atan2(in[0] * out[1] - in[1] * out[0], in.dot(out));
  constexpr double back = 3.12;  // 179 degrees
  if (std::abs(turn) > back)
    throw UserMistake(
        fmt::format("the edges of a polygon turn back on themselves at ({:.6g}, {:.6g}); no arc touches both",
                    place[0], place[1]));
  return {.turn = turn, .tangent = radius * std::tan(0.5 * std::abs(turn))};
}

struct Skeleton {
  std::vector<Vec2> points;      ///< closed: the first one again at the end
  std::vector<Vec2> directions;  ///< of the edges
  std::vector<double> lengths;
  std::vector<Corner> corners;  ///< at the end of each edge; of an open polygon's last one there is none
};

Skeleton skeleton_of(const RoundedPolygon& shape) {
  const bool closed = shape.ends == Curve::closed;
  if (shape.corners.size() < (closed ? 3U : 2U))
    throw UserMistake(
        fmt::format("a polygon of {} corners; write at least 2, 3 for a closed one", shape.corners.size()));
  if (!(shape.radius >= 0))
    throw UserMistake("radius of a polygon's corners; write a positive number, or 0 for sharp ones");
  Skeleton skeleton{.points = shape.corners, .directions = {}, .lengths = {}, .corners = {}};
  if (closed) skeleton.points.push_back(shape.corners.front());
  const std::size_t edges = skeleton.points.size() - 1;
  for (std::size_t k = 0; k < edges; ++k) {
    const Vec2 along = skeleton.points[k + 1] - skeleton.points[k];
    if (!(along.norm() > 0))
      throw UserMistake(
          fmt::format("corners {} and {} of a polygon coincide: leave one of them out", k + 1, k + 2));
    skeleton.directions.push_back(along.normalized());
    skeleton.lengths.push_back(along.norm());
  }
  for (std::size_t k = 0; k + (closed ? 0 : 1) < edges; ++k) {
    skeleton.corners.push_back(corner_of(skeleton.directions[k], skeleton.directions[(k + 1) % edges],
                                         shape.radius, skeleton.points[k + 1]));
  }
  return skeleton;
}

/// What the arcs at both ends leave of an edge. @throws UserMistake where that is nothing
double straight_part(const Skeleton& skeleton, std::size_t k, double before, double after, double radius) {
  const double left = skeleton.lengths[k] - before - after;
  if (left >= 0) return left;
  const Vec2 &a = skeleton.points[k], &b = skeleton.points[k + 1];
  throw UserMistake(
      fmt::format("radius {:.4g} is too large for the edge from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}), {:.4g} "
                  "long: the arcs at its "
                  "ends take {:.4g}; write at most {:.3g}",
                  radius, a[0], a[1], b[0], b[1], skeleton.lengths[k], before + after,
                  radius * skeleton.lengths[k] / (before + after)));
}

std::vector<Piece> pieces_of(const RoundedPolygon& shape) {
  const Skeleton skeleton = skeleton_of(shape);
  const bool closed = shape.ends == Curve::closed;
  const std::size_t edges = skeleton.lengths.size();
  std::vector<Piece> pieces;
  const auto add = [&](double length, const Vec2& start, const Vec2& direction, double curvature) {
    const double from = pieces.empty() ? 0 : pieces.back().from + pieces.back().length;
    if (length > 0) pieces.push_back({from, length, start, direction, curvature});
  };
  for (std::size_t k = 0; k < edges; ++k) {
    const double before = k > 0    ? skeleton.corners[k - 1].tangent
                          : closed ? skeleton.corners.back().tangent
                                   : 0;
    const double after = k < skeleton.corners.size() ? skeleton.corners[k].tangent : 0;
    const double straight = straight_part(skeleton, k, before, after, shape.radius);
    const Vec2& direction = skeleton.directions[k];
    // A closed curve begins in the middle of its first edge, away from arcs.
    const double skipped = closed && k == 0 ? 0.5 * straight : 0;
    add(straight - skipped, skeleton.points[k] + (before + skipped) * direction, direction, 0);
    if (k >= skeleton.corners.size()) continue;
    const double turn = skeleton.corners[k].turn;
    add(shape.radius * std::abs(turn), skeleton.points[k + 1] - after * direction, direction,
        (turn > 0 ? 1 : -1) / shape.radius);
  }
  if (closed) {
    const double before = skeleton.corners.back().tangent;
    const double straight =
        straight_part(skeleton, 0, before, skeleton.corners.front().tangent, shape.radius);
    add(0.5 * straight, skeleton.points[0] + before * skeleton.directions[0], skeleton.directions[0], 0);
  }
  return pieces;
}

/// Where the pieces of a polygon without arcs meet at an angle, as parts of its length.
std::vector<double> corners_of(const std::vector<Piece>& pieces, double total) {
  constexpr double straight = 1e-9;
  std::vector<double> corners;
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    if ((pieces[k].direction - pieces[k - 1].tangent(pieces[k - 1].length)).norm() > straight)
      corners.push_back(pieces[k].from / total);
  }
  return corners;
}

}  // namespace

PlaneCurve rounded_polygon(const RoundedPolygon& shape) {
  const std::vector<Piece> pieces = pieces_of(shape);
  const double total = pieces.back().from + pieces.back().length;
  const std::vector<double> corners = corners_of(pieces, total);
  const auto piece_at = [pieces, total, closed = shape.ends == Curve::closed](double s) {
    double r = closed ? s - std::floor(s) : s;
    r *= total;
    const auto next = std::ranges::upper_bound(pieces, r, {}, &Piece::from);
    const Piece& piece = next == pieces.begin() ? pieces.front() : *(next - 1);
    return std::pair{piece, r - piece.from};
  };
  const auto position = [piece_at](double s) {
    const auto [piece, r] = piece_at(s);
    return piece.position(r);
  };
  const auto slope = [piece_at, total](double s) {
    const auto [piece, r] = piece_at(s);
    return Vec2(total * piece.tangent(r));
  };
  if (shape.ends == Curve::closed)
    return {.ends = Curve::closed, .position = position, .slope = slope, .even = true, .corners = corners};
  // The ends to the bit: they stand on walls.
  return {
      .ends = shape.ends,
      .position = [position, first = shape.corners.front(), last = shape.corners.back()](double s) -> Vec2 {
        if (s == 0) return first;
        return s == 1 ? last : position(s);
      },
      .slope = slope,
      .even = true,
      .corners = corners};
}

}  // namespace fsi::grid
