#pragma once
/// Fluxes through chosen faces of a grid: noted by a step, or imposed on it.

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "fluid_solver/kernels/rows.hpp"

namespace fsi::fluid {

/// Mass, momentum (2) and energy as a FluxRow has them.
using FaceValues = std::array<double, 4>;

/// Faces of one direction, row by row, in order of their index.
class FaceList {
 public:
  /// Empty, for so many rows.
  void clear(int rows) {
    at_.clear();
    flux_.clear();
    first_.assign(static_cast<std::size_t>(rows) + 1, 0);
  }
  /// The faces of the next row, sorted.
  void append_row(int row, std::span<const int> faces) {
    at_.insert(at_.end(), faces.begin(), faces.end());
    flux_.resize(at_.size());
    first_[static_cast<std::size_t>(row) + 1] = at_.size();
  }
  bool empty() const { return at_.empty(); }
  std::size_t size() const { return at_.size(); }
  /// Number of the first face of a row, of the next row's for row + 1.
  std::size_t first(int row) const { return first_[static_cast<std::size_t>(row)]; }
  /// Of a row's faces, the number of the first one from face i on.
  std::size_t first_from(int i, int row) const {
    const auto begin = at_.begin() + static_cast<std::ptrdiff_t>(first(row)),
               end = at_.begin() + static_cast<std::ptrdiff_t>(first(row + 1));
    return static_cast<std::size_t>(std::lower_bound(begin, end, i) - at_.begin());
  }
  int at(std::size_t face) const { return at_[face]; }
  int row_of(std::size_t face) const {
    return static_cast<int>(std::upper_bound(first_.begin(), first_.end(), face) - first_.begin()) - 1;
  }
  FaceValues& flux(std::size_t face) { return flux_[face]; }
  const FaceValues& flux(std::size_t face) const { return flux_[face]; }
  std::span<FaceValues> all() { return flux_; }

 private:
  std::vector<int> at_;
  std::vector<FaceValues> flux_;
  std::vector<std::size_t> first_;
};

/// Along a row: face i lies between points i and i + 1. Between rows: face i of row r lies between points (i,
/// r - 1) and (i, r).
struct FaceFluxes {
  FaceList along, between;
};

/// Writes the fluxes of a row at the faces of a list within a range.
inline void impose(const FaceList& faces, int row, Range range, FluxRow flux) {
  if (faces.empty()) return;
  const std::size_t end = faces.first(row + 1);
  for (std::size_t k = faces.first_from(range.first, row); k < end && faces.at(k) < range.last; ++k) {
    const int i = faces.at(k);
    flux.mass[i] = faces.flux(k)[0];
    flux.momentum1[i] = faces.flux(k)[1];
    flux.momentum2[i] = faces.flux(k)[2];
    flux.energy[i] = faces.flux(k)[3];
  }
}

/// Keeps the fluxes of a row at the faces of a list within a range.
inline void note(FaceList& faces, int row, Range range, FluxRow flux) {
  if (faces.empty()) return;
  const std::size_t end = faces.first(row + 1);
  for (std::size_t k = faces.first_from(range.first, row); k < end && faces.at(k) < range.last; ++k) {
    const int i = faces.at(k);
    faces.flux(k) = {flux.mass[i], flux.momentum1[i], flux.momentum2[i], flux.energy[i]};
  }
}

}  // namespace fsi::fluid
