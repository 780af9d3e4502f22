#pragma once
/// What a case says of one side of a solid, for the kind of boundary that makes a `Boundary` of it. A kind is a file in `kinds/`
/// with
///
///     facts              what it tells others: SolidBoundaryFacts
///     from(SideData)     the condition that the scheme is to keep, as answers to its questions (`Condition`), and its values as functions
///
/// The scheme knows the answers alone.

#include <functional>
#include <map>
#include <string>
#include <utility>

#include "common/case/schema/boundary_facts.hpp"
#include "common/core/types.hpp"
#include "solid_solver/options.hpp"

namespace fsi::solid {

using ScalarFunction = std::function<double(double x, double y, double t)>;

/// Values of the keys of a side's kind, and the reference solution. Functions of the reference position and time.
struct SideData {
  bool from_reference = false;                         ///< in the place of `value` and `state`
  double time_scale = 1;                               ///< in which waves cross the body [time]
  VectorFunction value = {};                           ///< key `value`; empty: it is not there
  VectorFunction velocity = {};                        ///< key `velocity`; empty: it is not there
  std::map<std::string, double> numbers = {};          ///< other keys, by name
  std::map<std::string, ScalarFunction> fields = {};   ///< the same
  std::map<std::string, VectorFunction> vectors = {};  ///< the same
  /// u, v and P of the reference solution. @throws UserMistake where there is none
  std::function<StateFunction()> exact = {};
  /// Its traction on this side, per unit area of the configuration the load belongs to. @throws UserMistake
  std::function<VectorFunction()> exact_traction = {};
};

/// Rate of change of a formula in t, by fourth-order differences: central ones, and one-sided ones where the formula
/// has no value so much earlier, as t^1.5 at the start, or later. @param time_scale time in which it changes by much [time]
inline VectorFunction rate_of(VectorFunction f, double time_scale) {
  return [f = std::move(f), h = 1e-3 * time_scale](double x, double y, double t) -> Vec2 {
    const Vec2 central =
        (8 * (f(x, y, t + h) - f(x, y, t - h)) - (f(x, y, t + 2 * h) - f(x, y, t - 2 * h))) / (12 * h);
    if (central.allFinite()) return central;
    const auto one_sided = [&](double step) -> Vec2 {
      return (-25 * f(x, y, t) + 48 * f(x, y, t + step) - 36 * f(x, y, t + 2 * step) +
              16 * f(x, y, t + 3 * step) - 3 * f(x, y, t + 4 * step)) /
             (12 * step);
    };
    const Vec2 forward = one_sided(h);
    return forward.allFinite() ? forward : one_sided(-h);
  };
}

}  // namespace fsi::solid
