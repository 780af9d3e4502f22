#include "common/grid/overlap/interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace fsi::grid {

namespace {

/// Sum of weight times value over the stencil at `from`. The trip counts are known, so nothing of the loops is left.
template <int width>
[[gnu::always_inline]] inline double weighted(const double* w, const double* from, std::ptrdiff_t stride) {
  double sum = 0;
#pragma GCC unroll 3
  for (int m = 0; m < width; ++m) {
#pragma GCC unroll 3
    for (int l = 0; l < width; ++l) sum += w[width * m + l] * from[m * stride + l];
  }
  return sum;
}

using Four = double __attribute__((vector_size(32)));

[[gnu::always_inline]] inline Four four_from(const double* values) {
  Four all;
  std::memcpy(&all, values, sizeof all);
  return all;
}

/// The weights of the three rows of a stencil of width 3; the fourth number of a row is none of it.
struct RowsOfWeights {
  Four row[3];

  explicit RowsOfWeights(const double* w)
      : row{four_from(w), four_from(w + 3), __builtin_shufflevector(four_from(w + 5), Four{}, 1, 2, 3, 3)} {}
};

/// The same sums, in the same order, for four planes that lie `to_next` apart: the products of a row of a stencil are made at once
/// and turned, so that the sums of the planes go on side by side. Reads one number beyond a row.
[[gnu::always_inline]] inline Four weighted_in_four_planes(const RowsOfWeights& w, const double* from,
                                                           std::ptrdiff_t stride, std::ptrdiff_t to_next) {
  Four sums{};
#pragma GCC unroll 3
  for (int m = 0; m < 3; ++m, from += stride) {
    const Four a = w.row[m] * four_from(from), b = w.row[m] * four_from(from + to_next),
               c = w.row[m] * four_from(from + 2 * to_next), d = w.row[m] * four_from(from + 3 * to_next);
    const Four ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6),
               ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7),
               cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6),
               cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    sums += __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
    sums += __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
    sums += __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
  }
  return sums;
}

constexpr int most_planes = 16;

/// What a sweep did to the values of each plane, which may have other units than the next one's.
struct Sweep {
  std::array<double, most_planes> change{};  ///< largest one
  std::array<double, most_planes> size{};    ///< of the largest value
};

/// Calls take(plane, old value, new value) for the points of a list, plane by plane.
template <int width, class Take>
void each_value(const InterpolationList& list, FieldView target, ConstFieldView donor, const Take& take) {
  constexpr auto points = static_cast<std::size_t>(width) * width;  // of a donor
  const std::ptrdiff_t stride = donor.layout.stride;
  const auto from_next = static_cast<std::ptrdiff_t>(donor.layout.plane_size()),
             to_next = static_cast<std::ptrdiff_t>(target.layout.plane_size());
  const double* w = list.weight.data();
  for (std::size_t k = 0; k < list.size(); ++k, w += points) {
    const double* from = donor.data + list.donor[k];
    double* to = target.data + list.target[k];
    int plane = 0;
    if constexpr (width == 3) {
      const RowsOfWeights weights(w);
      for (; plane + 4 <= target.planes; plane += 4, from += 4 * from_next) {
        const Four sums = weighted_in_four_planes(weights, from, stride, from_next);
#pragma GCC unroll 4
        for (int p = 0; p < 4; ++p, to += to_next) take(plane + p, *to, sums[p]);
      }
    }
    for (; plane < target.planes; ++plane, from += from_next, to += to_next)
      take(plane, *to, weighted<width>(w, from, stride));
  }
}

template <int width>
void apply_width(const InterpolationList& list, FieldView target, ConstFieldView donor, Sweep* told) {
  if (told == nullptr) {
    each_value<width>(list, target, donor, [](int, double& to, double sum) { to = sum; });
    return;
  }
  each_value<width>(list, target, donor, [told](int plane, double& to, double sum) {
    const auto p = static_cast<std::size_t>(plane);
    told->change[p] = std::max(told->change[p], std::abs(sum - to));
    told->size[p] = std::max(told->size[p], std::abs(sum));
    to = sum;
  });
}

void apply(const InterpolationList& list, std::span<const FieldView> fields, Sweep* told) {
  const FieldView target = fields[static_cast<std::size_t>(list.target_grid)];
  const ConstFieldView donor = fields[static_cast<std::size_t>(list.donor_grid)];
  if (list.width == 3)
    apply_width<3>(list, target, donor, told);
  else
    apply_width<2>(list, target, donor, told);
}

/// Whether the changes of each plane are at most this part of what they were, or of its values.
bool below(const Sweep& last, const Sweep& first, double of_first, double of_size) {
  for (std::size_t p = 0; p < last.change.size(); ++p) {
    if (last.change[p] > std::max(of_first * first.change[p], of_size * last.size[p])) return false;
  }
  return true;
}

}  // namespace

std::array<double, 3> lagrange_weights(double r, int width) {
  if (width == 2) return {1 - r, r, 0};
  return {0.5 * (r - 1) * (r - 2), r * (2 - r), 0.5 * r * (r - 1)};
}

void InterpolationList::clear() {
  target.clear();
  donor.clear();
  weight.clear();
  x.clear();
}

void InterpolationList::reserve(std::size_t points) {
  target.reserve(points);
  donor.reserve(points);
  weight.reserve(points * static_cast<std::size_t>(width * width));
  if (implicit) x.reserve(points);
}

void InterpolationList::move(std::size_t from, std::size_t to) {
  if (from == to) return;
  target[to] = target[from];
  donor[to] = donor[from];
  const auto weights = static_cast<std::size_t>(width * width);
  std::copy_n(weight.data() + from * weights, weights, weight.data() + to * weights);
  if (implicit) x[to] = x[from];
}

void InterpolationList::cut(std::size_t points) {
  target.resize(points);
  donor.resize(points);
  weight.resize(points * static_cast<std::size_t>(width * width));
  if (implicit) x.resize(points);
}

void InterpolationList::append(std::ptrdiff_t at, std::ptrdiff_t donor_at, const Stencil& stencil,
                               const std::array<double, 2>& place) {
  target.push_back(static_cast<std::int32_t>(at));
  donor.push_back(static_cast<std::int32_t>(donor_at));
  if (implicit) x.push_back(place);
  const auto along = lagrange_weights(stencil.r, width), across = lagrange_weights(stencil.s, width);
  for (int m = 0; m < width; ++m) {
    for (int l = 0; l < width; ++l) {
      weight.push_back(along[static_cast<std::size_t>(l)] * across[static_cast<std::size_t>(m)]);
    }
  }
}

void apply(const InterpolationList& list, std::span<const FieldView> fields) {
  apply(list, fields, nullptr);
}

bool settle_implicit(std::span<const InterpolationList> lists, std::span<const FieldView> fields) {
  constexpr int most_sweeps = 50;
  constexpr double settled = 1e-13, round_off = 4 * std::numeric_limits<double>::epsilon(), tolerable = 1e-9;
  Sweep first, last;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    last = {};
    for (const InterpolationList& list : lists) {
      if (list.implicit) apply(list, fields, &last);
    }
    for (std::size_t p = 0; p < last.change.size(); ++p)
      first.change[p] = std::max(first.change[p], last.change[p]);
    if (below(last, first, settled, round_off)) return true;
  }
  return below(last, first, 0, tolerable);
}

}  // namespace fsi::grid
