#include "common/interface/band.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace fsi {

namespace {

/// Columns are taken by so many entries at once, of which the last ones may be zeros.
constexpr Eigen::Index lanes = 4;
using Lanes = Eigen::Array<double, lanes, 1>;

}  // namespace

void BandedFactors::resize(Eigen::Index rows, Eigen::Index width) {
  rows_ = rows;
  width_ = width;
  blocks_ = width / lanes + 1;
  stride_ = (width + blocks_ * lanes + lanes - 1) / lanes * lanes;
  values_.assign(static_cast<std::size_t>((rows + width) * stride_), 0.0);
  inverse_.assign(static_cast<std::size_t>(rows), 0.0);
}

void BandedFactors::set_zero() {
  for (Eigen::Index k = 0; k < rows_; ++k) std::fill_n(values() + k * stride_, blocks_ * lanes, 0.0);
}

/// Column by column: from each, those before it that reach it are taken, times their own entries in its row.
bool BandedFactors::factorize() {
  for (Eigen::Index k = 0; k < rows_; ++k) {
    double* const own = values() + k * stride_;
    const double diagonal = own[0];
    const Eigen::Index reaching = std::min(width_, k);
    for (Eigen::Index block = 0; block < blocks_; ++block) {
      Lanes sum = Lanes::Map(own + block * lanes);
      for (Eigen::Index i = reaching; i > 0; --i) {
        const double* const before = own - i * stride_ + i;
        sum -= before[0] * inverse_[static_cast<std::size_t>(k - i)] * Lanes::Map(before + block * lanes);
      }
      Lanes::Map(own + block * lanes) = sum;
    }
    if (std::abs(own[0]) <= pivot_round_off * std::abs(diagonal)) return false;
    inverse_[static_cast<std::size_t>(k)] = 1 / own[0];
  }
  return true;
}

/// In each sum the unknown found last comes last: so the sums of many rows are at work at once.
Eigen::VectorXd BandedFactors::solve(const Eigen::VectorXd& right) const {
  Eigen::VectorXd x(rows_);
  for (Eigen::Index k = 0; k < rows_; ++k) {
    const double* const own = values_.data() + k * stride_;
    double rest = right[k];
    for (Eigen::Index i = std::min(width_, k); i > 0; --i) rest -= own[i - i * stride_] * x[k - i];
    x[k] = rest * inverse_[static_cast<std::size_t>(k)];
  }
  for (Eigen::Index k = rows_ - 1; k >= 0; --k) {
    const double* const own = values_.data() + k * stride_;
    double of_others = 0;
    for (Eigen::Index i = std::min(width_, rows_ - 1 - k); i > 0; --i) of_others += own[i] * x[k + i];
    x[k] -= inverse_[static_cast<std::size_t>(k)] * of_others;
  }
  return x;
}

}  // namespace fsi
