#include "solid_solver/rigid/given_motion.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace fsi::rigid {

namespace {

/// Weights of values at `first`, `first` + 1, .. steps from t, for a derivative times step^order.
struct Stencil {
  int first;
  std::array<double, 6> weights;
};

constexpr Stencil stencil(int order, bool forward) {
  if (order == 1)
    return forward ? Stencil{0, {-25. / 12, 4, -3, 4. / 3, -1. / 4, 0}}
                   : Stencil{-2, {1. / 12, -2. / 3, 0, 2. / 3, -1. / 12, 0}};
  return forward ? Stencil{0, {15. / 4, -77. / 6, 107. / 6, -13, 61. / 12, -5. / 6}}
                 : Stencil{-2, {-1. / 12, 4. / 3, -5. / 2, 4. / 3, -1. / 12, 0}};
}

constexpr double share = 1e-5;  ///< of the end of the case: that error and that of round-off are small

}  // namespace

GivenMotion::GivenMotion(Formulas formulas, double t_end) : formulas_(std::move(formulas)) {
  if (std::ranges::any_of(formulas_, &std::optional<Expression>::has_value)) step_ = share * t_end;
}

void GivenMotion::put(double t, Vec3& q) const {
  for (std::size_t k = 0; k < formulas_.size(); ++k)
    if (formulas_[k]) q[static_cast<Eigen::Index>(k)] = (*formulas_[k])(0, 0, t);
}

Vec3 GivenMotion::difference(double t, int order) const {
  Vec3 sum = Vec3::Zero();
  if (!*this) return sum;
  const Stencil of = stencil(order, t < 2 * step_);
  for (std::size_t k = 0; k < of.weights.size(); ++k) {
    if (of.weights[k] == 0) continue;
    Vec3 q = Vec3::Zero();
    put(t + (of.first + static_cast<int>(k)) * step_, q);
    sum += of.weights[k] * q;
  }
  return sum / (order == 1 ? step_ : step_ * step_);
}

}  // namespace fsi::rigid
