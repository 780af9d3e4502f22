#include "common/grid/intervals.hpp"

#include <algorithm>

namespace fsi::grid {

std::size_t RowSets::points() const {
  std::size_t sum = 0;
  for (const Interval& interval : intervals_) sum += static_cast<std::size_t>(interval.end - interval.begin);
  return sum;
}

void RowSets::clear() {
  first_.clear();
  first_.push_back(0);
  intervals_.clear();
}

RowSets all_points(int n1, int n2) {
  RowSets all;
  for (int j = 0; j < n2; ++j) {
    all.append(Interval{0, n1});
    all.end_row();
  }
  return all;
}

void unite(std::vector<Interval>& parts) {
  std::erase_if(parts, [](const Interval& part) { return part.begin >= part.end; });
  std::ranges::sort(parts, {}, &Interval::begin);
  std::size_t kept = 0;
  for (const Interval& part : parts) {
    if (kept > 0 && part.begin <= parts[kept - 1].end) {
      parts[kept - 1].end = std::max(parts[kept - 1].end, part.end);
    } else {
      parts[kept++] = part;
    }
  }
  parts.resize(kept);
}

void subtract(std::span<const Interval> from, std::span<const Interval> without,
              std::vector<Interval>& parts) {
  auto cut = without.begin();
  for (Interval rest : from) {
    while (cut != without.end() && cut->end <= rest.begin) ++cut;
    for (auto c = cut; c != without.end() && c->begin < rest.end; ++c) {
      if (c->begin > rest.begin) parts.push_back({rest.begin, c->begin});
      rest.begin = std::max(rest.begin, c->end);
    }
    if (rest.begin < rest.end) parts.push_back(rest);
  }
}

void intersect(std::span<const Interval> a, std::span<const Interval> b, std::vector<Interval>& parts) {
  auto other = b.begin();
  for (const Interval& part : a) {
    while (other != b.end() && other->end <= part.begin) ++other;
    for (auto o = other; o != b.end() && o->begin < part.end; ++o) {
      parts.push_back({std::max(part.begin, o->begin), std::min(part.end, o->end)});
    }
  }
}

void grow(const RowSets& set, int j, int reach, RowShape shape, std::vector<Interval>& parts) {
  const int period = shape.n1 - 1;
  for (int row = std::max(j - reach, 0); row <= std::min(j + reach, set.rows() - 1); ++row) {
    for (const Interval& interval : set.row(row)) {
      const Interval grown{interval.begin - reach, interval.end + reach};
      parts.push_back({std::max(grown.begin, 0), std::min(grown.end, shape.n1)});
      if (!shape.closed) continue;
      if (grown.begin <= 0) parts.push_back({std::max(grown.begin + period, 0), shape.n1});
      if (grown.end >= shape.n1) parts.push_back({0, std::min(grown.end - period, shape.n1)});
    }
  }
}

namespace {

/// Do all rows within reach of row j hold one interval from end to end (or, for `whole` = false, none)?
bool uniform(const RowSets& set, int j, int reach, int n1, bool whole) {
  for (int row = std::max(j - reach, 0); row <= std::min(j + reach, set.rows() - 1); ++row) {
    const std::span<const Interval> intervals = set.row(row);
    if (whole ? intervals.size() != 1 || intervals[0] != Interval{0, n1} : !intervals.empty()) return false;
  }
  return true;
}

void append_complement(std::span<const Interval> holes, int n1, RowSets& set) {
  int begin = 0;
  for (const Interval& hole : holes) {
    if (hole.begin > begin) set.append(Interval{begin, hole.begin});
    begin = hole.end;
  }
  if (begin < n1) set.append(Interval{begin, n1});
}

}  // namespace

void classify(PointSets& sets, const GridRows& rows, int layers, std::vector<Interval>& parts) {
  const auto [shape, n2, inner, used] = rows;
  sets.discretised.clear();
  for (int j = 0; j < n2; ++j) {
    if (inner.contains(j)) {
      parts.clear();
      if (!uniform(sets.holes, j, layers, shape.n1, false)) grow(sets.holes, j, layers, shape, parts);
      unite(parts);
      append_complement(parts, shape.n1, sets.discretised);
    }
    sets.discretised.end_row();
  }
  sets.valid.clear();
  for (int j = 0; j < n2; ++j) {
    const std::span<const Interval> holes = sets.holes.row(j);
    if (used.contains(j) && holes.empty() && inner.contains(j) &&
        uniform(sets.discretised, j, 0, shape.n1, true)) {
      sets.valid.append(Interval{0, shape.n1});
    } else if (used.contains(j)) {
      parts.clear();
      grow(sets.discretised, j, layers, shape, parts);
      unite(parts);
      const std::size_t grown = parts.size();
      parts.reserve(2 * grown + holes.size() + 1);
      subtract(std::span(parts.data(), grown), holes, parts);
      sets.valid.append(std::span<const Interval>(parts).subspan(grown));
    }
    sets.valid.end_row();
  }
}

}  // namespace fsi::grid
