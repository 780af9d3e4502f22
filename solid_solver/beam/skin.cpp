#include "solid_solver/beam/skin.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/grid/geometry/interface_geometry.hpp"
#include "common/wire/messages.hpp"

namespace fsi::beam {

namespace {

Vec2 turned(double angle, const Vec2& r) {
  return {std::cos(angle) * r.x() - std::sin(angle) * r.y(),
          std::sin(angle) * r.x() + std::cos(angle) * r.y()};
}

Vec2 across(const Vec2& r) {
  return {-r.y(), r.x()};
}

/// Where on the polygon of the nodes a point is nearest, in elements.
double nearest(const Line& line, const Vec2& x) {
  const std::size_t nodes = line.x.size(), elements = line.closed ? nodes : nodes - 1;
  double best = std::numeric_limits<double>::infinity(), s = 0;
  for (std::size_t k = 0; k < elements; ++k) {
    const Vec2 a = line.x[k], d = line.x[(k + 1) % nodes] - a;
    const double part = std::clamp((x - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
    const double distance = (a + part * d - x).norm();
    if (!(distance < best)) continue;
    best = distance;
    s = static_cast<double>(k) + part;
  }
  return s;
}

}  // namespace

Attached attach(const Line& line, const Vec2& x) {
  const int nodes = static_cast<int>(line.x.size());
  Attached point{.s = nearest(line, x)};
  int first = static_cast<int>(point.s) - 1;
  if (!line.closed) first = std::clamp(first, 0, nodes - 4);
  Vec2 foot = Vec2::Zero();
  for (int k = 0; k < 4; ++k) {
    const auto i = static_cast<std::size_t>(k);
    point.node[i] = (first + k + nodes) % nodes;
    point.weight[i] = 1;
    for (int l = 0; l < 4; ++l) {
      if (l != k) point.weight[i] *= (point.s - (first + l)) / (k - l);
    }
    foot += point.weight[i] * line.x[static_cast<std::size_t>(point.node[i])];
  }
  point.r = x - foot;
  return point;
}

PointState state_of(const BeamMotion& beam, const Attached& point) {
  Eigen::Vector3d u = Eigen::Vector3d::Zero(), v = Eigen::Vector3d::Zero();
  Vec2 foot = Vec2::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const int node = point.node[k];
    u += point.weight[k] * beam.u().segment<3>(freedom_of(node));
    v += point.weight[k] * beam.u_dot().segment<3>(freedom_of(node));
    foot += point.weight[k] * beam.model().line().x[static_cast<std::size_t>(node)];
  }
  const Vec2 r = turned(u[2], point.r);
  return {.x = foot + u.head<2>() + r, .v = v.head<2>() + v[2] * across(r), .theta = u[2]};
}

Skin::Skin(const Line& line, rigid::Outline outline, const std::array<End, 2>& ends)
    : outline_(std::move(outline)) {
  const std::size_t n = outline_.x.size() / 2;
  for (std::size_t k = 0; k < n; ++k) places_.push_back(attach(line, {outline_.x[k], outline_.x[n + k]}));
  n_at_rest_ = grid::normals(outline_.x, outline_.ends, outline_.orientation);
  if (outline_.ends == grid::Curve::closed || line.closed) return;
  const auto cannot_turn = [&](const Attached& point) {
    constexpr double close = 1e-9;
    const auto last = static_cast<double>(line.x.size() - 1);
    for (const auto& [end, s] : {std::pair{ends[0], 0.0}, std::pair{ends[1], last}}) {
      if ((end == End::clamped || end == End::guided) && std::abs(point.s - s) <= close * last) return true;
    }
    return false;
  };
  upright_ = {cannot_turn(places_.front()), cannot_turn(places_.back())};
}

std::vector<double> Skin::positions(const BeamMotion& beam) const {
  const std::size_t n = points();
  std::vector<double> x(2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 at = state_of(beam, places_[k]).x;
    x[k] = at.x();
    x[n + k] = at.y();
  }
  return x;
}

std::vector<double> Skin::velocities(const BeamMotion& beam) const {
  const std::size_t n = points();
  std::vector<double> v(2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 at = state_of(beam, places_[k]).v;
    v[k] = at.x();
    v[n + k] = at.y();
  }
  return v;
}

std::vector<double> Skin::normals(const std::vector<double>& x) const {
  std::vector<double> normals = grid::normals(x, outline_.ends, outline_.orientation);
  const std::size_t n = points();
  for (const auto& [upright, k] : {std::pair{upright_[0], std::size_t{0}}, std::pair{upright_[1], n - 1}}) {
    if (!upright) continue;
    normals[k] = n_at_rest_[k];
    normals[n + k] = n_at_rest_[n + k];
  }
  return normals;
}

std::vector<std::uint8_t> Skin::freedom() const {
  std::vector<std::uint8_t> marks(points(), wire::Freedom::free);
  if (upright_[0]) marks.front() = wire::Freedom::slides;
  if (upright_[1]) marks.back() = wire::Freedom::slides;
  return marks;
}

Eigen::SparseMatrix<double> Skin::mode_vectors(const BeamMotion& beam,
                                               const std::vector<double>& normals) const {
  const std::size_t n = points();
  std::vector<int> starts{0}, rows;
  std::vector<double> values;
  for (std::vector<int>* indices : {&starts, &rows}) indices->reserve(12 * n + 1);
  values.reserve(12 * n);
  std::array<std::pair<int, double>, 12> column;
  for (std::size_t k = 0; k < n; ++k) {
    const Attached& point = places_[k];
    const Vec2 normal(normals[k], normals[n + k]);
    const double turning = normal.dot(across(turned(state_of(beam, point).theta, point.r)));
    const std::array<double, 3> on_node{normal.x(), normal.y(), turning};
    auto last = column.begin();
    for (std::size_t l = 0; l < 4; ++l) {
      if (point.weight[l] == 0) continue;
      for (int c = 0; c < 3; ++c) {
        const FreeMotion free = beam.free_motion(freedom_of(point.node[l]) + c);
        const double value = point.weight[l] * on_node[static_cast<std::size_t>(c)] * free.part;
        if (free.column >= 0) *last++ = {free.column, value};
      }
    }
    std::sort(column.begin(), last, [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto entry = column.begin(); entry != last; ++entry) {
      const bool again = rows.size() > static_cast<std::size_t>(starts.back()) && rows.back() == entry->first;
      if (again) {
        values.back() += entry->second;  // x and y of a guided end
      } else {
        rows.push_back(entry->first);
        values.push_back(entry->second);
      }
    }
    starts.push_back(static_cast<int>(rows.size()));
  }
  return Eigen::Map<const Eigen::SparseMatrix<double>>(beam.modes(), static_cast<Eigen::Index>(n),
                                                       static_cast<Eigen::Index>(values.size()),
                                                       starts.data(), rows.data(), values.data());
}

}  // namespace fsi::beam
