#include "solid_solver/boundary/sides/side_differences.hpp"

namespace fsi::solid {

Tensor2 gradient(const Sides& sides, ConstFieldView q, const SidePoint& p, int first) {
  const SideIndex& line = sides.line(p.side);
  const SideMetrics& m = sides.at(p.side, p.k);
  const Tensor2 along = plus_dyad({}, difference_along(q, line, first, p.k), m.along);
  return plus_dyad(along, difference_across(q, line, first, p.k, m.sign), m.across);
}

void set_corner_ghosts(const Sides& sides, FieldView q, const SidePoint& corner, int first,
                       const Tensor2& gradient) {
  for (const SidePoint& p : {corner, sides.around_corner(corner.side, corner.k)}) {
    const SideMetrics& m = sides.at(p.side, p.k);
    // Dual of grad r: the step in reference space over one index across the side.
    const Vec2 step =
        Vec2(m.along.y(), -m.along.x()) / (m.across.x() * m.along.y() - m.across.y() * m.along.x());
    const Vec2 d = {gradient.a11 * step.x() + gradient.a12 * step.y(),
                    gradient.a21 * step.x() + gradient.a22 * step.y()};
    set_ghost(q, sides.line(p.side), p.k, first, 2.0 * m.sign * d);
  }
}

Tensor2 with_sharper_tangent(const Sides& sides, ConstFieldView q, const SidePoint& p, const Tensor2& F) {
  const SideIndex& line = sides.line(p.side);
  const bool between_images =
      sides.condition_beyond(p.side, 0).imaged() && sides.condition_beyond(p.side, line.n - 1).imaged();
  if (!sides.condition(p.side).meets_gas() || !between_images) return F;
  const int k = p.k;
  const auto difference = [&](ConstFieldView field, int first) -> Vec2 {
    const auto value = [&](int at) {
      const std::ptrdiff_t a = line.at(at, 0);
      return Vec2(field.plane(first)[a], field.plane(first + 1)[a]);
    };
    return (8.0 * (value(k + 1) - value(k - 1)) - (value(k + 2) - value(k - 2))) / 12.0;
  };
  const Vec2 along = difference(sides.grid().x, 0), change = difference(q, plane::u1);
  const Vec2 image = {F.a11 * along.x() + F.a12 * along.y(), F.a21 * along.x() + F.a22 * along.y()};
  return plus_dyad(F, along + change - image, along / along.squaredNorm());
}

}  // namespace fsi::solid
