#include "common/case/grids/own_crossing.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <vector>

#include "common/grid/geometry/outline.hpp"

namespace fsi {

namespace {

using config::Node;

grid::Curve kind_of_ends(const CurveSpec& curve) {
  return curve.closed() ? grid::Curve::closed : grid::Curve::open;
}

/// Points x, then y, that a shape lists, the first one again at the end of a closed one; empty without a list.
std::vector<double> listed_points(const CurveSpec& curve, const Node& shape, const char* key) {
  const Node* list = shape.find(key);
  if (list == nullptr) return {};
  const std::size_t count = list->items.size(), n = count + (curve.closed() ? 1 : 0);
  std::vector<double> x(2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const Node& pair = list->items[k % count];
    x[k] = *pair.items[0].number;
    x[n + k] = *pair.items[1].number;
  }
  return x;
}

/// The pair of lines between listed points that cross.
std::string lines_that_cross(const std::vector<double>& x, const grid::Intersection& crossing, bool closed) {
  const std::size_t n = x.size() / 2, count = n - (closed ? 1 : 0);
  const auto line = [&](std::size_t k) {
    const std::size_t next = (k + 1) % count;
    return fmt::format("from its point {} ({:.6g}, {:.6g}) to {} ({:.6g}, {:.6g})", k + 1, x[k], x[n + k],
                       next + 1, x[next], x[n + next]);
  };
  return fmt::format(", where the line {} meets that {}", line(crossing.a), line(crossing.b));
}

}  // namespace

void refuse_own_crossing(const CurveSpec& curve, const Node& shape, const std::string& path) {
  const grid::Curve ends = kind_of_ends(curve);
  const std::vector<double> corners = listed_points(curve, shape, "corners");
  const std::vector<double> listed = corners.empty() ? listed_points(curve, shape, "through") : corners;
  const auto of_lines = listed.empty() ? std::nullopt : grid::self_crossing(listed, ends);
  auto crossing = grid::self_crossing(curve.x, ends);
  // Arcs may cut off the lines between corners before they cross, and leave another body than the one that was listed.
  if (!crossing && !corners.empty()) crossing = of_lines;
  if (!crossing) return;
  constexpr double unit = 1e-9;  // round-off is not shown
  const Vec2 x = (unit * (crossing->x / unit).array().round() + 0.0).matrix();
  config::fail(shape.place, path,
               fmt::format("the outline crosses itself near ({:.6g}, {:.6g}){}; list the points in their "
                           "order along the outline, once around",
                           x[0], x[1], of_lines ? lines_that_cross(listed, *of_lines, curve.closed()) : ""));
}

}  // namespace fsi
