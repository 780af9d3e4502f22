#pragma once
/// Integral over time of a few rates, by the trapezoidal rule.

#include <array>
#include <cstddef>

#include "common/core/archive.hpp"

namespace fsi {

template <std::size_t n>
class TimeIntegral {
 public:
  /// The rates after a step of size dt (0: the first ones).
  void add(const std::array<double, n>& rates, double dt) {
    for (std::size_t k = 0; k < n; ++k) sum_[k] += 0.5 * dt * (last_[k] + rates[k]);
    last_ = rates;
  }
  const std::array<double, n>& sum() const { return sum_; }

  void archive(Archive& archive) {
    archive.values("sum", sum_);
    archive.values("last", last_);
  }

 private:
  std::array<double, n> sum_{}, last_{};
};

}  // namespace fsi
