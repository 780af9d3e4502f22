#pragma once
/// Values along an interface curve at points that are not its own.
///
///     o-----------o-----------o-----------o     points of the curve, s = arclength from the first one
///           x                                   another point: where the curve is closest to it
///
/// Cubic through the four nearest points of the curve (over the ends where the curve is closed or goes on a
/// period further, one-sided at open ends), or linear between two. The places are found once, in the
/// configuration at t = 0.

#include <Eigen/SparseCore>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "common/core/types.hpp"

namespace fsi::coupler {

class CurveInterpolation {
 public:
  /// @param from points of the curve, 2 n, at least two  @param to where values are wanted, 2 m
  /// @param periodic both curves go on beyond their ends, a period further
  CurveInterpolation(std::span<const double> from, std::span<const double> to, bool periodic = false);

  std::size_t points() const { return places_.size(); }
  /// Largest distance of the points wanted from the curve, and the point that has it.
  double largest_distance() const { return places_[farthest_].distance; }
  std::size_t farthest() const { return farthest_; }

  /// Values of any number of components, component-major: n each in `values`, m each in `result`. Exact for
  /// cubic polynomials of the arclength; values at points of the curve are handed on as they are.
  void cubic(std::span<const double> values, std::span<double> result) const;
  /// The weights of `cubic` as a matrix, n x m: values in rows are brought by multiplication from the right.
  Eigen::SparseMatrix<double> cubic_weights() const;
  /// Never outside the two neighbouring values: for what must stay positive.
  void linear(std::span<const double> values, std::span<double> result) const;

 private:
  static constexpr std::size_t widest = 4;
  struct Weights {
    std::size_t count = 0;
    std::array<std::size_t, widest> index{};
    std::array<double, widest> weight{};
    std::array<double, widest> turns{};  ///< periods between the points and those with their indices
  };
  struct Place {
    Weights cubic, linear;
    double distance = 0;  ///< [length]
  };

  Place locate(std::span<const double> from, const Vec2& x) const;
  std::size_t cell_of(double s) const;
  /// Lagrange weights at s of `count` points around a cell.
  Weights weights(std::size_t cell, std::size_t count, double s) const;
  void apply(std::span<const double> values, std::span<double> result, Weights Place::*kind) const;

  std::size_t n_;
  bool periodic_, closed_;
  std::vector<double> s_;
  std::vector<Place> places_;
  std::size_t farthest_ = 0;
};

}  // namespace fsi::coupler
