#include "common/case/grids/own_crossing.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <vector>

#include "common/grid/geometry/outline.hpp"

namespace fsi {

namespace {

using config::Node;

grid::Curve kind_of_ends(const CurveSpec& curve) {
  return curve.closed() ? grid::Curve::closed : grid::Curve::open;
}

/// The pair of lines between the listed points of a shape that cross; "" where none do.
std::string crossing_in_list(const CurveSpec& curve, const Node& shape) {
  const Node* list = shape.find("corners");
  if (list == nullptr) list = shape.find("through");
  if (list == nullptr) return "";
  const std::size_t count = list->items.size(), n = count + (curve.closed() ? 1 : 0);
  std::vector<double> x(2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const Node& pair = list->items[k % count];
    x[k] = *pair.items[0].number;
    x[n + k] = *pair.items[1].number;
  }
  const auto crossing = grid::self_crossing(x, kind_of_ends(curve));
  if (!crossing) return "";
  const auto line = [&](std::size_t k) {
    const std::size_t next = (k + 1) % count;
    return fmt::format("from its point {} ({:.4g}, {:.4g}) to {} ({:.4g}, {:.4g})", k + 1, x[k], x[n + k],
                       next + 1, x[next], x[n + next]);
  };
  return fmt::format(", where the line {} meets that {}", line(crossing->a), line(crossing->b));
}

}  // namespace

void refuse_own_crossing(const CurveSpec& curve, const Node& shape, const std::string& path) {
  const auto crossing = grid::self_crossing(curve.x, kind_of_ends(curve));
  if (!crossing) return;
  constexpr double unit = 1e-9;  // round-off is not shown
  const Vec2 x = (unit * (crossing->x / unit).array().round() + 0.0).matrix();
  config::fail(shape.place, path,
               fmt::format("the outline crosses itself near ({:.4g}, {:.4g}){}; list the points in their "
                           "order along the outline, once around",
                           x[0], x[1], crossing_in_list(curve, shape)));
}

}  // namespace fsi
