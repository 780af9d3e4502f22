#include "fluid_solver/levels/cell_mask.hpp"

#include <algorithm>

namespace fsi::fluid {

namespace {

/// Points of a line within `reach` of a member; `line` has n entries a distance `stride` apart.
struct Line {
  std::uint8_t* first;
  std::ptrdiff_t stride;
  int n;
  bool periodic;
  std::uint8_t& operator[](int k) const { return first[k * stride]; }
};

/// One way along a line; `turn` maps the order of the walk to the order of the points.
template <class Turn>
void spread(const Line& line, std::vector<std::uint8_t>& out, int reach, const Turn& turn) {
  int since = reach + 1;
  // A period before the first point, its end is what the first points can see.
  for (int k = line.periodic ? std::max(line.n - 1 - reach, 0) : line.n; k < line.n - 1; ++k)
    since = line[turn(k)] != 0 ? 0 : since + 1;
  for (int k = 0; k < line.n; ++k) {
    since = line[turn(k)] != 0 ? 0 : since + 1;
    if (since <= reach) out[static_cast<std::size_t>(turn(k))] = 1;
  }
}

void grow_line(const Line& line, std::vector<std::uint8_t>& out, int reach) {
  out.assign(static_cast<std::size_t>(line.n), 0);
  spread(line, out, reach, [](int k) { return k; });
  spread(line, out, reach, [&](int k) { return line.n - 1 - k; });
  for (int k = 0; k < line.n; ++k) line[k] = out[static_cast<std::size_t>(k)];
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

void CellMask::remove(const CellMask& other) {
  for (std::size_t k = 0; k < in_.size(); ++k)
    in_[k] = static_cast<std::uint8_t>(in_[k] != 0 && other.in_[k] == 0 ? 1 : 0);
}

void CellMask::grow(int reach) {
  if (reach <= 0) return;
  std::vector<std::uint8_t> out;
  for (int j = 0; j < shape_.n2; ++j) grow_line({row(j), 1, shape_.n1, shape_.periodic[0]}, out, reach);
  // Rows at once: the number of rows since the last member above, per column.
  std::vector<int> since(static_cast<std::size_t>(shape_.n1), reach + 1);
  CellMask grown(shape_);
  const auto pass = [&](int j) {
    const std::uint8_t* here = row(j);
    std::uint8_t* to = grown.row(j);
    for (std::size_t i = 0; i < since.size(); ++i) {
      since[i] = here[i] != 0 ? 0 : since[i] + 1;
      to[i] = static_cast<std::uint8_t>(to[i] != 0 || since[i] <= reach ? 1 : 0);
    }
  };
  const int n = shape_.n2, before = shape_.periodic[1] ? std::min(reach, n - 1) : 0;
  for (int j = n - 1 - before; j < n - 1; ++j) pass(j);
  for (int j = 0; j < n; ++j) pass(j);
  std::ranges::fill(since, reach + 1);
  for (int j = before; j > 0; --j) pass(j);
  for (int j = n - 1; j >= 0; --j) pass(j);
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
    for (const std::uint8_t* run = std::find(here, end, 1); run != end;) {
      const std::uint8_t* last = std::find(run, end, 0);
      sets.append({static_cast<int>(run - here), static_cast<int>(last - here)});
      run = std::find(last, end, 1);
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
