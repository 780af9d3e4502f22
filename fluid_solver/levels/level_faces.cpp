#include "fluid_solver/levels/level_faces.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <span>

namespace fsi::fluid {

namespace {

/// The fine faces of a coarse face, in the order of its members.
struct FineFaces {
  std::array<PointIndex, 3> at;
  Members members;
};

/// Fine face 3 i + 1 lies between the last point of control volume i and the first one of the next; of the
/// faces between rows, that before row 3 j - 1.
FineFaces fine_faces(int i, int j, int direction, const LatticeShape& fine, const Ends& ends) {
  FineFaces faces{};
  faces.members = direction == 0 ? members_of(j, fine.n2, {ends[2], ends[3]})
                                 : members_of(i, fine.n1, {ends[0], ends[1]});
  for (std::size_t k = 0; k < faces.at.size(); ++k) {
    faces.at[k] = direction == 0 ? PointIndex{refinement_ratio * i + 1, faces.members.at[k]}
                                 : PointIndex{faces.members.at[k], refinement_ratio * j - 1};
  }
  return faces;
}

/// Faces as a list, each once. They come row by row in order, but for those at the ends of a period.
void assign(FaceList& list, int rows, const std::vector<PointIndex>& faces) {
  std::vector<std::vector<int>::size_type> end(static_cast<std::size_t>(rows) + 1, 0);  // of each row
  for (const PointIndex& face : faces) ++end[static_cast<std::size_t>(face.j) + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<int> by_rows(faces.size());
  for (const PointIndex& face : faces) by_rows[end[static_cast<std::size_t>(face.j)]++] = face.i;
  list.clear(rows);
  std::size_t begin = 0;
  for (int j = 0; j < rows; ++j) {
    const std::span<int> row(by_rows.data() + begin, end[static_cast<std::size_t>(j)] - begin);
    begin += row.size();
    if (!std::ranges::is_sorted(row)) std::ranges::sort(row);
    const auto doubles = std::ranges::unique(row);
    list.append_row(j, row.first(row.size() - doubles.size()));
  }
}

/// The first entry that is one, or the end.
const std::uint8_t* next_member(const std::uint8_t* begin, const std::uint8_t* end) {
  const void* found = std::memchr(begin, 1, static_cast<std::size_t>(end - begin));
  return found == nullptr ? end : static_cast<const std::uint8_t*>(found);
}

/// Of a point beyond an end of a period, the same one within it.
int wrapped(int k, int n) {
  return (k % (n - 1) + n - 1) % (n - 1);
}

}  // namespace

/// Faces along rows have i from -1 on, those between rows j from 0 to n2, as far as they bound points of the
/// lattice; only a period has a rim beyond its ends.
std::vector<LevelFaces::CoarseFace> LevelFaces::rim(const CellMask& covered, int direction) {
  const auto [n1, n2, periodic] = covered.shape();
  std::vector<CoarseFace> faces;
  const bool along = direction == 0, closed = periodic[static_cast<std::size_t>(direction)];
  const auto beyond_an_end = [&](int i, int j) {
    if (!closed || covered.contains(i, along ? j : j - 1) == covered.contains(along ? i + 1 : i, j)) return;
    faces.push_back(
        {.i = i, .j = j, .real_i = along ? wrapped(i, n1) : i, .real_j = along ? j : wrapped(j - 1, n2) + 1});
  };
  std::vector<std::uint8_t> differs(static_cast<std::size_t>(n1));
  for (int j = 0; j < (along ? n2 : n2 + 1); ++j) {
    if (!along && (j == 0 || j == n2)) {
      for (int i = 0; i < n1; ++i) beyond_an_end(i, j);
      continue;
    }
    if (along) beyond_an_end(-1, j);
    const std::uint8_t *before = covered.row(along ? j : j - 1), *after = along ? before + 1 : covered.row(j);
    const int n = along ? n1 - 1 : n1;
    std::uint8_t* differ = differs.data();
#pragma omp simd
    for (int i = 0; i < n; ++i) differ[i] = before[i] ^ after[i];
    const std::uint8_t* end = differ + n;
    for (const std::uint8_t* at = next_member(differ, end); at != end; at = next_member(at + 1, end)) {
      const int i = static_cast<int>(at - differ);
      faces.push_back({.i = i, .j = j, .real_i = i, .real_j = j});
    }
    if (along) beyond_an_end(n1 - 1, j);
  }
  return faces;
}

std::vector<LevelFaces::Source> LevelFaces::link(const std::vector<CoarseFace>& faces, int direction,
                                                 const LatticeShape& fine, const Ends& ends,
                                                 FaceList& noted) {
  std::vector<PointIndex> all;
  for (const CoarseFace& face : faces) {
    const FineFaces parts = fine_faces(face.real_i, face.real_j, direction, fine, ends);
    all.insert(all.end(), parts.at.begin(), parts.at.begin() + parts.members.n);
  }
  assign(noted, fine.n2 + 1, all);
  std::vector<Source> sources;
  sources.reserve(faces.size());
  for (const CoarseFace& face : faces) {
    const FineFaces parts = fine_faces(face.real_i, face.real_j, direction, fine, ends);
    Source source{.n = parts.members.n, .weight = parts.members.weight, .mirrored = parts.members.mirrored};
    for (std::size_t k = 0; k < static_cast<std::size_t>(source.n); ++k)
      source.from[k] = noted.first_from(parts.at[k].i, parts.at[k].j);
    sources.push_back(source);
  }
  return sources;
}

LevelFaces::LevelFaces(const CellMask& covered, const LatticeShape& fine, const Ends& ends, FaceFluxes& noted,
                       FaceFluxes& imposed) {
  for (const int direction : {0, 1}) {
    const std::vector<CoarseFace> faces = rim(covered, direction);
    (direction == 0 ? along_ : between_) =
        link(faces, direction, fine, ends, direction == 0 ? noted.along : noted.between);
    std::vector<PointIndex> here;
    for (const CoarseFace& face : faces) here.push_back({face.i, face.j});
    assign(direction == 0 ? imposed.along : imposed.between, covered.shape().n2 + 1, here);
  }
}

void LevelFaces::match(const FaceFluxes& noted, FaceFluxes& imposed) const {
  const auto add = [](const std::vector<Source>& sources, const FaceList& from, FaceList& to,
                      std::size_t momentum_along) {
    // Fluxes are per volume of a cell: a coarse one is three times as wide as a fine one.
    constexpr double width = 1.0 / refinement_ratio;
    for (std::size_t face = 0; face < sources.size(); ++face) {
      const Source& source = sources[face];
      FaceValues sum{};
      for (std::size_t k = 0; k < static_cast<std::size_t>(source.n); ++k) {
        for (std::size_t c = 0; c < sum.size(); ++c)
          sum[c] += width * source.weight[k] * from.flux(source.from[k])[c];
      }
      if (source.mirrored) sum[momentum_along] = 0;
      to.flux(face) = sum;
    }
  };
  add(along_, noted.along, imposed.along, 2);
  add(between_, noted.between, imposed.between, 1);
}

}  // namespace fsi::fluid
