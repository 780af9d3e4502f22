#pragma once
/// Largest of many values, one of which may be no number.

#include <cmath>

namespace fsi {

/// `most` becomes the larger of the two. A NaN among the values stays: std::max would drop it.
inline void raise_to(double& most, double value) {
  if (value > most || std::isnan(value)) most = value;
}

}  // namespace fsi
