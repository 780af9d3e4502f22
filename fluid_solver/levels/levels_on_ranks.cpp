/// The levels of a background on several ranks: what each of them averages and fills, and what others bring for that.

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "fluid_solver/levels/gas_levels.hpp"

namespace fsi::fluid {

namespace {

/// The rows of a set that a rank has to do with; the others are empty.
template <class Concerns>
grid::RowSets rows_where(const grid::RowSets& points, const Concerns& concerns) {
  grid::RowSets some;
  for (int j = 0; j < points.rows(); ++j) {
    if (concerns(j)) some.append(points.row(j));
    some.end_row();
  }
  return some;
}

/// Whether one of the three fine rows of coarse row j is wanted.
template <class Wanted>
bool any_fine_row(int j, int fine_rows, const Wanted& wanted) {
  const int middle = refinement_ratio * j;
  for (int row = std::max(middle - 1, 0); row <= std::min(middle + 1, fine_rows - 1); ++row) {
    if (wanted(row)) return true;
  }
  return false;
}

}  // namespace

std::span<const FieldView> GasLevels::states(const LevelScene& scene) {
  fields_.clear();
  for (Component& component : scene.components) fields_.push_back(component.state());
  return fields_;
}

grid::RowSets GasLevels::averaged_here(const LevelScene& scene, int l, const grid::RowSets& points) const {
  const RankRows& rows = scene.components[component(l)].rows();
  return rows_where(points, [&](int j) { return rows.owns(j); });
}

/// Points of level l whose fine points are in rows that this rank has.
grid::RowSets GasLevels::prolonged_here(const LevelScene& scene, int l, const grid::RowSets& points) const {
  const RankRows& rows = scene.components[component(l - 1)].rows();
  return rows_where(points, [&](int j) {
    return any_fine_row(j, shape(l - 1).n2, [&](int row) { return rows.has(row); });
  });
}

/// The fine points of the averages at some points of level l, for the owners of their rows.
Delivery GasLevels::averages_of(const LevelScene& scene, int l, const grid::RowSets& points) const {
  Delivery delivery = scene.share.nothing_yet();
  need_averages(scene, l, points, delivery);
  delivery.close();
  return delivery;
}

void GasLevels::need_averages(const LevelScene& scene, int l, const grid::RowSets& points,
                              Delivery& delivery) const {
  const int coarse = static_cast<int>(component(l)), fine = static_cast<int>(component(l - 1));
  const LatticeShape &here = shape(l), &finer = shape(l - 1);
  for (int j = 0; j < points.rows(); ++j) {
    if (points.row(j).empty()) continue;
    const int rank = scene.share.cut().owner(coarse, j);
    const Members rows = members_of(j, finer.n2, {ends_[2], ends_[3]});
    for (std::size_t m = 0; m < static_cast<std::size_t>(rows.n); ++m) {
      for (const auto& [begin, end] : points.row(j)) {
        delivery.need(rank, {fine, rows.at[m], std::max(refinement_ratio * begin - 1, 0),
                             std::min(refinement_ratio * end - 1, finer.n1)});
        if (!here.periodic[0] || (begin > 0 && end < here.n1)) continue;
        delivery.need(rank, {fine, rows.at[m], 0, 2});
        delivery.need(rank, {fine, rows.at[m], finer.n1 - 2, finer.n1});
      }
    }
  }
}

/// Whether averages of level l are made of points that are averages themselves. Nesting keeps them apart; over the ends
/// of a period nobody looks.
bool GasLevels::averages_averages(int l) const {
  if (shape(l).periodic[0] || shape(l).periodic[1]) return true;
  const grid::RowSets fine = refined(at(l).restricted, shape(l - 1).n1, shape(l - 1).n2);
  std::vector<grid::Interval> both;
  for (int j = 0; j < fine.rows() && both.empty(); ++j)
    grid::intersect(fine.row(j), at(l - 1).restricted.row(j), both);
  return !both.empty();
}

/// What the averages of a level need is brought with that of the level before where it is there then.
void GasLevels::plan_averages(const LevelScene& scene) {
  Delivery* delivery = nullptr;
  for (int l = 1; l < levels(); ++l) {
    at(l).to_restrict = scene.share.nothing_yet();
    if (l == 1 || averages_averages(l)) {
      if (delivery != nullptr) delivery->close();
      delivery = &at(l).to_restrict;
    }
    need_averages(scene, l, at(l).restricted, *delivery);
  }
  if (delivery != nullptr) delivery->close();
}

/// The points of level l that polynomials at some of its points are made of, ghosts included, for all who have fine
/// points there.
Delivery GasLevels::parents_of(const LevelScene& scene, int l, const grid::RowSets& points) const {
  Delivery delivery = scene.share.nothing_yet();
  const int coarse = static_cast<int>(component(l)), fine = static_cast<int>(component(l - 1));
  for (int j = 0; j < points.rows(); ++j) {
    if (points.row(j).empty()) continue;
    for (int rank = 0; rank < scene.share.ranks().size(); ++rank) {
      const auto has = [&](int row) { return scene.share.has(rank, fine, row); };
      if (!any_fine_row(j, shape(l - 1).n2, has)) continue;
      for (int row = j - 1; row <= j + 1; ++row) {
        for (const auto& [begin, end] : points.row(j)) delivery.need(rank, {coarse, row, begin - 1, end + 1});
      }
    }
  }
  delivery.close();
  return delivery;
}

/// A face between rows is swept with the row that is advanced: at a rim that is one of the two.
FluxDelivery GasLevels::fluxes_of(const LevelScene& scene, int l) const {
  const Share& share = scene.share;
  FluxDelivery delivery(share.ranks().size(), share.ranks().rank());
  const int coarse = static_cast<int>(component(l)), fine = static_cast<int>(component(l - 1));
  const FaceFluxes &noted = scene.components[component(l - 1)].noted(),
                   &imposed = scene.components[component(l)].imposed();
  at(l).faces.each_source([&](int direction, std::size_t to, std::size_t from) {
    const bool along = direction == 0;
    const FaceList &sources = along ? noted.along : noted.between,
                   &targets = along ? imposed.along : imposed.between;
    const int row = sources.row_of(from), target = targets.row_of(to);
    const bool above = along || !owned(l - 1).contains(sources.at(from), row - 1);
    const int swept_by = share.cut().owner(fine, above ? row : row - 1);
    delivery.need(swept_by, share.cut().owner(coarse, target), direction, from);
    if (!along) delivery.need(swept_by, share.cut().owner(coarse, target - 1), direction, from);
  });
  delivery.close();
  return delivery;
}

void GasLevels::share_out(const LevelScene& scene) {
  for (int l = 1; l < levels(); ++l) {
    Level& level = at(l);
    level.restricted_here = averaged_here(scene, l, level.restricted);
    level.prolonged_here = prolonged_here(scene, l, level.prolonged);
    if (scene.share.alone()) continue;
    level.to_prolong = parents_of(scene, l, level.prolonged);
    level.to_match = fluxes_of(scene, l);
  }
  if (!scene.share.alone()) plan_averages(scene);
}

/// What others have of some points of level l, in the halos.
void GasLevels::bring_halos(const LevelScene& scene, int l,
                            std::initializer_list<const grid::RowSets*> points) {
  if (scene.share.alone()) return;
  Delivery delivery = scene.share.nothing_yet();
  for (const grid::RowSets* some : points)
    scene.share.need_halos(static_cast<int>(component(l)), *some, delivery);
  delivery.close();
  scene.share.bring(delivery, states(scene));
}

/// The flags of all ranks, each of which has set those in its own rows.
void GasLevels::gather(const LevelScene& scene, int l, CellMask& flags) const {
  if (scene.share.alone()) return;
  const grid::RowSets mine = averaged_here(scene, l, flags.rows());
  std::vector<double> runs;
  for (int j = 0; j < mine.rows(); ++j) {
    for (const auto& [begin, end] : mine.row(j))
      runs.insert(runs.end(), {static_cast<double>(j), static_cast<double>(begin), static_cast<double>(end)});
  }
  const std::vector<double> all = scene.share.ranks().together(runs);
  for (std::size_t k = 0; k + 2 < all.size(); k += 3)
    std::fill(flags.row(static_cast<int>(all[k])) + static_cast<int>(all[k + 1]),
              flags.row(static_cast<int>(all[k])) + static_cast<int>(all[k + 2]), std::uint8_t{1});
}

}  // namespace fsi::fluid
