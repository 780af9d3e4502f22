#include "common/grid/shapes/blunted.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "common/core/failure.hpp"

namespace fsi::grid {

namespace {

double around(double s) {
  return s - std::floor(s);
}

/// Turn of the direction at a parameter, without sign.
double turn_at(const PlaneCurve& curve, double s) {
  constexpr double beside = 1e-9;
  const Vec2 in = curve.slope(around(s - beside)), out = curve.slope(s + beside);
  return std::abs(std::atan2(in[0] * out[1] - in[1] * out[0], in.dot(out)));
}

/// How far before and after a corner, in the parameter, its sides are a width apart.
double reach_of(const PlaneCurve& curve, double corner, double width, double most) {
  const auto apart = [&](double reach) {
    return (curve.position(around(corner - reach)) - curve.position(around(corner + reach))).norm();
  };
  if (const double widest = apart(most); !(widest > width)) {
    const Vec2 x = curve.position(corner);
    constexpr double most_of = 0.9;
    throw UserMistake(fmt::format(
        "the sides of the sharp corner at ({:.6g}, {:.6g}) are not {:.3g} apart anywhere before the "
        "next corner, where the corner would be cut off; write `blunt: {:.2g}` or less",
        x[0], x[1], width, most_of * widest));
  }
  double low = 0, high = most;
  constexpr int halvings = 60;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (low + high);
    (apart(middle) < width ? low : high) = middle;
  }
  return high;
}

/// A stretch of the old curve, or a face from its one end to the other.
struct Stretch {
  double from = 0, to = 0;  ///< new parameter
  double a = 0, b = 0;      ///< old parameter of its ends
  bool face = false;
};

struct Cut {
  double corner, reach;
};

std::vector<Cut> cuts_of(const PlaneCurve& curve, double width) {
  std::vector<Cut> cuts;
  const std::size_t n = curve.corners.size();
  const bool closed = curve.ends == Curve::closed;
  for (std::size_t k = 0; k < n; ++k) {
    const double corner = curve.corners[k];
    if (!(turn_at(curve, corner) > largest_fan)) continue;
    const double before = k > 0 ? curve.corners[k - 1] : closed ? curve.corners[n - 1] - 1 : 0;
    const double after = k + 1 < n ? curve.corners[k + 1] : closed ? curve.corners[0] + 1 : 1;
    constexpr double room = 0.45;  // two corners may share a side
    cuts.push_back(
        {corner, reach_of(curve, corner, width, room * std::min(corner - before, after - corner))});
  }
  return cuts;
}

/// Stretches and faces in their order, by old parameters; of a closed curve from its first cut on.
std::vector<Stretch> stretches_of(const PlaneCurve& curve, const std::vector<Cut>& cuts) {
  std::vector<Stretch> parts;
  const bool closed = curve.ends == Curve::closed;
  double from = closed ? cuts.front().corner + cuts.front().reach : 0;
  for (std::size_t k = closed ? 1 : 0; k < cuts.size(); ++k) {
    const auto [corner, reach] = cuts[k];
    parts.push_back({.a = from, .b = corner - reach});
    parts.push_back({.a = corner - reach, .b = corner + reach, .face = true});
    from = corner + reach;
  }
  if (closed) {
    const auto [corner, reach] = cuts.front();
    parts.push_back({.a = from, .b = corner + 1 - reach});
    parts.push_back({.a = corner + 1 - reach, .b = corner + 1 + reach, .face = true});
  } else {
    parts.push_back({.a = from, .b = 1});
  }
  double place = 0;
  for (Stretch& part : parts) {
    part.from = place;
    place += part.b - part.a;
    part.to = place;
  }
  parts.back().to = 1;
  return parts;
}

/// Corners of the new curve: those that stay, and the ends of the faces.
std::vector<double> new_corners(const PlaneCurve& curve, const std::vector<Stretch>& parts) {
  std::vector<double> corners;
  if (curve.ends == Curve::closed) corners.push_back(0);
  for (const Stretch& part : parts) {
    if (part.face) {
      corners.push_back(part.from);
      if (part.to < 1) corners.push_back(part.to);
      continue;
    }
    for (const double period : {0.0, 1.0}) {
      for (const double corner : curve.corners) {
        const double old = corner + period;
        if (old > part.a && old < part.b) corners.push_back(part.from + old - part.a);
      }
    }
  }
  std::ranges::sort(corners);
  return corners;
}

struct Blunted {
  PlaneCurve curve;
  std::vector<Stretch> parts;

  const Stretch& part_at(double s) const {
    const auto next = std::ranges::upper_bound(parts, s, {}, &Stretch::from);
    return next == parts.begin() ? parts.front() : *(next - 1);
  }
  double old_parameter(const Stretch& part, double s) const {
    const double old = part.a + (s - part.from);
    return curve.ends == Curve::closed ? around(old) : std::min(old, 1.0);
  }
  Vec2 across(const Stretch& face) const {
    return curve.position(around(face.b)) - curve.position(around(face.a));
  }
  Vec2 position(double s) const {
    const Stretch& part = part_at(s);
    if (!part.face) return curve.position(old_parameter(part, s));
    return curve.position(around(part.a)) + (s - part.from) / (part.to - part.from) * across(part);
  }
  Vec2 slope(double s) const {
    const Stretch& part = part_at(s);
    return part.face ? Vec2(across(part) / (part.to - part.from)) : curve.slope(old_parameter(part, s));
  }
};

}  // namespace

PlaneCurve blunted(const PlaneCurve& curve, double width) {
  const std::vector<Cut> cuts = cuts_of(curve, width);
  if (cuts.empty()) return curve;
  const auto shared = std::make_shared<const Blunted>(Blunted{curve, stretches_of(curve, cuts)});
  const bool closed = curve.ends == Curve::closed;
  return {.ends = curve.ends,
          .position = [shared, closed](double s) { return shared->position(closed ? around(s) : s); },
          .slope = [shared, closed](double s) { return shared->slope(closed ? around(s) : s); },
          .even = false,
          .corners = new_corners(curve, shared->parts)};
}

std::vector<CutCorner> cut_corners(const PlaneCurve& curve, double width) {
  std::vector<CutCorner> result;
  for (const Cut& cut : cuts_of(curve, width)) {
    const Vec2 at = curve.position(cut.corner);
    const Vec2 face = 0.5 * (curve.position(around(cut.corner - cut.reach)) +
                             curve.position(around(cut.corner + cut.reach)));
    result.push_back({.at = at, .loss = (at - face).norm()});
  }
  return result;
}

}  // namespace fsi::grid
