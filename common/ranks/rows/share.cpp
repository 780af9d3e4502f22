#include "common/ranks/rows/share.hpp"

#include <algorithm>
#include <utility>

namespace fsi {

namespace {

/// Rows are shared out anew when the busiest rank has so much more to do than the mean, and than it would have then;
/// at most that often.
constexpr double tolerable_imbalance = 1.1;
constexpr int least_steps = 50;

}  // namespace

Share::Share(std::shared_ptr<Ranks> ranks, const RecutOptions& options, std::span<const CutGrid> grids)
    : ranks_(std::move(ranks)), options_(options), cut_(grids, ranks_->size(), options.pieces) {
  for (const CutGrid& grid : grids) layouts_.push_back(grid.layout);
  for (int rank = 0; rank < ranks_->size(); ++rank) all_ranks_.push_back(rank);
  find_holders();
}

RankRows Share::rows(int grid) const {
  if (alone()) return {};
  const int rank = ranks_->rank();
  return {.ranks = ranks_, .all = false, .own = cut_.own(grid, rank), .halos = cut_.halos(grid, rank)};
}

void Share::find_holders() {
  holders_.assign(layouts_.size(), {});
  for (std::size_t grid = 0; grid < layouts_.size(); ++grid) {
    const int n2 = layouts_[grid].n2;
    holders_[grid].resize(static_cast<std::size_t>(n2));
    for (int rank = 0; rank < ranks_->size(); ++rank) {
      for (const auto& [first, end] : cut_.halos(static_cast<int>(grid), rank)) {
        for (int j = std::max(first, 0); j < std::min(end, n2); ++j) {
          std::vector<int>& holders = holders_[grid][static_cast<std::size_t>(j)];
          if (holders.empty() || holders.back() != rank) holders.push_back(rank);
        }
      }
    }
  }
}

bool Share::has(int rank, int grid, int j) const {
  const std::vector<int>& holders = holders_[static_cast<std::size_t>(grid)][static_cast<std::size_t>(j)];
  return std::ranges::find(holders, rank) != holders.end();
}

int Share::row_of(int grid, std::int32_t at) const {
  return (at - Layout::lead + Layout::ghosts) / layouts_[static_cast<std::size_t>(grid)].stride -
         Layout::ghosts;
}

// --- other rows for everybody

bool Share::recut_is_due(std::span<const CutGrid> grids) {
  if (alone()) return false;
  counts_.steps += 1;
  ++since_recut_;
  if (options_.every > 0) return since_recut_ >= options_.every;
  if (since_recut_ < least_steps) return false;
  const double now = cut_.imbalance(grids);
  return now > tolerable_imbalance &&
         now > tolerable_imbalance * Cut(grids, ranks_->size(), options_.pieces).imbalance(grids);
}

void Share::recut(std::span<const CutGrid> grids, std::span<const std::vector<FieldView>> fields) {
  constexpr double most_shift = 0.4;
  counts_.recuts += 1;
  since_recut_ = 0;
  const double shift =
      options_.every == 0 ? 0 : (static_cast<int>(counts_.recuts) % 2 == 1 ? most_shift : -most_shift / 2);
  const Cut before = cut_;
  Delivery rows(before, ranks_->rank());
  cut_ = Cut(grids, ranks_->size(), options_.pieces, shift);
  for (int grid = 0; grid < static_cast<int>(layouts_.size()); ++grid) {
    const int n2 = layouts_[static_cast<std::size_t>(grid)].n2;
    for (int rank = 0; rank < ranks_->size(); ++rank) {
      for (const auto& [first, end] : cut_.halos(grid, rank)) {
        for (int j = std::max(first, -Layout::ghosts); j < std::min(end, n2 + Layout::ghosts); ++j)
          rows.need(rank, whole_row(grid, j));
      }
    }
  }
  rows.close();
  for (const std::vector<FieldView>& of_grids : fields) bring(rows, of_grids);
  find_holders();
}

Strip Share::whole_row(int grid, int j) const {
  return {.grid = grid,
          .j = j,
          .begin = -Layout::lead,
          .end = layouts_[static_cast<std::size_t>(grid)].stride - Layout::lead};
}

// --- what a step needs

void Share::plan(std::span<const CutGrid> grids, const grid::CompositeGrid* composite,
                 const StepNeeds& needs) {
  if (alone()) return;
  step_ = Delivery(cut_, ranks_->rank());
  neighbours_ = Delivery(cut_, ranks_->rank());
  for (int grid = 0; needs.halos && grid < static_cast<int>(grids.size()); ++grid) {
    const CutGrid& one = grids[static_cast<std::size_t>(grid)];
    need_halos(grid, *one.discretised, step_);
    if (one.averaged != nullptr) need_halos(grid, *one.averaged, step_);
    need_neighbours(grid, *one.discretised);
  }
  for (const auto& [rank, strip] : needs.more) step_.need(rank, strip);
  if (composite != nullptr) {
    const std::span<const grid::InterpolationList> lists = composite->interpolation();
    mine_.resize(lists.size());
    mark_everywhere(lists);
    for (std::size_t l = 0; l < lists.size(); ++l) {
      if (lists[l].implicit) {
        mine_[l] = lists[l];
        plan_for_all(lists[l], step_);
      } else {
        plan_list(lists[l], step_, mine_[l]);
      }
    }
  }
  step_.close();
  neighbours_.close();
}

void Share::plan_exposed(const grid::CompositeGrid& composite) {
  if (alone()) return;
  exposed_ = Delivery(cut_, ranks_->rank());
  const std::span<const grid::InterpolationList> lists = composite.exposed();
  mine_exposed_.resize(lists.size());
  everywhere_.clear();
  for (std::size_t l = 0; l < lists.size(); ++l) plan_list(lists[l], exposed_, mine_exposed_[l]);
  exposed_.close();
}

void Share::need_halos(int grid, const grid::RowSets& points, Delivery& delivery) const {
  for (int rank = 0; rank < ranks_->size(); ++rank) {
    for (const auto& [first, end] : cut_.halos(grid, rank)) {
      for (int j = std::max(first, 0); j < std::min(end, points.rows()); ++j) {
        for (const grid::Interval& run : points.row(j)) delivery.need(rank, {grid, j, run.begin, run.end});
      }
    }
  }
}

/// Of the halos the rows next to those of each rank.
void Share::need_neighbours(int grid, const grid::RowSets& points) {
  for (int rank = 0; rank < ranks_->size(); ++rank) {
    const grid::RowRange own = cut_.own(grid, rank);
    for (const auto& [first, end] : cut_.halos(grid, rank)) {
      for (const int j : {own.first - 1, own.end}) {
        if (j < std::max(first, 0) || j >= std::min(end, points.rows())) continue;
        for (const grid::Interval& run : points.row(j)) neighbours_.need(rank, {grid, j, run.begin, run.end});
      }
    }
  }
}

/// Donors of a point, for a rank that sets it.
void Share::need_donors(const grid::InterpolationList& list, std::size_t point, int rank,
                        Delivery& delivery) const {
  const Layout& layout = layouts_[static_cast<std::size_t>(list.donor_grid)];
  const int j = row_of(list.donor_grid, list.donor[point]);
  const auto i = static_cast<int>(list.donor[point] - layout.at(0, j));
  for (int m = 0; m < list.width; ++m) {
    if (!has(rank, list.donor_grid, j + m)) delivery.need(rank, {list.donor_grid, j + m, i, i + list.width});
  }
}

/// Points that are donors of each other have donors that are interpolated, but not implicit, as well.
void Share::mark_everywhere(std::span<const grid::InterpolationList> lists) {
  everywhere_.clear();
  for (const grid::InterpolationList& list : lists) {
    if (!list.implicit || list.size() == 0) continue;
    everywhere_.resize(layouts_.size());
    const auto donor_grid = static_cast<std::size_t>(list.donor_grid);
    const Layout& layout = layouts_[donor_grid];
    everywhere_[donor_grid].resize(layout.plane_size());
    for (const std::int32_t first : list.donor) {
      for (int m = 0; m < list.width; ++m) {
        for (int l = 0; l < list.width; ++l)
          everywhere_[donor_grid][static_cast<std::size_t>(first + m * layout.stride + l)] = true;
      }
    }
  }
}

/// The ranks that set an interpolation point.
const std::vector<int>& Share::setters_of(const grid::InterpolationList& list, std::size_t point) const {
  const auto grid = static_cast<std::size_t>(list.target_grid);
  if (!everywhere_.empty() && !everywhere_[grid].empty() &&
      everywhere_[grid][static_cast<std::size_t>(list.target[point])])
    return all_ranks_;
  return holders_[grid][static_cast<std::size_t>(row_of(list.target_grid, list.target[point]))];
}

void Share::plan_list(const grid::InterpolationList& list, Delivery& delivery,
                      grid::InterpolationList& mine) const {
  mine.clear();
  mine.target_grid = list.target_grid;
  mine.donor_grid = list.donor_grid;
  mine.width = list.width;
  mine.implicit = list.implicit;
  const auto weights = static_cast<std::ptrdiff_t>(list.width) * list.width;
  for (std::size_t k = 0; k < list.size(); ++k) {
    for (const int rank : setters_of(list, k)) {
      need_donors(list, k, rank, delivery);
      if (rank != ranks_->rank()) continue;
      const auto first = list.weight.begin() + static_cast<std::ptrdiff_t>(k) * weights;
      mine.target.push_back(list.target[k]);
      mine.donor.push_back(list.donor[k]);
      mine.weight.insert(mine.weight.end(), first, first + weights);
      if (list.implicit) mine.x.push_back(list.x[k]);
    }
  }
}

/// Points that are donors of each other: every rank finds their common solution, from where its owner has them.
void Share::plan_for_all(const grid::InterpolationList& list, Delivery& delivery) const {
  for (std::size_t k = 0; k < list.size(); ++k) {
    const int j = row_of(list.target_grid, list.target[k]);
    const auto i =
        static_cast<int>(list.target[k] - layouts_[static_cast<std::size_t>(list.target_grid)].at(0, j));
    for (int rank = 0; rank < ranks_->size(); ++rank) {
      need_donors(list, k, rank, delivery);
      if (!has(rank, list.target_grid, j)) delivery.need(rank, {list.target_grid, j, i, i + 1});
    }
  }
}

// --- bringing

void Share::bring(Delivery& delivery, std::span<const FieldView> fields) {
  if (alone()) return;
  delivery.run(*ranks_, fields);
  counts_.values += static_cast<double>(fields.front().planes) * static_cast<double>(delivery.received());
}

void Share::to_first(std::span<const Strip> strips, std::span<const FieldView> fields) {
  if (alone()) return;
  Delivery delivery(cut_, ranks_->rank());
  for (const Strip& strip : strips) delivery.need(0, strip);
  delivery.close();
  bring(delivery, fields);
}

void Share::all_to_first(std::span<const FieldView> fields) {
  std::vector<Strip> strips;
  for (int grid = 0; grid < static_cast<int>(layouts_.size()); ++grid) {
    const int n2 = layouts_[static_cast<std::size_t>(grid)].n2;
    for (int j = -Layout::ghosts; j < n2 + Layout::ghosts; ++j) strips.push_back(whole_row(grid, j));
  }
  to_first(strips, fields);
}

}  // namespace fsi
