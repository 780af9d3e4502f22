#pragma once
/// What the gas does to a body along its outline.

#include <span>

#include "common/core/archive.hpp"
#include "common/core/types.hpp"

namespace fsi::bodies {

struct GasLoad {
  Vec2 force = Vec2::Zero();
  double moment = 0;  ///< about the origin [force*length/depth]
  double power = 0;   ///< [power/depth]

  void archive(Archive& archive);
};

GasLoad operator+(const GasLoad& a, const GasLoad& b);

/// Sum over the points `x` of an outline (2 n) of the normal traction
/// w_n along n, each on the half of its adjoining segments.
GasLoad load_of_gas(std::span<const double> x, std::span<const double> n, std::span<const double> w_n,
                    std::span<const double> v_n);

/// Time integrals of the loads, by the trapezoidal rule.
class Impulse {
 public:
  void add(const GasLoad& load, double dt);
  void archive(Archive& archive);
  const GasLoad& sum() const { return sum_; }  ///< impulse, angular impulse, work

 private:
  GasLoad sum_, last_;
};

}  // namespace fsi::bodies
