#include "common/core/field.hpp"

#include <algorithm>
#include <new>

namespace fsi {

Field::Field(Layout layout, int planes) : layout_(layout), planes_(planes) {
  constexpr std::size_t alignment = 64;
  const std::size_t bytes = (size() * sizeof(double) + alignment - 1) / alignment * alignment;
  data_.reset(static_cast<double*>(std::aligned_alloc(alignment, bytes)));
  if (!data_) throw std::bad_alloc();
  std::ranges::fill(values(), 0.0);
}

Field Field::clone() const {
  Field copy(layout_, planes_);
  std::ranges::copy(values(), copy.values().begin());
  return copy;
}

}  // namespace fsi
