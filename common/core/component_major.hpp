#pragma once
/// Lists of vectors as messages and curves have them: component c of vector k at [c * n + k]. Fields of vectors have their
/// components in planes 0 and 1.

#include <cstddef>
#include <span>

#include "common/core/field.hpp"
#include "common/core/types.hpp"

namespace fsi {

inline Vec2 vector_at(std::span<const double> values, std::size_t k) {
  return {values[k], values[values.size() / 2 + k]};
}

inline Vec2 vector_at(ConstFieldView x, int i, int j) {
  return {x(0, i, j), x(1, i, j)};
}

}  // namespace fsi
