#include "solid_solver/rigid/inertia.hpp"

#include <cstddef>
#include <stdexcept>

namespace fsi::rigid {

Inertia inertia_of(std::span<const double> x) {
  const std::size_t n = x.size() / 2;
  if (n < 3) throw std::invalid_argument("a region needs a rim of three points");
  const Vec2 origin(x[0], x[n]);  // near the body: far from (0, 0) no digits are lost
  double area = 0, polar = 0;
  Vec2 first = Vec2::Zero();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n;
    const Vec2 a = Vec2(x[k], x[n + k]) - origin, b = Vec2(x[next], x[n + next]) - origin;
    const double twice = a.x() * b.y() - a.y() * b.x();  // of the triangle to the origin
    area += twice / 2;
    first += twice / 6 * (a + b);
    polar += twice / 12 * (a.dot(a) + a.dot(b) + b.dot(b));
  }
  if (!(area > 0)) throw std::invalid_argument("the rim of the region does not run around it on its left");
  const Vec2 centre = first / area;
  return {.area = area, .centre = origin + centre, .second_moment = polar - area * centre.squaredNorm()};
}

}  // namespace fsi::rigid
