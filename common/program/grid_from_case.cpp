#include "common/program/grid_from_case.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "common/case/grids/composite_from_case.hpp"
#include "common/case/grids/grid_points.hpp"

namespace fsi {

namespace {

grid::Mapping mapping_of(const GridSpec& spec) {
  const double c = std::cos(spec.rotation), s = std::sin(spec.rotation);
  const auto turn = [c, s](double x, double y) { return Vec2(c * x - s * y, s * x + c * y); };
  if (spec.kind == GridSpec::Kind::mapped) {
    return [turn, map = spec.map](double r1, double r2, double t) {
      return turn(map.c1.at_parameters(r1, r2, t), map.c2.at_parameters(r1, r2, t));
    };
  }
  if (spec.kind == GridSpec::Kind::block)
    return [spec](double r1, double r2, double t) { return place(spec, r1, r2, t); };
  return [turn, spec](double r1, double r2, double) {
    return turn(spec.x_a + r1 * (spec.x_b - spec.x_a), spec.y_a + r2 * (spec.y_b - spec.y_a));
  };
}

}  // namespace

grid::GridDescription grid_from_case(const GridSpec& spec, bool follows) {
  return {.name = spec.name,
          .n1 = spec.n1,
          .n2 = spec.n2,
          .mapping = mapping_of(spec),
          .moving = spec.moving,
          .periodic1 = spec.periodic[0],
          .periodic2 = spec.periodic[1],
          .follows = follows,
          .shake = spec.shake,
          .shake_seed = spec.shake_seed};
}

grid::GridDescription grid_from_case(const BodyFittedSpec& spec) {
  grid::GridDescription description = grid_of(spec);
  description.follows = !spec.solid.empty();
  return description;
}

std::vector<grid::GridDescription> grids_from_case(const std::vector<BodyFittedSpec>& specs) {
  const bool bodies_move =
      std::ranges::any_of(specs, [](const BodyFittedSpec& spec) { return !spec.solid.empty(); });
  std::vector<grid::GridDescription> grids;
  for (const BodyFittedSpec& spec : specs) {
    grids.push_back(grid_of(spec));
    grids.back().follows = bodies_move;  // that of a wall, too: it leaves room for bodies that come near
  }
  return grids;
}

std::optional<io::Overlap> overlap_of(const grid::CompositeGrid* composite) {
  if (composite == nullptr) return std::nullopt;
  const grid::OverlapRecord& record = composite->record();
  io::Overlap overlap{.amplification = record.amplification,
                      .grid = {},
                      .t = record.t,
                      .implicit = record.implicit,
                      .narrowed = record.narrowed,
                      .lines_left_out = record.lines_left_out};
  if (record.amplification <= 1) return overlap;
  overlap.grid = composite->name(record.grid);
  overlap.point = {record.i, record.j};
  overlap.place = {record.x[0], record.x[1]};
  return overlap;
}

std::vector<std::uint8_t> kinds_of(const grid::CompositeGrid* composite, int grid) {
  std::vector<std::uint8_t> kinds;
  if (composite == nullptr) return kinds;
  const Layout layout = composite->layout(grid);
  kinds.assign(layout.points(), 0);
  for (int j = 0; j < layout.n2; ++j) {
    const auto row = kinds.begin() + static_cast<std::ptrdiff_t>(j) * layout.n1;
    for (const grid::Interval& run : composite->valid(grid).row(j))
      std::fill(row + run.begin, row + run.end, std::uint8_t{2});
    for (const grid::Interval& run : composite->discretised(grid).row(j))
      std::fill(row + run.begin, row + run.end, std::uint8_t{1});
  }
  return kinds;
}

}  // namespace fsi
