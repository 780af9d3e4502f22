#include "coupler/exchange/curve_interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/core/component_major.hpp"
#include "coupler/interface_motion.hpp"

namespace fsi::coupler {

namespace {

/// Places this close to a point of the curve, in parts of its length, are that point.
constexpr double same_place = 1e-11;

/// Steps to the closest place of the curve; each reduces the distance to it by about (h / radius)^2.
constexpr int most_steps = 50;

}  // namespace

CurveInterpolation::CurveInterpolation(std::span<const double> from, std::span<const double> to,
                                       bool periodic)
    : n_(from.size() / 2), periodic_(periodic), closed_(periodic || is_closed(from)), s_(n_) {
  arclength(from, s_);
  const std::size_t m = to.size() / 2;
  places_.reserve(m);
  for (std::size_t k = 0; k < m; ++k) {
    // The two copies of a closing point get the same bits.
    const bool again = k > 0 && k + 1 == m && (periodic || is_closed(to));
    places_.push_back(again ? places_.front() : locate(from, vector_at(to, k)));
    if (places_[k].distance > places_[farthest_].distance) farthest_ = k;
  }
}

CurveInterpolation::Place CurveInterpolation::locate(std::span<const double> from, const Vec2& x) const {
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < n_; ++k) {
    if ((vector_at(from, k) - x).norm() < (vector_at(from, nearest) - x).norm()) nearest = k;
  }
  const double length = s_.back();
  double s = s_[nearest];
  std::size_t cell = cell_of(s);
  const Vec2 period = periodic_ ? period_of(from) : Vec2(Vec2::Zero());
  const bool goes_round = closed_ && period.norm() <= same_place * length;  // a ring, whatever closes it
  const auto curve = [&] {
    const Weights w = weights(cell, widest, s);
    Vec2 sum = Vec2::Zero();
    for (std::size_t k = 0; k < w.count; ++k)
      sum += w.weight[k] * (vector_at(from, w.index[k]) + w.turns[k] * period);
    return sum;
  };
  for (int step = 0; step < most_steps; ++step) {
    const Vec2 chord = vector_at(from, cell + 1) - vector_at(from, cell);
    const double change = (x - curve()).dot(chord) / chord.norm();
    s += change;
    if (goes_round) s -= length * std::floor(s / length);
    s = std::clamp(s, 0.0, length);
    cell = cell_of(s);
    if (std::abs(change) < 1e-15 * length) break;
  }
  for (const std::size_t end : {cell, cell + 1}) {
    if (std::abs(s - s_[end]) < same_place * length) s = s_[end];
  }
  return {.cubic = weights(cell, widest, s), .linear = weights(cell, 2, s), .distance = (x - curve()).norm()};
}

std::size_t CurveInterpolation::cell_of(double s) const {
  const auto after = std::upper_bound(s_.begin(), s_.end(), s) - s_.begin();
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after - 1, 0, std::ssize(s_) - 2));
}

CurveInterpolation::Weights CurveInterpolation::weights(std::size_t cell, std::size_t count, double s) const {
  const auto cells = static_cast<std::ptrdiff_t>(n_) - 1;
  const auto distinct = closed_ ? cells : cells + 1;
  const std::ptrdiff_t width = std::min(static_cast<std::ptrdiff_t>(count), distinct);
  std::ptrdiff_t first = static_cast<std::ptrdiff_t>(cell) - (width - 1) / 2;
  if (!closed_) first = std::clamp<std::ptrdiff_t>(first, 0, cells + 1 - width);
  Weights result{.count = static_cast<std::size_t>(width)};
  std::array<double, widest> at{};
  for (std::size_t k = 0; k < result.count; ++k) {
    const std::ptrdiff_t i = first + static_cast<std::ptrdiff_t>(k);
    const std::ptrdiff_t turns = closed_ ? (i < 0 ? -1 : i / cells) : 0;
    result.index[k] = static_cast<std::size_t>(i - turns * cells);
    result.turns[k] = static_cast<double>(turns);
    at[k] = s_[result.index[k]] + result.turns[k] * s_.back();
  }
  for (std::size_t k = 0; k < result.count; ++k) {
    result.weight[k] = 1;
    for (std::size_t l = 0; l < result.count; ++l) {
      if (l != k) result.weight[k] *= (s - at[l]) / (at[k] - at[l]);
    }
  }
  return result;
}

void CurveInterpolation::apply(std::span<const double> values, std::span<double> result,
                               Weights Place::*kind) const {
  const std::size_t m = places_.size();
  for (std::size_t c = 0; c * n_ < values.size(); ++c) {
    for (std::size_t k = 0; k < m; ++k) {
      const Weights& w = places_[k].*kind;
      double sum = 0;
      for (std::size_t l = 0; l < w.count; ++l) sum += w.weight[l] * values[c * n_ + w.index[l]];
      result[c * m + k] = sum;
    }
  }
}

void CurveInterpolation::cubic(std::span<const double> values, std::span<double> result) const {
  apply(values, result, &Place::cubic);
}

Eigen::SparseMatrix<double> CurveInterpolation::cubic_weights() const {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Weights& w = places_[k].cubic;
    for (std::size_t l = 0; l < w.count; ++l)
      entries.emplace_back(static_cast<int>(w.index[l]), static_cast<int>(k), w.weight[l]);
  }
  Eigen::SparseMatrix<double> weights(static_cast<Eigen::Index>(n_),
                                      static_cast<Eigen::Index>(places_.size()));
  weights.setFromTriplets(entries.begin(), entries.end());
  return weights;
}

void CurveInterpolation::linear(std::span<const double> values, std::span<double> result) const {
  apply(values, result, &Place::linear);
}

}  // namespace fsi::coupler
