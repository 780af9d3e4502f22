#include "common/grid/interpolation.hpp"

#include <algorithm>
#include <cmath>

namespace fsi::grid {

namespace {

template <int width>
double apply_width(const InterpolationList& list, FieldView target, ConstFieldView donor) {
  const int stride = donor.layout.stride;
  double change = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const double* w = list.weight.data() + k * width * width;
    for (int plane = 0; plane < target.planes; ++plane) {
      const double* from = donor.plane(plane) + list.donor[k];
      double sum = 0;
      for (int m = 0; m < width; ++m) {
        for (int l = 0; l < width; ++l) sum += w[width * m + l] * from[m * stride + l];
      }
      double& to = target.plane(plane)[list.target[k]];
      change = std::max(change, std::abs(sum - to));
      to = sum;
    }
  }
  return change;
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
}

void InterpolationList::reserve(std::size_t points) {
  target.reserve(points);
  donor.reserve(points);
  weight.reserve(points * static_cast<std::size_t>(width * width));
}

void InterpolationList::append(std::ptrdiff_t at, std::ptrdiff_t donor_at, const Stencil& stencil) {
  target.push_back(static_cast<std::int32_t>(at));
  donor.push_back(static_cast<std::int32_t>(donor_at));
  const auto along = lagrange_weights(stencil.r, width), across = lagrange_weights(stencil.s, width);
  for (int m = 0; m < width; ++m) {
    for (int l = 0; l < width; ++l) {
      weight.push_back(along[static_cast<std::size_t>(l)] * across[static_cast<std::size_t>(m)]);
    }
  }
}

double apply(const InterpolationList& list, FieldView target, ConstFieldView donor) {
  return list.width == 3 ? apply_width<3>(list, target, donor) : apply_width<2>(list, target, donor);
}

}  // namespace fsi::grid
