#pragma once
/// Couplers of one or two exchanges.

#include <string>
#include <vector>

#include "coupler/coupler.hpp"
#include "messages.hpp"

namespace fsi::coupler::testing {

/// Points of the interface.
constexpr std::size_t n = 4;

inline CouplerOptions until(double end) {
  CouplerOptions options;
  options.time = {.end = end, .output_times = {}, .growth = 1.2, .dt_max = 0};
  return options;
}

/// Message of the failure of one exchange, or "none".
template <class Failure>
std::string failure(const wire::PredictedInterface& gas, const wire::PredictedInterface& solid) {
  Coupler coupler(until(1), piston_hellos(n));
  try {
    coupler.step(std::vector{gas, solid});
  } catch (const Failure& found) {
    return found.what();
  }
  return "none";
}

}  // namespace fsi::coupler::testing
