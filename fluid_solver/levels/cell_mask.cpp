#include "fluid_solver/levels/cell_mask.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace fsi::fluid {

namespace {

/// The entries of a line, n of them a distance `stride` apart.
struct Line {
  std::uint8_t* first;
  std::ptrdiff_t stride;
  int n;
  bool periodic;
  std::uint8_t& operator[](int k) const { return first[k * stride]; }
};

/// The first entry of a value, or the end.
const std::uint8_t* next(const std::uint8_t* begin, const std::uint8_t* end, int value) {
  const void* found =
      begin == end ? nullptr : std::memchr(begin, value, static_cast<std::size_t>(end - begin));
  return found == nullptr ? end : static_cast<const std::uint8_t*>(found);
}

/// Takes the members of one row into another, entry by entry.
void join(std::uint8_t* row, const std::uint8_t* other, int n) {
#pragma omp simd
  for (int k = 0; k < n; ++k) row[k] |= other[k];
}

/// Work memory of grow_row.
struct PaddedRow {
  std::vector<std::uint8_t> now, next;
};

/// The members of a row, and `reach` points on both sides.
void grow_row(std::uint8_t* row, const LatticeShape& shape, int reach, PaddedRow& padded) {
  const int n = shape.n1, size = n + 2 * reach, window = 2 * reach + 1;
  padded.now.assign(static_cast<std::size_t>(size), 0);
  padded.next.resize(static_cast<std::size_t>(size));
  std::uint8_t* middle = padded.now.data() + reach;
  std::copy(row, row + n, middle);
  // A period before the first point, its end is what the first points can see; likewise behind the last one.
  for (int k = 1; shape.periodic[0] && k <= std::min(reach, n - 1); ++k) {
    middle[-k] = row[n - 1 - k];
    middle[n - 1 + k] = row[k];
  }
  // Each entry takes in what follows within one, two, four .. entries, then the rest of its window.
  int taken = 1;
  for (; 2 * taken <= window; taken *= 2) {
    std::ranges::copy(padded.now, padded.next.begin());
    join(padded.next.data(), padded.now.data() + taken, size - taken);
    std::swap(padded.now, padded.next);
  }
  std::copy_n(padded.now.data(), n, row);
  join(row, padded.now.data() + window - taken, n);
}

}  // namespace

void CellMask::add(const CellMask& other) {
  std::uint8_t* in = in_.data();
  const std::uint8_t* with = other.in_.data();
  const auto size = static_cast<std::ptrdiff_t>(in_.size());
#pragma omp simd
  for (std::ptrdiff_t k = 0; k < size; ++k) in[k] = in[k] | with[k];
}

void CellMask::add(const grid::RowSets& rows) {
  for (int j = 0; j < rows.rows(); ++j) {
    for (const grid::Interval& run : rows.row(j))
      std::fill(row(j) + run.begin, row(j) + run.end, std::uint8_t{1});
  }
}

/// Members are ones.
void CellMask::remove(const CellMask& other) {
  const std::uint8_t* without = other.in_.data();
  std::uint8_t* in = in_.data();
  const auto size = static_cast<std::ptrdiff_t>(in_.size());
#pragma omp simd
  for (std::ptrdiff_t k = 0; k < size; ++k) in[k] = in[k] & (without[k] ^ 1);
}

void CellMask::intersect(const CellMask& other) {
  std::uint8_t* in = in_.data();
  const std::uint8_t* with = other.in_.data();
  const auto size = static_cast<std::ptrdiff_t>(in_.size());
#pragma omp simd
  for (std::ptrdiff_t k = 0; k < size; ++k) in[k] = in[k] & with[k];
}

void CellMask::grow(int reach) {
  if (reach <= 0) return;
  PaddedRow padded;
  std::vector<grid::Interval> spans;  // of each row, from its first to its last member
  for (int j = 0; j < shape_.n2; ++j) {
    std::uint8_t *here = row(j), *end = here + shape_.n1;
    if (next(here, end, 1) != end) grow_row(here, shape_, reach, padded);
    const std::uint8_t *first = next(here, end, 1), *last = end;
    while (last != first && last[-1] == 0) --last;
    spans.push_back({static_cast<int>(first - here), static_cast<int>(last - here)});
  }
  const int n = shape_.n2, beyond = shape_.periodic[1] ? std::min(reach, n - 1) : 0;
  CellMask grown(shape_);
  for (int j = 0; j < n; ++j) {
    for (int from = j - reach; from <= j + reach; ++from) {
      const bool inside = from >= 0 && from < n;
      if (!inside && (from < -beyond || from > n - 1 + beyond)) continue;
      const int source = inside ? from : from < 0 ? from + n - 1 : from - n + 1;
      const auto [begin, end] = spans[static_cast<std::size_t>(source)];
      join(grown.row(j) + begin, row(source) + begin, end - begin);
    }
  }
  in_ = std::move(grown.in_);
}

void CellMask::fill_gaps(int most) {
  for (int j = 0; j < shape_.n2; ++j) {
    std::uint8_t *here = row(j), *end = here + shape_.n1;
    std::uint8_t* gap = here + (next(next(here, end, 1), end, 0) - here);
    while (gap != end) {
      std::uint8_t* behind = here + (next(gap, end, 1) - here);
      if (behind != end && behind - gap <= most) std::fill(gap, behind, std::uint8_t{1});
      gap = here + (next(behind, end, 0) - here);
    }
  }
}

void CellMask::close_ends() {
  const auto close = [](const Line& line) {
    if (line.periodic) {
      const std::uint8_t either = line[0] | line[line.n - 1];
      line[0] = line[line.n - 1] = either;
      return;
    }
    line[0] = line[0] | line[1];
    line[line.n - 1] = line[line.n - 1] | line[line.n - 2];
  };
  for (int j = 0; j < shape_.n2; ++j) close({row(j), 1, shape_.n1, shape_.periodic[0]});
  for (int i = 0; i < shape_.n1; ++i) close({row(0) + i, shape_.n1, shape_.n2, shape_.periodic[1]});
}

grid::RowSets CellMask::rows() const {
  grid::RowSets sets;
  for (int j = 0; j < shape_.n2; ++j) {
    const std::uint8_t *here = row(j), *end = here + shape_.n1;
    for (const std::uint8_t* run = next(here, end, 1); run != end;) {
      const std::uint8_t* last = next(run, end, 0);
      sets.append({static_cast<int>(run - here), static_cast<int>(last - here)});
      run = next(last, end, 1);
    }
    sets.end_row();
  }
  return sets;
}

grid::RowSets refined(const grid::RowSets& coarse, int n1, int n2) {
  grid::RowSets fine;
  for (int j = 0; j < n2; ++j) {
    for (const grid::Interval& run : coarse.row(coarse_index(j)))
      fine.append(
          {std::max(refinement_ratio * run.begin - 1, 0), std::min(refinement_ratio * run.end - 1, n1)});
    fine.end_row();
  }
  return fine;
}

grid::RowSets gaps_of(const grid::RowSets& set, int n1) {
  grid::RowSets gaps;
  std::vector<grid::Interval> parts;
  const grid::Interval all{0, n1};
  for (int j = 0; j < set.rows(); ++j) {
    parts.clear();
    grid::subtract({&all, 1}, set.row(j), parts);
    gaps.append(parts);
    gaps.end_row();
  }
  return gaps;
}

grid::RowSets difference(const grid::RowSets& from, const grid::RowSets& without) {
  grid::RowSets rest;
  std::vector<grid::Interval> parts;
  for (int j = 0; j < from.rows(); ++j) {
    parts.clear();
    grid::subtract(from.row(j), without.row(j), parts);
    rest.append(parts);
    rest.end_row();
  }
  return rest;
}

void mark_coarse(const grid::RowSets& fine, CellMask& mask) {
  for (int j = 0; j < fine.rows(); ++j) {
    std::uint8_t* row = mask.row(coarse_index(j));
    for (const grid::Interval& run : fine.row(j))
      std::fill(row + coarse_index(run.begin), row + coarse_index(run.end - 1) + 1, std::uint8_t{1});
  }
}

}  // namespace fsi::fluid
