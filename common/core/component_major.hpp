#pragma once
/// Lists of vectors as messages and curves have them: component c of vector k at [c * n + k].

#include <cstddef>
#include <span>

#include "common/core/types.hpp"

namespace fsi {

inline Vec2 vector_at(std::span<const double> values, std::size_t k) {
  return {values[k], values[values.size() / 2 + k]};
}

}  // namespace fsi
