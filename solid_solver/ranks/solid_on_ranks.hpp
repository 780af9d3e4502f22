#pragma once
/// SolidSolver on several ranks: what is brought when, and what all ranks find together.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "solid_solver/component_breakdown.hpp"
#include "solid_solver/ranks/component_on_ranks.hpp"
#include "solid_solver/solid_solver.hpp"

namespace fsi::solid {

/// Rows around a rank's own that it is brought after a prediction, and sets conditions in: two that the next sweep reads; two
/// more, so that whoever reads a ghost point has the four lines that it is extrapolated from; and two from which
/// conditions at a side of these are found, with what conditions beside them change.
inline constexpr int rows_with_conditions = 6;
/// Those of them in which all values are right after the conditions.
inline constexpr int rows_that_are_right = 4;
/// Lines of an interface from which its state is found.
inline constexpr int lines_of_interface = 4;

template <Law L>
void SolidSolver<L>::share(std::shared_ptr<Ranks> ranks, const RecutOptions& options) {
  if (ranks->alone()) return;
  early_ = Share(ranks, options, cut_grids(rows_with_conditions));
  late_ = Share(std::move(ranks), options, cut_grids(rows_that_are_right));
  together_ = Together(early_.ranks());
  recut_every_ = options.every;
  take_rows();
  loaded();  // what all have counted so far, in all rows, the first rank keeps
}

template <Law L>
std::vector<CutGrid> SolidSolver<L>::cut_grids(int halo) const {
  std::vector<CutGrid> grids;
  for (const SolidComponent<L>& component : components_)
    grids.push_back({.layout = component.layout(),
                     .periodic2 = component.grid().periodic(1),
                     .discretised = &component.points().discretised(),
                     .halo = halo});
  return grids;
}

template <Law L>
void SolidSolver<L>::take_rows() {
  for (int k = 0; k < grids(); ++k) components_[static_cast<std::size_t>(k)].take_rows(early_.rows(k));
  const std::vector<Need> lines = lines_of_interfaces();
  early_.plan(cut_grids(rows_with_conditions), interpolate_first_ ? composite() : nullptr, {.more = lines});
  late_.plan(cut_grids(rows_that_are_right), composite(), {.halos = false});
}

/// Appends the strips of the first lines of a side.
inline void add_lines(const Layout& layout, Side side, int grid, int lines, std::vector<Strip>& strips) {
  if (direction_of(side) == 1) {
    for (int m = 0; m < lines; ++m)
      strips.push_back({grid, side == Side::bottom ? m : layout.n2 - 1 - m, 0, layout.n1});
    return;
  }
  const int begin = side == Side::left ? 0 : layout.n1 - lines;
  for (int j = 0; j < layout.n2; ++j) strips.push_back({grid, j, begin, begin + lines});
}

template <Law L>
std::vector<Need> SolidSolver<L>::lines_of_interfaces() const {
  std::vector<Need> needs;
  std::vector<Strip> strips;
  for (int k = 0; k < grids(); ++k) {
    const Layout layout = component(k).layout();
    for (const Side side : all_sides) {
      const auto is_interface = [&](Side s) {
        return component(k).boundary().sides().condition(s).meets_gas();
      };
      if (!is_interface(side)) continue;
      // An interface that goes round corners is closed as a whole by every rank.
      const bool round_corners = is_interface(neighbour(side, false)) || is_interface(neighbour(side, true));
      strips.clear();
      add_lines(layout, side, k, lines_of_interface, strips);
      for (int rank = 0; rank < early_.ranks().size(); ++rank) {
        const bool near = round_corners || std::ranges::any_of(strips, [&](const Strip& s) {
                            return early_.has(rank, k, s.j);
                          });
        if (rank > 0 && !near) continue;
        for (const Strip& strip : strips) needs.push_back({rank, strip});
      }
    }
  }
  return needs;
}

template <Law L>
void SolidSolver<L>::share_out_anew() {
  if (recut_every_ == 0 || !early_.recut_is_due(cut_grids(rows_with_conditions))) return;
  gather_scattered();
  std::vector<std::vector<FieldView>> fields;
  for (SolidComponent<L>& component : components_) {
    const std::vector<FieldView> of_one = component.scattered_fields();
    fields.resize(of_one.size());
    for (std::size_t f = 0; f < of_one.size(); ++f) fields[f].push_back(of_one[f]);
  }
  early_.recut(cut_grids(rows_with_conditions), fields);
  late_.recut(cut_grids(rows_that_are_right), {});
  take_rows();
}

// --- a step

template <Law L>
Diverged SolidSolver<L>::breakdown(const SolidComponent<L>& component, double dt) {
  const std::optional<Diverged> point = component.breakdown(dt);
  return point ? *point : Diverged("not a number", {.grid = component.grid().name()});
}

/// Grids are predicted one after the other, and none after the one that broke.
template <Law L>
void SolidSolver<L>::predict(double t, double dt, Look look) {
  if (!alone()) return predict_on_ranks(t, dt, look);
  for (SolidComponent<L>& component : components_) {
    component.predict(t, dt, look);
    if (component.measured().broken > 0) throw breakdown(component, dt);
  }
}

/// What a rank finds in its rows, all look at together in the end.
template <Law L>
void SolidSolver<L>::predict_on_ranks(double t, double dt, Look look) {
  share_out_anew();
  std::size_t agreed = 0;
  found_.clear();
  for (std::size_t k = 0; k < components_.size(); ++k) {
    SolidComponent<L>& component = components_[k];
    found_.push_back({component.measured(), component.settled()});
    component.predict(t, dt, look);
    // With a chosen solution each for itself: what the others' states were given, they could not give back to the bit.
    const bool last = k + 1 == components_.size();
    if (!last && component.chosen() == nullptr) continue;
    agree_on_prediction(agreed, dt);
    agreed = k + 1;
  }
}

/// What was found in grids from `first` on becomes what all ranks found. @throws Diverged naming the first point
/// that broke
template <Law L>
void SolidSolver<L>::agree_on_prediction(std::size_t first, double dt) {
  std::vector<double> most, here;
  for (std::size_t k = first; k < found_.size(); ++k) {
    const SweepResult& m = components_[k].measured();
    most.insert(most.end(),
                {m.rate_squared, m.spread_squared, m.coupled, -m.min_det_F, -m.min_phi_s, m.broken});
    here.push_back(m.broken);
  }
  early_.ranks().largest_of_each(most);
  for (std::size_t k = first; k < found_.size(); ++k) {
    SolidComponent<L>& component = components_[k];
    const double* of_all = &most[6 * (k - first)];
    component.measured() = {.rate_squared = of_all[0],
                            .spread_squared = of_all[1],
                            .coupled = of_all[2],
                            .min_det_F = -of_all[3],
                            .min_phi_s = -of_all[4],
                            .broken = of_all[5]};
    if (of_all[5] == 0) continue;
    for (std::size_t later = k + 1; later < found_.size(); ++later) {
      components_[later].measured() = found_[later].measured;
      components_[later].set_settled(found_[later].settled);
    }
    together_.attempt([&] {
      if (here[k - first] > 0) throw breakdown(component, dt);
    });
    together_.agree();
  }
}

// --- what leaves the program

template <Law L>
void SolidSolver<L>::fetch(std::vector<Strip> strips) {
  if (alone()) return;
  for (int k = 0; k < grids(); ++k) {
    for (const Side side : all_sides) {
      if (component(k).boundary().sides().condition(side).meets_gas())
        add_lines(component(k).layout(), side, k, 1, strips);
    }
  }
  early_.to_first(strips, states());
}

template <Law L>
void SolidSolver<L>::collect() {
  if (!alone()) early_.all_to_first(states());
}

template <Law L>
void SolidSolver<L>::gather_scattered() {
  Ranks& ranks = early_.ranks();
  for (int k = 0; k < grids(); ++k) {
    SolidBoundary<L>& boundary = components_[static_cast<std::size_t>(k)].boundary();
    const std::vector<double> all = ranks.together(boundary.scattered(early_.cut().own(k, ranks.rank())));
    std::span<const double> rest = all;
    for (int rank = 0; rank < ranks.size(); ++rank)
      rest = boundary.gather_scattered(early_.cut().own(k, rank), rest);
  }
}

template <Law L>
void SolidSolver<L>::collect_all() {
  if (alone()) return;
  std::vector<FieldView> fields;
  const std::size_t kinds = components_.front().scattered_fields().size();
  for (std::size_t f = 0; f < kinds; ++f) {
    fields.clear();
    for (SolidComponent<L>& component : components_) fields.push_back(component.scattered_fields()[f]);
    early_.all_to_first(fields);
  }
  gather_scattered();
  for (SolidComponent<L>& component : components_) {
    const std::vector<double> all =
        early_.ranks().together(std::vector{component.settled(), component.waveless()});
    double settled = 0, waveless = 0;
    for (std::size_t k = 0; k < all.size(); k += 2) {
      settled += all[k];
      waveless += all[k + 1];
    }
    component.set_settled(early_.ranks().first() ? settled : 0);
    component.set_waveless(early_.ranks().first() ? waveless : 0);
  }
}

template <Law L>
void SolidSolver<L>::loaded() {
  if (alone()) return;
  if (early_.ranks().first()) return;
  for (SolidComponent<L>& component : components_) {
    component.set_settled(0);
    component.set_waveless(0);
  }
}

template <Law L>
Pose SolidSolver<L>::pose() const {
  std::vector<PosePart> parts;
  for (int k = 0; composite_ && k < grids(); ++k)
    parts.push_back({reference(k), state(k), areas_[static_cast<std::size_t>(k)].view(), &valid(k)});
  if (!alone()) return pose_on_ranks(parts);
  return composite_ ? pose_of(parts) : pose_of(reference(), state());
}

/// Every rank sums over its rows, and rows are added in their order, as one rank does.
template <Law L>
Pose SolidSolver<L>::pose_on_ranks(std::span<const PosePart> parts) const {
  const Vec2 origin = origin_of_sums(reference());
  std::vector<double> mine;
  for (int k = 0; k < grids(); ++k) {
    const int rows = composite_ ? component(k).layout().n2 : component(k).layout().n2 - 1;
    for (int j = 0; j < rows; ++j) {
      if (!component(k).rows().owns(j)) continue;
      const PoseSums sums = composite_ ? pose_sums(parts[static_cast<std::size_t>(k)], origin, j)
                                       : pose_sums(reference(), state(), j);
      sums.write(mine);
    }
  }
  const std::vector<double> all = early_.ranks().together(mine);
  PoseSums sums;
  for (std::size_t at = 0; at < all.size(); at += PoseSums::size)
    sums.add(PoseSums::read(std::span(all).subspan(at, PoseSums::size)));
  return pose_from(sums, origin);
}

}  // namespace fsi::solid
