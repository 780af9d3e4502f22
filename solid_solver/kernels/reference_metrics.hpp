#pragma once
/// Geometry of the static reference grid, computed once. Index coordinates have unit spacing: r1 = i, r2 = j.

#include "common/core/field.hpp"
#include "common/core/types.hpp"

namespace fsi::solid {

/// Geometry at one point.
struct PointMetrics {
  Vec2 r1, r2;          ///< grad r1, grad r2
  double jacobian = 0;  ///< J_g [length^2]
};

/// Metrics of a mapped reference grid.
///
/// The control volume of point (i, j) is the polygon whose corners are the averages of four vertices; it
/// closes exactly, so a uniform stress gives no force. Derivatives at a point use grad r from central
/// differences of the vertices, so a linear displacement gives the exact F. A uniform Cartesian grid stores
/// two spacings only.
class ReferenceMetrics {
 public:
  /// Planes of `values()`. Faces are stored with the point on
  /// their upper side: a1 at (i, j) is the face i - 1/2.
  enum Plane {
    a1x,
    a1y,  ///< area vector J grad r1 of the face i - 1/2, pointing to growing i
    a2x,
    a2y,           ///< area vector J grad r2 of the face j - 1/2
    inverse_area,  ///< 1 / area of the control volume
    r1x,
    r1y,  ///< grad r1 at the point
    r2x,
    r2y,       ///< grad r2 at the point
    jacobian,  ///< J_g at the point
    plane_count
  };

  /// @param x vertices (planes x, y) with two ghost lines
  explicit ReferenceMetrics(ConstFieldView x);

  /// Stored metrics, valid at the points and one ghost line around them (faces a1 also at i = n1 + 1, a2 at
  /// j = n2 + 1). No planes on a Cartesian grid.
  ConstFieldView values() const { return values_.view(); }
  PointMetrics at(int i, int j) const;
  bool cartesian() const { return cartesian_; }
  /// Largest |grad r1| + |grad r2|: cells per length that a wave crosses, at most [1/length].
  double largest_rate(const Layout& layout) const;
  /// Spacings of a Cartesian grid.
  double h1() const { return h1_; }
  double h2() const { return h2_; }

 private:
  void find_spacing(ConstFieldView x);
  void fill_faces(ConstFieldView x);
  void fill_points(ConstFieldView x);

  Field values_;
  bool cartesian_ = false;
  double h1_ = 0, h2_ = 0;
};

}  // namespace fsi::solid
