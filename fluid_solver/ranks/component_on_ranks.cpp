/// What a component grid does besides its step where several ranks share it.

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "fluid_solver/component.hpp"
#include "fluid_solver/measures/shocks.hpp"

namespace fsi::fluid {

void Component::take_rows(RankRows rows) {
  rows_ = std::move(rows);
  gather_runs();
}

std::vector<FieldView> Component::moving_fields() {
  std::vector<FieldView> fields{state_.view(), next_.view()};
  if (forcing_) fields.push_back(source_.view());
  return fields;
}

/// What is not one's own is zero.
std::vector<double> Component::scattered() const {
  std::vector<double> values{counters_.first_order,         counters_.first_order_outside_shocks,
                             counters_.positive_fluxes,     counters_.positive_values,
                             counters_.bounded_side_points, counters_.floors};
  for (int j = 0; j < grid_.layout().n2; ++j)
    values.push_back(rows_.owns(j) ? row_rates_[static_cast<std::size_t>(j)] : 0);
  return values;
}

void Component::gather_scattered(std::span<const double> all_ranks) {
  const std::size_t size = scattered().size();
  std::vector<double> sums(size);
  for (std::size_t k = 0; k < all_ranks.size(); ++k) sums[k % size] += all_ranks[k];
  counters_.first_order = sums[0];
  counters_.first_order_outside_shocks = sums[1];
  counters_.positive_fluxes = sums[2];
  counters_.positive_values = sums[3];
  counters_.bounded_side_points = sums[4];
  counters_.floors = sums[5];
  std::copy(sums.begin() + 6, sums.end(), row_rates_.begin());
}

/// All ranks look around the points in their own rows.
void Component::count_far_fallbacks() {
  Ranks& ranks = *rows_.ranks;
  std::vector<double> mine;
  for (const auto& [i, j] : far_fallbacks_)
    mine.insert(mine.end(),
                {static_cast<double>(ranks.rank()), static_cast<double>(i), static_cast<double>(j)});
  const std::vector<double> all = ranks.together(mine);
  const ShockField field = shock_field();
  const auto owned = [this](int j) { return rows_.owns(j); };
  std::vector<double> found;
  for (std::size_t k = 0; k < all.size(); k += 3) {
    const auto i = static_cast<int>(all[k + 1]), j = static_cast<int>(all[k + 2]);
    found.push_back(inside_shock(field, i, j, owned) ? 1 : 0);
  }
  const std::vector<double> verdicts = ranks.together(found);
  const std::size_t points = found.size();
  for (std::size_t k = 0; k < points; ++k) {
    if (static_cast<int>(all[3 * k]) != ranks.rank()) continue;
    bool inside = false;
    for (std::size_t at = k; at < verdicts.size(); at += points) inside = inside || verdicts[at] > 0;
    if (!inside) counters_.first_order_outside_shocks += 1;
  }
  far_fallbacks_.clear();
}

}  // namespace fsi::fluid
