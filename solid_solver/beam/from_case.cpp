#include "solid_solver/beam/from_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "common/case/schema/boundary_facts.hpp"
#include "common/core/failure.hpp"
#include "common/grid/moving_grid.hpp"
#include "common/grid/shapes/spline.hpp"
#include "common/program/grid_from_case.hpp"

namespace fsi::beam {

namespace {

[[noreturn]] void refuse(const SolidSpec& spec, const std::string& what) {
  throw UserMistake(fmt::format("solid \"{}\" is a beam: {}", spec.name, what));
}

/// Nodes at equal distances along a spline.
Line spline_line(const BeamSpec& spec) {
  const grid::PlaneCurve curve =
      grid::spline(spec.line, spec.closed ? grid::Curve::closed : grid::Curve::open);
  Line line{.x = {}, .alpha = {}, .closed = spec.closed};
  std::vector<double> at = grid::distribute(curve, spec.elements + 1);
  if (spec.closed) at.pop_back();  // the first one again
  for (const double s : at) {
    const Vec2 slope = curve.slope(s);
    double alpha = std::atan2(slope.y(), slope.x());
    if (!line.alpha.empty())
      alpha = line.alpha.back() + std::remainder(alpha - line.alpha.back(), 2 * std::numbers::pi);
    line.x.push_back(curve.position(s));
    line.alpha.push_back(alpha);
  }
  return line;
}

Line line_of(const BeamSpec& spec) {
  return spec.line.size() == 2 ? straight_line(spec.line[0], spec.line[1], spec.elements) : spline_line(spec);
}

std::vector<Section> sections_of(const SolidSpec& spec, const Line& line) {
  std::vector<Section> sections;
  for (std::size_t k = 0; k < static_cast<std::size_t>(spec.beam->elements); ++k) {
    const Vec2 middle = 0.5 * (line.x[k] + line.x[(k + 1) % line.x.size()]);
    const double d = spec.beam->thickness(middle.x(), middle.y(), 0);
    if (!(d > 0) || !std::isfinite(d)) {
      refuse(spec,
             fmt::format("its thickness is {:.6g} at ({:.6g}, {:.6g}); let it be positive along the line", d,
                         middle.x(), middle.y()));
    }
    sections.push_back(plate_section(spec.rho, spec.lambda, spec.mu, d));
  }
  return sections;
}

bool is_interface(const BoundarySpec& boundary) {
  return boundary.kind == BoundaryKind::interface;
}

struct Surface {
  bodies::Outline outline;
  bool meets_gas = false;
  std::array<bool, 2> on_wall{false, false};  ///< its first and last point
};

/// Whether the first and the last point of a side slide along walls.
std::array<bool, 2> ends_on_walls(const SolidSpec& spec, Side side) {
  const auto slides = [&](Side beside) {
    const BoundaryKind kind = spec.boundary[static_cast<std::size_t>(beside)].kind;
    return schema::solid_boundary(kind).holds == Hold::normal;
  };
  if (direction_of(side) == 0) return {slides(Side::bottom), slides(Side::top)};
  return {slides(Side::left), slides(Side::right)};
}

/// One for each gas that the beam meets; one of a beam alone.
std::vector<Surface> surfaces_of(const SolidSpec& spec) {
  if (!spec.body_fitted.empty()) {
    const BodyFittedSpec& fitted = spec.body_fitted.front();
    return {{.outline = {.x = fitted.curve.x,
                         .ends = fitted.curve.closed() ? grid::Curve::closed : grid::Curve::open,
                         .orientation = grid::outward(fitted.side)},
             .meets_gas = is_interface(fitted.boundary[static_cast<std::size_t>(fitted.side)])}};
  }
  const grid::MovingGrid grid(grid_from_case(spec.grid, false), 0);
  const auto along = [&](Side side, bool meets_gas) -> Surface {
    return {.outline = {.x = grid.side_points(side),
                        .ends = grid::Curve::open,
                        .orientation = grid::outward(side)},
            .meets_gas = meets_gas,
            .on_wall = ends_on_walls(spec, side)};
  };
  std::vector<Surface> surfaces;
  for (const Side side : all_sides) {
    if (is_interface(spec.boundary[static_cast<std::size_t>(side)])) surfaces.push_back(along(side, true));
  }
  if (surfaces.empty()) surfaces.push_back(along(Side::top, false));
  return surfaces;
}

/// Velocities of the nodes, and of the sections the rate at which these turn the line.
Eigen::VectorXd initial_velocities(const Line& line, const VectorExpressions& v) {
  const auto nodes = static_cast<int>(line.x.size());
  const auto value = [&](int node) {
    const Vec2& x = line.x[static_cast<std::size_t>(node)];
    return Vec2(v.c1(x.x(), x.y(), 0), v.c2(x.x(), x.y(), 0));
  };
  Eigen::VectorXd rates(3 * nodes);
  for (int node = 0; node < nodes; ++node) {
    const int before = line.closed ? (node + nodes - 1) % nodes : std::max(node - 1, 0);
    const int after = line.closed ? (node + 1) % nodes : std::min(node + 1, nodes - 1);
    const Vec2 d = line.x[static_cast<std::size_t>(after)] - line.x[static_cast<std::size_t>(before)];
    const Vec2 change = value(after) - value(before);
    rates.segment<2>(freedom_of(node)) = value(node);
    rates[3 * node + 2] = (d.x() * change.y() - d.y() * change.x()) / d.squaredNorm();
  }
  return rates;
}

}  // namespace

BeamFromCase beam_from_case(const SolidSpec& spec) {
  if (!spec.beam) refuse(spec, "its section `beam` is missing");
  if (spec.initial_from_reference || spec.initial_u) refuse(spec, "initial may give `v`, and nothing else");
  const std::array<End, 2>& ends = spec.beam->ends;
  Line line = line_of(*spec.beam);
  std::vector<Section> sections = sections_of(spec, line);
  std::vector<Skin> skins;
  bool meets_gas = false;
  for (Surface& surface : surfaces_of(spec)) {
    meets_gas = surface.meets_gas;
    skins.emplace_back(line, std::move(surface.outline), ends, surface.on_wall);
  }
  BeamFromCase result{.motion = BeamMotion(BeamModel(std::move(line), std::move(sections)), ends),
                      .skins = std::move(skins),
                      .meets_gas = meets_gas};
  if (spec.initial_v) result.motion.start(initial_velocities(result.motion.model().line(), *spec.initial_v));
  return result;
}

}  // namespace fsi::beam
