#include "common/core/field.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <new>

namespace fsi {

namespace {

/// Zeroes a block of memory. The whole pages of a large one are given back to the system, which has them again,
/// zero, once they are touched: what of a field is never used costs no memory.
void zero(double* data, std::size_t size) {
  constexpr std::size_t large = std::size_t{1} << 20;  // [byte]
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE)), in_a_page = page / sizeof(double);
  const std::size_t into_page = reinterpret_cast<std::uintptr_t>(data) % page / sizeof(double);
  const std::size_t before = (in_a_page - into_page) % in_a_page;
  const std::size_t whole = size < before ? 0 : (size - before) / in_a_page * in_a_page;
  const bool given_back =
      size * sizeof(double) >= large && madvise(data + before, whole * sizeof(double), MADV_DONTNEED) == 0;
  if (!given_back) {
    std::fill_n(data, size, 0.0);
    return;
  }
  std::fill_n(data, before, 0.0);
  std::fill(data + before + whole, data + size, 0.0);
}

}  // namespace

Field::Field(Layout layout, int planes) : layout_(layout), planes_(planes) {
  constexpr std::size_t alignment = 64;
  const std::size_t bytes = (size() * sizeof(double) + alignment - 1) / alignment * alignment;
  data_.reset(static_cast<double*>(std::aligned_alloc(alignment, bytes)));
  if (!data_) throw std::bad_alloc();
  zero(data_.get(), size());
}

void Field::clear_plane(int plane) {
  zero(data_.get() + static_cast<std::size_t>(plane) * layout_.plane_size(), layout_.plane_size());
}

Field Field::clone() const {
  Field copy(layout_, planes_);
  std::ranges::copy(values(), copy.values().begin());
  return copy;
}

}  // namespace fsi
