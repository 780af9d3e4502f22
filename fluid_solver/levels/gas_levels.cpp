#include "fluid_solver/levels/gas_levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "common/core/failure.hpp"
#include "fluid_solver/levels/flags.hpp"

namespace fsi::fluid {

namespace {

/// Around a level, in points of the next coarser one: one that surrounds the finer one, and what the polynomials made of
/// it and the coarser one's own stencil read.
constexpr int nesting = 3;

/// Around what only the finest level can have, in points of the next coarser one: interpolation between the grids reads no
/// further, and averages are of points that are advanced.
constexpr int around_bodies = 1;

/// Points of a row between covered ones that are covered as well: two rims and one more run cost more time than the points
/// of the finer level do.
constexpr int narrow_gap = 4;

Ends ends_of(const Component& background) {
  Ends ends{};
  for (const Side side : all_sides) ends[static_cast<std::size_t>(side)] = background.facts(side).beyond;
  return ends;
}

void intersect(const grid::RowSets& a, const grid::RowSets& b, grid::RowSets& both) {
  both.clear();
  std::vector<grid::Interval> parts;
  for (int j = 0; j < a.rows(); ++j) {
    parts.clear();
    grid::intersect(a.row(j), b.row(j), parts);
    both.append(parts);
    both.end_row();
  }
}

}  // namespace

GasLevels::GasLevels(const Component& background, const Refinement& options, std::size_t first, double gamma)
    : options_(options), first_(first), gamma_(gamma), ends_(ends_of(background)) {
  const grid::MovingGrid& grid = background.grid();
  if (!background.cartesian()) {
    throw UserMistake(fmt::format(
        "grid \"{}\": only a rectangle at rest can have levels; write fluid.grid.levels: 1", grid.name()));
  }
  LatticeShape shape{grid.layout().n1, grid.layout().n2, {grid.periodic(0), grid.periodic(1)}};
  shapes_.push_back(shape);
  for (int l = 1; l < options.levels; ++l) {
    constexpr int fewest = 4;
    for (int* n : {&shape.n1, &shape.n2}) {
      if ((*n - 1) % refinement_ratio != 0 || (*n - 1) / refinement_ratio < fewest) {
        throw UserMistake(
            fmt::format("grid \"{}\": {} x {} points do not make {} levels; the points of each side less one "
                        "must be at least {} "
                        "times and a multiple of 3^(levels - 1)",
                        grid.name(), grid.layout().n1, grid.layout().n2, options.levels, fewest));
      }
      *n = (*n - 1) / refinement_ratio + 1;
    }
    shapes_.push_back(shape);
    coarse_.emplace_back().covered = CellMask(shape);
  }
  owned_.resize(shapes_.size());
}

std::vector<grid::MovingGrid> GasLevels::coarse_grids(const Component& background) const {
  const grid::CartesianGrid whole = grid::background_of(background.grid());
  std::vector<grid::MovingGrid> grids;
  for (int l = 1; l < levels(); ++l) {
    grids.emplace_back(grid::GridDescription{.name = fmt::format("{}_{}", background.grid().name(), l),
                                             .n1 = shape(l).n1,
                                             .n2 = shape(l).n2,
                                             .mapping =
                                                 [whole](double r, double s, double) {
                                                   return Vec2(whole.x_a + r * (whole.x_b - whole.x_a),
                                                               whole.y_a + s * (whole.y_b - whole.y_a));
                                                 },
                                             .periodic1 = shape(l).periodic[0],
                                             .periodic2 = shape(l).periodic[1]},
                       0);
  }
  return grids;
}

/// The points of level l > 0 that are not outside the next coarser level's covered part.
CellMask GasLevels::region(int l, const std::vector<CellMask>& covered) const {
  CellMask region(shape(l));
  if (l + 1 == levels()) {
    region.set_all(true);
  } else {
    region.add(refined(covered[static_cast<std::size_t>(l)].rows(), shape(l).n1, shape(l).n2));
  }
  return region;
}

/// covered[l - 1] belongs to level l.
void GasLevels::install(const LevelScene& scene, std::vector<CellMask> covered) {
  const std::span<Component> components = scene.components;
  CellMask outer;  // of the level above, what surrounds this one
  for (int l = levels() - 1; l > 0; --l) {
    const CellMask& here = covered[static_cast<std::size_t>(l) - 1];
    CellMask advanced = region(l, covered), valid = advanced;
    advanced.remove(here);
    CellMask restricted = advanced, prolonged = here;
    restricted.grow(1);
    restricted.intersect(here);
    prolonged.grow(1);
    prolonged.remove(here);
    if (l + 1 < levels()) valid.add(refined(at(l + 1).prolonged, shape(l).n1, shape(l).n2));
    valid.remove(here);
    valid.add(restricted);
    owned_[static_cast<std::size_t>(l)] = advanced.rows();
    Component &fine = components[component(l - 1)], &coarse = components[component(l)];
    at(l) = {.covered = here,
             .restricted = restricted.rows(),
             .prolonged = prolonged.rows(),
             .valid = valid.rows(),
             .faces = LevelFaces(here, shape(l - 1), ends_, fine.noted(), coarse.imposed()),
             .restricted_here = {},
             .prolonged_here = {},
             .to_restrict = {},
             .to_prolong = {},
             .to_match = {}};
  }
  CellMask reach = at(1).covered;
  owned_[0] = refined(reach.rows(), shape(0).n1, shape(0).n2);
  reach.add(at(1).prolonged);
  reach_ = refined(reach.rows(), shape(0).n1, shape(0).n2);
  share_out(scene);
}

void GasLevels::use_finest_points(Component& finest, const grid::CompositeGrid* composite) {
  if (composite == nullptr) {
    finest.use_points(owned_[0], reach_);
    return;
  }
  intersect(composite->discretised(0), owned_[0], both_);
  intersect(composite->valid(0), reach_, both_reach_);
  finest.use_points(both_, both_reach_);
}

void GasLevels::use_points(const LevelScene& scene) {
  use_finest_points(scene.components[0], scene.composite);
  for (int l = 1; l < levels(); ++l) scene.components[component(l)].use_points(owned(l), at(l).valid);
}

void GasLevels::match(const LevelScene& scene, int l) {
  FaceFluxes& noted = scene.components[component(l - 1)].noted();
  if (!scene.share.alone()) at(l).to_match.run(scene.share.ranks(), noted);
  at(l).faces.match(noted, scene.components[component(l)].imposed());
}

void GasLevels::average(const LevelScene& scene) {
  for (int l = 1; l < levels(); ++l) {
    const std::span<const FieldView> fields = states(scene);
    scene.share.bring(at(l).to_restrict, fields);
    restrict_to(at(l).restricted_here, fields[component(l)], fields[component(l - 1)], ends_, gamma_);
  }
}

void GasLevels::surround(const LevelScene& scene, const BoundaryTask& task) {
  const std::span<const FieldView> fields = states(scene);
  for (int l = levels() - 1; l > 0; --l) {
    set_ghosts(scene.components[component(l)], task);
    scene.share.bring(at(l).to_prolong, fields);
    prolong_from(at(l).prolonged_here, fields[component(l)], fields[component(l - 1)], gamma_);
  }
}

/// Averages of whole states, or of no more than the refined quantity, at points of level l whose control volumes the finer
/// level knows.
void GasLevels::average_at(const LevelScene& scene, int l, const grid::RowSets& points, Averaged what) {
  const std::span<const FieldView> fields = states(scene);
  if (!scene.share.alone()) {
    Delivery finer_values = averages_of(scene, l, points);
    scene.share.bring(finer_values, fields);
  }
  const grid::RowSets here = averaged_here(scene, l, points);
  const FieldView coarse = fields[component(l)], fine = fields[component(l - 1)];
  if (what == Averaged::quantity && options_.quantity == RefinedQuantity::rho) {
    restrict_density(here, coarse, fine, ends_);
  } else {
    restrict_to(here, coarse, fine, ends_, gamma_);
  }
  bring_halos(scene, l, {&points});
}

/// Averages at all wanted points whose control volumes the finer level knows.
/// @returns the points of each level that are known then: advanced or averaged
std::vector<CellMask> GasLevels::average_all(const LevelScene& scene, const std::vector<CellMask>& wanted,
                                             Averaged what) {
  std::vector<CellMask> known;
  grid::RowSets finer = scene.components[0].valid();
  for (int l = 1; l < levels(); ++l) {
    CellMask missing(shape(l)), points = wanted[static_cast<std::size_t>(l) - 1];
    mark_coarse(gaps_of(finer, shape(l - 1).n1), missing);
    points.remove(missing);
    average_at(scene, l, points.rows(), what);
    points.add(owned(l));
    finer = points.rows();
    known.push_back(std::move(points));
  }
  return known;
}

/// Points that are no longer covered get the averages they keep, finer levels first.
void GasLevels::average_uncovered(const LevelScene& scene, const std::vector<CellMask>& covered,
                                  const std::vector<CellMask>& known) {
  for (int l = 1; l < levels(); ++l) {
    const auto k = static_cast<std::size_t>(l) - 1;
    CellMask uncovered = at(l).covered;
    uncovered.remove(covered[k]);
    uncovered.intersect(known[k]);
    average_at(scene, l, uncovered.rows(), Averaged::state);
  }
}

/// A larger undivided second difference of the refined quantity asks for a finer level.
double GasLevels::least_bend(const LevelScene& scene) const {
  constexpr double endless = std::numeric_limits<double>::infinity();
  ValueRange range{endless, -endless};
  for (int l = 0; l < levels(); ++l) {
    const Component& level = scene.components[component(l)];
    widen(range, level.state(), plane(), level.discretised(), level.rows());
  }
  Ranks& ranks = scene.share.ranks();
  range = {-ranks.largest(-range.low), ranks.largest(range.high)};
  constexpr double noise = 1e-6;  // of the value itself
  return options_.threshold * std::max(range.high - range.low, noise * range.high);
}

std::vector<CellMask> GasLevels::choose(const LevelScene& scene, const std::vector<CellMask>& known) const {
  const Bends bends{.plane = plane(), .least = least_bend(scene)};
  std::vector<CellMask> covered;
  for (int l = 1; l < levels(); ++l) {
    CellMask mask(shape(l));
    const Component& level = scene.components[component(l)];
    flag_bends(level.state(), bends, known[static_cast<std::size_t>(l) - 1], level.rows(), mask);
    gather(scene, l, mask);
    mask.grow(options_.buffer);
    CellMask near(shape(l));
    if (l == 1 && scene.composite != nullptr) {
      std::vector<ConstFieldView> x;
      for (int k = 1; k < scene.composite->grids(); ++k)
        x.push_back(scene.components[static_cast<std::size_t>(k)].grid().x());
      flag_bodies(*scene.composite, x, near);
      near.grow(around_bodies + options_.buffer);
    } else if (l > 1) {
      CellMask finer = covered.back();
      finer.grow(nesting);
      mark_coarse(finer.rows(), near);
    }
    mask.add(near);
    mask.fill_gaps(narrow_gap);
    mask.close_ends();
    covered.push_back(std::move(mask));
  }
  return covered;
}

void GasLevels::start(const LevelScene& scene) {
  std::vector<CellMask> all;
  for (int l = 1; l < levels(); ++l) {
    all.emplace_back(shape(l)).set_all(true);
    owned_[static_cast<std::size_t>(l)] = CellMask(shape(l)).rows();
  }
  const std::vector<CellMask> known = average_all(scene, all, Averaged::state);
  install(scene, choose(scene, known));
  use_points(scene);
  for (int l = 0; l < levels(); ++l) scene.components[component(l)].forget_unused_points();
}

/// Some points of level l hand their state down.
void GasLevels::hand_down(const LevelScene& scene, int l, const grid::RowSets& points, Copies copies) {
  const std::span<const FieldView> fields = states(scene);
  if (!scene.share.alone()) {
    Delivery parents = parents_of(scene, l, points);
    scene.share.bring(parents, fields);
  }
  const grid::RowSets here = prolonged_here(scene, l, points);
  prolong_from(here, fields[component(l)], fields[component(l - 1)], gamma_);
  if (copies == Copies::both)
    prolong_from(here, fields[component(l)], scene.components[component(l - 1)].spare_state(), gamma_);
}

/// Points that become covered hand their state down, level by level.
void GasLevels::fill_new(const LevelScene& scene, const std::vector<CellMask>& covered,
                         const BoundaryTask& task) {
  for (int l = levels() - 1; l > 0; --l) {
    CellMask fresh = covered[static_cast<std::size_t>(l) - 1];
    fresh.remove(at(l).covered);
    hand_down(scene, l, fresh.rows(), Copies::both);
    set_ghosts(scene.components[component(l - 1)], task);
  }
}

/// What a step leaves at rims, where they are new. Elsewhere it is there, but for round-off.
void GasLevels::complete_rims(const LevelScene& scene, const std::vector<Rim>& before,
                              const BoundaryTask& task) {
  const auto old = [&](int l) -> const Rim& { return before[static_cast<std::size_t>(l) - 1]; };
  for (int l = 1; l < levels(); ++l)
    average_at(scene, l, difference(at(l).restricted, old(l).restricted), Averaged::state);
  bring_halos(scene, 0, {&scene.components[0].discretised()});
  for (int l = 1; l < levels(); ++l) bring_halos(scene, l, {&owned(l), &at(l).restricted});
  for (int l = levels() - 1; l > 0; --l) {
    set_ghosts(scene.components[component(l)], task);
    hand_down(scene, l, difference(at(l).prolonged, old(l).prolonged), Copies::state);
  }
  set_ghosts(scene.components[0], task);
}

bool GasLevels::adapt(const LevelScene& scene, const BoundaryTask& task) {
  if (++since_ < options_.every) return false;
  since_ = 0;
  std::vector<CellMask> before;
  std::vector<Rim> rims;
  for (const Level& level : coarse_) {
    before.push_back(level.covered);
    rims.push_back({level.restricted, level.prolonged});
  }
  const std::vector<CellMask> known = average_all(scene, before, Averaged::quantity);
  std::vector<CellMask> covered = choose(scene, known);
  if (covered == before) return false;
  average_uncovered(scene, covered, known);
  fill_new(scene, covered, task);
  install(scene, std::move(covered));
  use_points(scene);
  complete_rims(scene, rims, task);
  for (int l = 0; l < levels(); ++l) scene.components[component(l)].measure_rows();
  constexpr int often_enough = 300;  // steps, that features do not leave memory in use all along their way
  if (++adaptations_ % std::max(often_enough / options_.every, 1) == 0) {
    for (int l = 0; l < levels(); ++l) scene.components[component(l)].forget_unused_points();
  }
  return true;
}

/// Whether a point of level l lies in a cell of the next coarser one that has a covered corner.
bool GasLevels::closes_a_cell(int l, int i, int j) const {
  const CellMask& covered = at(l + 1).covered;
  const int low_i = (i + 2) / refinement_ratio - 1, low_j = (j + 2) / refinement_ratio - 1;
  for (int b = low_j; b <= j / refinement_ratio + 1; ++b) {
    for (int a = low_i; a <= i / refinement_ratio + 1; ++a)
      if (covered.contains(a, b)) return true;
  }
  return false;
}

void GasLevels::show_once(int l, std::span<std::uint8_t> kinds) const {
  const auto [n1, n2, periodic] = shape(l);
  std::size_t k = 0;
  for (int j = 0; j < n2; ++j) {
    for (int i = 0; i < n1; ++i, ++k) {
      if (kinds[k] != 2) continue;
      const bool finer = l > 0 && at(l).covered.contains(i, j);
      if (finer || (l + 1 < levels() && !closes_a_cell(l, i, j))) kinds[k] = 0;
    }
  }
}

void GasLevels::archive(Archive& archive) {
  archive.number("since", since_);
  for (int l = 1; l < levels(); ++l) {
    std::vector<double> runs;  // row, begin, end
    const grid::RowSets rows = at(l).covered.rows();
    for (int j = 0; j < rows.rows(); ++j) {
      for (const grid::Interval& run : rows.row(j))
        runs.insert(runs.end(),
                    {static_cast<double>(j), static_cast<double>(run.begin), static_cast<double>(run.end)});
    }
    archive.list(fmt::format("covered{}", l), runs);
    if (!archive.loading()) continue;
    at(l).covered.set_all(false);
    for (std::size_t k = 0; k + 2 < runs.size(); k += 3) {
      for (int i = static_cast<int>(runs[k + 1]); i < static_cast<int>(runs[k + 2]); ++i)
        at(l).covered.set(i, static_cast<int>(runs[k]));
    }
  }
}

void GasLevels::restore(const LevelScene& scene) {
  std::vector<CellMask> covered;
  for (const Level& level : coarse_) covered.push_back(level.covered);
  install(scene, std::move(covered));
  use_points(scene);
}

}  // namespace fsi::fluid
