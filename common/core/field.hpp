#pragma once
/// Structure-of-arrays fields on one component grid.
///
/// A Field owns `planes` planes of (n1 + ghosts) x (n2 + ghosts) doubles. A point (i, j) with 0 <= i < n1,
/// 0 <= j < n2 lies in the grid; two ghost lines surround it: -2 <= i < n1 + 2, -2 <= j < n2 + 2. The first
/// index is contiguous; every row starts on a cache line (point i = 0 is 64-byte aligned) and ends with
/// enough padding for a whole vector to be read past the last ghost.

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <span>

namespace fsi {

/// Shape of a grid and the place of its points in memory.
struct Layout {
  static constexpr int ghosts = 2;
  static constexpr int lead = 8;  ///< doubles before point i = 0 of a row (holds the ghosts, keeps alignment)

  int n1 = 0;      ///< points along the contiguous direction
  int n2 = 0;      ///< points along the other direction
  int stride = 0;  ///< doubles from (i, j) to (i, j + 1)

  Layout() = default;
  constexpr Layout(int points1, int points2)
      : n1(points1), n2(points2), stride((lead + points1 + ghosts + 8 + 7) / 8 * 8) {}

  /// Position of point (i, j) in a plane.
  constexpr std::ptrdiff_t at(int i, int j) const {
    return static_cast<std::ptrdiff_t>(j + ghosts) * stride + i + lead;
  }
  /// Doubles of one plane.
  constexpr std::size_t plane_size() const {
    return static_cast<std::size_t>(n2 + 2 * ghosts) * static_cast<std::size_t>(stride) + lead;
  }
  constexpr std::size_t points() const { return static_cast<std::size_t>(n1) * static_cast<std::size_t>(n2); }
  bool operator==(const Layout&) const = default;
};

/// Borrowed view of a field; T is double or const double.
template <class T>
struct BasicFieldView {
  T* data = nullptr;
  Layout layout;
  int planes = 0;

  T& operator()(int plane, int i, int j) const { return data[offset(plane) + layout.at(i, j)]; }
  /// Pointer to point (0, j) of a plane; row(k, j)[i] is valid for -2 <= i < n1 + 2.
  T* row(int plane, int j) const { return data + offset(plane) + layout.at(0, j); }
  T* plane(int k) const { return data + offset(k); }

  operator BasicFieldView<const double>() const {
    return {data, layout, planes};
  }  // NOLINT(google-explicit-constructor)

 private:
  std::ptrdiff_t offset(int k) const {
    return static_cast<std::ptrdiff_t>(k) * static_cast<std::ptrdiff_t>(layout.plane_size());
  }

 public:
  BasicFieldView() = default;
  BasicFieldView(T* values, Layout shape, int plane_count)
      : data(values), layout(shape), planes(plane_count) {}
};

using FieldView = BasicFieldView<double>;
using ConstFieldView = BasicFieldView<const double>;

/// Owner of a field's memory, zero at birth. Copies are explicit (`clone`), moves are cheap.
class Field {
 public:
  Field() = default;
  Field(Layout layout, int planes);

  FieldView view() { return {data_.get(), layout_, planes_}; }
  ConstFieldView view() const { return {data_.get(), layout_, planes_}; }
  double& operator()(int plane, int i, int j) { return view()(plane, i, j); }
  double operator()(int plane, int i, int j) const { return view()(plane, i, j); }
  const Layout& layout() const { return layout_; }
  int planes() const { return planes_; }
  /// All values, ghosts and padding included: for checkpoints and bit comparisons.
  std::span<double> values() { return {data_.get(), size()}; }
  std::span<const double> values() const { return {data_.get(), size()}; }
  Field clone() const;
  /// Zeros in a plane, ghosts and padding included; a large one then takes no memory until it is written to.
  void clear_plane(int plane);

 private:
  struct Free {
    void operator()(double* p) const { std::free(p); }  // NOLINT(cppcoreguidelines-no-malloc)
  };
  std::size_t size() const { return layout_.plane_size() * static_cast<std::size_t>(planes_); }

  std::unique_ptr<double[], Free> data_;
  Layout layout_;
  int planes_ = 0;
};

}  // namespace fsi
