#include "solid_solver/kernels/reference_metrics.hpp"

#include <algorithm>
#include <cmath>

namespace fsi::solid {

namespace {

/// Corner (i - 1/2, j - 1/2) of the control volumes.
Vec2 corner(ConstFieldView x, int i, int j) {
  return {0.25 * ((x(0, i - 1, j - 1) + x(0, i, j - 1)) + (x(0, i - 1, j) + x(0, i, j))),
          0.25 * ((x(1, i - 1, j - 1) + x(1, i, j - 1)) + (x(1, i - 1, j) + x(1, i, j)))};
}

}  // namespace

ReferenceMetrics::ReferenceMetrics(ConstFieldView x) {
  find_spacing(x);
  if (cartesian_) return;
  values_ = Field(x.layout, plane_count);
  fill_faces(x);
  fill_points(x);
}

void ReferenceMetrics::find_spacing(ConstFieldView x) {
  const Layout& shape = x.layout;
  h1_ = (x(0, shape.n1 - 1, 0) - x(0, 0, 0)) / (shape.n1 - 1);
  h2_ = (x(1, 0, shape.n2 - 1) - x(1, 0, 0)) / (shape.n2 - 1);
  const double size =
      std::abs(h1_) * shape.n1 + std::abs(h2_) * shape.n2 + std::abs(x(0, 0, 0)) + std::abs(x(1, 0, 0));
  double defect = 0;
  for (int j = -Layout::ghosts; j < shape.n2 + Layout::ghosts; ++j) {
    for (int i = -Layout::ghosts; i < shape.n1 + Layout::ghosts; ++i) {
      defect = std::max({defect, std::abs(x(0, i, j) - (x(0, 0, 0) + i * h1_)),
                         std::abs(x(1, i, j) - (x(1, 0, 0) + j * h2_))});
    }
  }
  cartesian_ = h1_ > 0 && h2_ > 0 && defect < 1e-14 * size;
}

void ReferenceMetrics::fill_faces(ConstFieldView x) {
  const Layout& shape = x.layout;
  FieldView m = values_.view();
  for (int j = -1; j <= shape.n2 + 1; ++j) {
    for (int i = -1; i <= shape.n1 + 1; ++i) {
      const Vec2 here = corner(x, i, j);
      const Vec2 up = j <= shape.n2 ? corner(x, i, j + 1) : here;
      const Vec2 right = i <= shape.n1 ? corner(x, i + 1, j) : here;
      m(a1x, i, j) = up.y() - here.y();
      m(a1y, i, j) = here.x() - up.x();
      m(a2x, i, j) = here.y() - right.y();
      m(a2y, i, j) = right.x() - here.x();
      if (j > shape.n2 || i > shape.n1) continue;
      const Vec2 d = corner(x, i + 1, j + 1) - here, e = up - right;
      m(inverse_area, i, j) = 2.0 / (d.x() * e.y() - d.y() * e.x());
    }
  }
}

void ReferenceMetrics::fill_points(ConstFieldView x) {
  const Layout& shape = x.layout;
  FieldView m = values_.view();
  for (int j = -1; j <= shape.n2; ++j) {
    for (int i = -1; i <= shape.n1; ++i) {
      const double x1 = 0.5 * (x(0, i + 1, j) - x(0, i - 1, j)), y1 = 0.5 * (x(1, i + 1, j) - x(1, i - 1, j));
      const double x2 = 0.5 * (x(0, i, j + 1) - x(0, i, j - 1)), y2 = 0.5 * (x(1, i, j + 1) - x(1, i, j - 1));
      const double J = x1 * y2 - x2 * y1;
      m(jacobian, i, j) = J;
      m(r1x, i, j) = y2 / J;
      m(r1y, i, j) = -x2 / J;
      m(r2x, i, j) = -y1 / J;
      m(r2y, i, j) = x1 / J;
    }
  }
}

double ReferenceMetrics::largest_rate(const Layout& layout) const {
  double rate = 0;
  for (int j = 0; j < layout.n2; ++j) {
    for (int i = 0; i < layout.n1; ++i) {
      const PointMetrics m = at(i, j);
      rate = std::max(rate, m.r1.norm() + m.r2.norm());
    }
  }
  return rate;
}

PointMetrics ReferenceMetrics::at(int i, int j) const {
  if (cartesian_) return {.r1 = {1.0 / h1_, 0.0}, .r2 = {0.0, 1.0 / h2_}, .jacobian = h1_ * h2_};
  const ConstFieldView m = values_.view();
  return {
      .r1 = {m(r1x, i, j), m(r1y, i, j)}, .r2 = {m(r2x, i, j), m(r2y, i, j)}, .jacobian = m(jacobian, i, j)};
}

}  // namespace fsi::solid
