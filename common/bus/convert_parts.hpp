#pragma once
/// Parts that several messages have, in both directions. Only convert*.cpp include this.

#include <cstdint>
#include <string>
#include <vector>

#include "common/bus/convert.hpp"

namespace fsi::bus {

/// DDS never writes through a borrowed pointer, but its C types know no const.
template <class Sequence, class Element>
Sequence borrowed(const std::vector<Element>& values) {
  Sequence sequence{};
  sequence._length = sequence._maximum = static_cast<std::uint32_t>(values.size());
  sequence._buffer = const_cast<Element*>(values.data());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  sequence._release = false;
  return sequence;
}

inline amp_fsi_Numbers borrow(const std::vector<double>& values) {
  return borrowed<amp_fsi_Numbers>(values);
}

inline amp_fsi_Health borrow(const wire::Health& health) {
  return {.min_rho = health.min_rho,
          .min_p = health.min_p,
          .min_det_F = health.min_det_F,
          .min_cell_quality = health.min_cell_quality,
          .first_order_fallbacks = health.first_order_fallbacks,
          .floors = health.floors};
}

inline void copy(const amp_fsi_Numbers& from, std::vector<double>& to) {
  to.assign(from._buffer, from._buffer + from._length);
}

inline void copy(const char* from, std::string& to) {
  to = from == nullptr ? "" : from;
}

inline void copy(const amp_fsi_Health& from, wire::Health& to) {
  to.min_rho = from.min_rho;
  to.min_p = from.min_p;
  to.min_det_F = from.min_det_F;
  to.min_cell_quality = from.min_cell_quality;
  to.first_order_fallbacks = from.first_order_fallbacks;
  to.floors = from.floors;
}

}  // namespace fsi::bus
