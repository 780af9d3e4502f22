#include "fluid_solver/kernels/sweep_runs.hpp"

#include <algorithm>

namespace fsi::fluid {

/// Sorts and merges the runs of a row first.
void SweepRuns::Table::append_row(std::vector<Range>& row) {
  std::ranges::sort(row, {}, &Range::first);
  const std::size_t begin = runs.size();
  for (const Range& run : row) {
    if (run.first >= run.last) continue;
    if (runs.size() > begin && run.first <= runs.back().last) {
      runs.back().last = std::max(runs.back().last, run.last);
    } else {
      runs.push_back(run);
    }
  }
  first.push_back(runs.size());
}

void SweepRuns::assign(std::span<const std::vector<Range>> rows, Range here) {
  here_ = here;
  const int n2 = static_cast<int>(rows.size());
  for (Table* table : {&advanced_, &predicted_, &between_}) table->clear();
  const auto add = [&](int r, int reach) {
    if (r < 0 || r >= n2) return;
    for (const Range& run : rows[static_cast<std::size_t>(r)])
      row_.push_back({run.first - reach, run.last + reach});
  };
  for (int r = -1; r <= n2; ++r) {
    row_.clear();
    add(r, 1);
    add(r - 1, 0);
    add(r + 1, 0);
    predicted_.append_row(row_);
    if (r < 0) continue;
    row_.clear();
    add(r - 1, 0);
    add(r, 0);
    between_.append_row(row_);
    if (r == n2) break;
    row_.clear();
    add(r, 0);
    advanced_.append_row(row_);
  }
  longest_ = 0;
  for (const Range& run : predicted_.runs) longest_ = std::max(longest_, run.last - run.first);
}

}  // namespace fsi::fluid
