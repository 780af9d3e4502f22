/// What of a component's state is kept: in memory, where it is sparse, and in checkpoints.

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "fluid_solver/component.hpp"

namespace fsi::fluid {

namespace {

/// Runs begin <= i < end of rows, those of ghosts included, that hold the valid points and two points around each.
template <class Action>
void each_kept_run(const grid::RowSets& valid, const Layout& shape, const Action& action) {
  constexpr int g = Layout::ghosts;
  for (int j = -g; j < shape.n2 + g; ++j) {
    int done = -g;
    for (const grid::Interval& run : valid.row(std::clamp(j, 0, shape.n2 - 1))) {
      const grid::Interval kept{std::max(run.begin - g, done), run.end + g};
      action(j, kept);
      done = kept.end;
    }
  }
}

/// Calls action(begin, end) with the places of the values of all planes in runs of points, each given as row, begin, end.
template <class Action>
void each_place(FieldView field, const std::vector<double>& runs, const Action& action) {
  for (std::size_t k = 0; k + 2 < runs.size(); k += 3) {
    for (int plane = 0; plane < field.planes; ++plane) {
      double* row = field.row(plane, static_cast<int>(runs[k]));
      action(row + static_cast<int>(runs[k + 1]), row + static_cast<int>(runs[k + 2]));
    }
  }
}

std::vector<double> values_at(FieldView field, const std::vector<double>& runs) {
  std::vector<double> values;
  each_place(field, runs, [&](double* begin, double* end) { values.insert(values.end(), begin, end); });
  return values;
}

void put_back(const std::vector<double>& values, const std::vector<double>& runs, FieldView field) {
  const double* from = values.data();
  each_place(field, runs, [&](double* begin, double* end) {
    std::copy_n(from, end - begin, begin);
    from += end - begin;
  });
}

}  // namespace

void Component::add_kept_strips(std::vector<Strip>& strips, int grid) const {
  each_kept_run(valid_, grid_.layout(), [&](int j, const grid::Interval& run) {
    strips.push_back({grid, j, run.begin, run.end});
  });
}

/// Plane by plane: one of them at a time is in memory twice.
void Component::forget_unused_points() {
  for (Field* field : {&state_, &next_}) {
    Field kept(grid_.layout(), 4);
    for (int plane = 0; plane < 4; ++plane) {
      each_kept_run(valid_, grid_.layout(), [&](int j, const grid::Interval& run) {
        const double* from = field->view().row(plane, j);
        std::copy(from + run.begin, from + run.end, kept.view().row(plane, j) + run.begin);
      });
      field->clear_plane(plane);
    }
    *field = std::move(kept);
  }
}

/// Of a sparse grid the runs of points that are kept, and their states.
void Component::archive_states(Archive& archive) {
  if (!sparse_) {
    archive.values("state", state_.values());
    // Points that are not advanced keep what they had two steps ago: where iterations begin that interpolate.
    archive.values("next", next_.values());
    return;
  }
  std::vector<double> runs;
  each_kept_run(valid_, grid_.layout(), [&](int j, const grid::Interval& run) {
    for (const int number : {j, run.begin, run.end}) runs.push_back(number);
  });
  archive.list("runs", runs);
  for (const auto& [name, field] : {std::pair{"state", &state_}, std::pair{"next", &next_}}) {
    std::vector<double> values = archive.loading() ? std::vector<double>{} : values_at(field->view(), runs);
    archive.list(name, values);
    if (!archive.loading()) continue;
    *field = Field(grid_.layout(), 4);
    put_back(values, runs, field->view());
  }
}

void Component::archive(Archive& archive) {
  archive.inside("grid", [&] { grid_.archive(archive); });
  archive_states(archive);
  archive.values("rates", row_rates_);
  archive.number("last_dt", last_dt_);
  archive.number("dt_before", dt_before_);
  archive.number("prescribed", prescribed_);
  archive.number("p_floor", scheme_.p_floor);
  archive.number("first_order", counters_.first_order);
  archive.number("first_order_outside_shocks", counters_.first_order_outside_shocks);
  archive.number("positive_fluxes", counters_.positive_fluxes);
  archive.number("positive_values", counters_.positive_values);
  archive.number("bounded_side_points", counters_.bounded_side_points);
  archive.number("floors", counters_.floors);
  archive.number("steps", counters_.steps);
  for (const Side side : all_sides) {
    WallMotion& wall = walls_[static_cast<std::size_t>(side)];
    archive.inside(name_of(side), [&] {
      wall.archive(archive);
      // Of the step whose end the budget has yet to see.
      archive.list("edge", edges_[static_cast<std::size_t>(side)]);
    });
  }
  if (!forcing_) return;
  archive.values("source", source_.values());
  archive.number("has_source", has_source_);
}

}  // namespace fsi::fluid
