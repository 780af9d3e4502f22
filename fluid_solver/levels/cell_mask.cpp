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

/// The members of a row, and `reach` points on both sides; `padded` is work memory.
void grow_row(std::uint8_t* row, const LatticeShape& shape, int reach, std::vector<std::uint8_t>& padded) {
  const int n = shape.n1;
  padded.assign(static_cast<std::size_t>(n + 2 * reach), 0);
  std::uint8_t* middle = padded.data() + reach;
  std::copy(row, row + n, middle);
  // A period before the first point, its end is what the first points can see; likewise behind the last one.
  for (int k = 1; shape.periodic[0] && k <= std::min(reach, n - 1); ++k) {
    middle[-k] = row[n - 1 - k];
    middle[n - 1 + k] = row[k];
  }
  for (int shift = -reach; shift <= reach; ++shift) join(row, middle + shift, n);
}

}  // namespace

void CellMask::add(const CellMask& other) {
  for (std::size_t k = 0; k < in_.size(); ++k) in_[k] = in_[k] | other.in_[k];
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

void CellMask::grow(int reach) {
  if (reach <= 0) return;
  std::vector<std::uint8_t> padded;
  for (int j = 0; j < shape_.n2; ++j) grow_row(row(j), shape_, reach, padded);
  const int n = shape_.n2, beyond = shape_.periodic[1] ? std::min(reach, n - 1) : 0;
  CellMask grown(shape_);
  for (int j = 0; j < n; ++j) {
    for (int from = j - reach; from <= j + reach; ++from) {
      const bool inside = from >= 0 && from < n;
      if (!inside && (from < -beyond || from > n - 1 + beyond)) continue;
      join(grown.row(j), row(inside ? from : from < 0 ? from + n - 1 : from - n + 1), shape_.n1);
    }
  }
  in_ = std::move(grown.in_);
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

void mark_coarse(const grid::RowSets& fine, CellMask& mask) {
  for (int j = 0; j < fine.rows(); ++j) {
    std::uint8_t* row = mask.row(coarse_index(j));
    for (const grid::Interval& run : fine.row(j))
      std::fill(row + coarse_index(run.begin), row + coarse_index(run.end - 1) + 1, std::uint8_t{1});
  }
}

}  // namespace fsi::fluid
