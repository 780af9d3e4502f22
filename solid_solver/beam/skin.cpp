#include "solid_solver/beam/skin.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/grid/geometry/interface_geometry.hpp"
#include "common/wire/messages.hpp"
#include "common/wire/sparse.hpp"

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
  return {.x = foot + u.head<2>() + r, .v = v.head<2>() + v[2] * across(r), .arm = r, .theta = u[2]};
}

Skin::Skin(const Line& line, bodies::Outline outline, const std::array<End, 2>& ends,
           const std::array<bool, 2>& on_wall)
    : outline_(std::move(outline)) {
  const std::size_t n = outline_.x.size() / 2;
  for (std::size_t k = 0; k < n; ++k) places_.push_back(attach(line, {outline_.x[k], outline_.x[n + k]}));
  n_at_rest_ = grid::normals(outline_.x, outline_.ends, outline_.orientation);
  find_places_of_modes(line, ends);
  if (outline_.ends == grid::Curve::closed || line.closed) return;
  find_walls(line, ends, on_wall);
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

SkinState Skin::state(const BeamMotion& beam) const {
  const std::size_t n = points();
  SkinState state{
      .x = std::vector<double>(2 * n), .v = std::vector<double>(2 * n), .arm = std::vector<Vec2>(n)};
  for (std::size_t k = 0; k < n; ++k) {
    PointState at = state_of(beam, places_[k]);
    for (const auto& [wall, point] : {std::pair{walls_[0], std::size_t{0}}, std::pair{walls_[1], n - 1}}) {
      if (k != point || wall.isZero(0)) continue;
      const Vec2 rest(outline_.x[k], outline_.x[n + k]);
      at.x = rest + along_wall(wall, at.x - rest);
      at.v = along_wall(wall, at.v);
    }
    for (std::size_t c = 0; c < 2; ++c) {
      state.x[c * n + k] = at.x[static_cast<Eigen::Index>(c)];
      state.v[c * n + k] = at.v[static_cast<Eigen::Index>(c)];
    }
    state.arm[k] = at.arm;
  }
  return state;
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

/// The gas ends at a wall on which a free or a pinned end stands, or along which the face of one slides; at rest the
/// outline meets that wall at right angles. A section that turns or slides there would take the corner of the gas with
/// it; its other side would then push gas that the mode vectors know nothing of, and a plate much lighter than that
/// gas blows up.
void Skin::find_walls(const Line& line, const std::array<End, 2>& ends, const std::array<bool, 2>& on_wall) {
  constexpr double close = 1e-9;
  const auto last = static_cast<double>(line.x.size() - 1);
  const std::size_t n = points();
  for (const auto& [end, k] : {std::pair{std::size_t{0}, std::size_t{0}}, std::pair{std::size_t{1}, n - 1}}) {
    if (!on_wall[end]) continue;
    for (const auto& [kind, at] : {std::pair{ends[0], 0.0}, std::pair{ends[1], last}}) {
      if ((kind == End::free || kind == End::pinned) && std::abs(places_[k].s - at) <= close * last)
        walls_[end] = {-n_at_rest_[n + k], n_at_rest_[k]};
    }
  }
}

/// The entries of a point by rows; of a guided end x and y are one.
void Skin::find_places_of_modes(const Line& line, const std::array<End, 2>& ends) {
  const Eigen::SparseMatrix<double> B = free_motions(line, ends);
  const std::vector<FreeMotion> free_of = places_among(B);
  std::vector<int> starts{0}, rows;
  for (const Attached& point : places_) {
    std::vector<std::pair<int, Part>> own;
    for (std::size_t l = 0; l < point.node.size(); ++l) {
      if (point.weight[l] == 0) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        const FreeMotion free = free_of[static_cast<std::size_t>(freedom_of(point.node[l])) + c];
        if (free.column >= 0)
          own.push_back({free.column, {.component = c, .weight = point.weight[l], .part = free.part}});
      }
    }
    std::ranges::stable_sort(own, {}, &std::pair<int, Part>::first);
    for (auto& [row, part] : own) {
      const bool again = rows.size() > static_cast<std::size_t>(starts.back()) && rows.back() == row;
      if (!again) rows.push_back(row);
      part.entry = rows.size() - 1;
      parts_.push_back(part);
    }
    starts.push_back(static_cast<int>(rows.size()));
    ends_of_parts_.push_back(parts_.size());
  }
  modes_ = wire::compressed(B.cols(), starts, rows, std::vector<double>(rows.size()));
}

Eigen::SparseMatrix<double> Skin::mode_vectors(const SkinState& state,
                                               const std::vector<double>& normals) const {
  const std::size_t n = points();
  Eigen::SparseMatrix<double> N = modes_;
  double* const values = N.valuePtr();
  std::size_t next = 0;
  for (std::size_t k = 0; k < n; ++k) {
    Vec2 normal(normals[k], normals[n + k]);
    if (k == 0) normal = along_wall(walls_[0], normal);
    if (k == n - 1) normal = along_wall(walls_[1], normal);
    const std::array<double, 3> on_node{normal.x(), normal.y(), normal.dot(across(state.arm[k]))};
    for (; next < ends_of_parts_[k]; ++next) {
      const Part& part = parts_[next];
      values[part.entry] += part.weight * on_node[part.component] * part.part;
    }
  }
  return N;
}

}  // namespace fsi::beam
