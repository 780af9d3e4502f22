#include <algorithm>
#include <cmath>

#include "fluid_solver/boundary/ghost_lines.hpp"

namespace fsi::fluid {

namespace {

/// A vector per point of a wall, continued periodically on a closed one.
class WallVectors {
 public:
  WallVectors(std::span<const double> values, bool closed)
      : values_(values), n_(static_cast<int>(values.size() / 2)), closed_(closed) {}
  Vec2 operator()(int k) const {
    const int period = n_ - 1, point = !closed_ ? k : k < 0 ? k + period : k >= n_ ? k - period : k;
    return {values_[static_cast<std::size_t>(point)], values_[static_cast<std::size_t>(n_ + point)]};
  }

 private:
  std::span<const double> values_;
  int n_;
  bool closed_;
};

/// Change of pressure per line into the grid, on the wall at point k.
double pressure_slope(ConstFieldView q, ConstFieldView x, const SidePoints& side, const Wall& wall, int k) {
  const auto [i, j] = side.at(k, 0);
  const WallVectors velocity(wall.v, wall.closed);
  const Vec2 n = WallVectors(wall.n, wall.closed)(k), g_tt = WallVectors(wall.a, wall.closed)(k);
  const Vec2 across = 0.5 * (position(x, side, k, 1) - position(x, side, k, -1));
  if ((k == 0 && wall.held_first) || (k == side.n() - 1 && wall.held_last))
    return -q(0, i, j) * across.dot(g_tt);
  const Vec2 before = position(x, side, k - 1, 0), here = position(x, side, k, 0),
             after = position(x, side, k + 1, 0);
  const Vec2 g_r = 0.5 * (after - before), g_rr = after - 2 * here + before;
  const Vec2 g_tr = along_side(velocity, k, side.n(), !wall.closed, !wall.closed);
  const double s_dot = (Vec2(q(1, i, j), q(2, i, j)) - velocity(k)).dot(g_r) / g_r.squaredNorm();
  const double p_n = -q(0, i, j) * n.dot(g_tt + 2 * s_dot * g_tr + s_dot * s_dot * g_rr);

  const auto pressure = [&](int l) {
    const int period = side.n() - 1, point = !wall.closed ? l
                                             : l < 0      ? l + period
                                             : l > period ? l - period
                                                          : l;
    const auto at = side.at(point, 0);
    return q(3, at.i, at.j);
  };
  const double p_r = along_side(pressure, k, side.n(), !wall.closed && !wall.mirrored_first,
                                !wall.closed && !wall.mirrored_last);
  return p_n * across.dot(n) + p_r * across.dot(g_r) / g_r.squaredNorm();
}

/// How much of `change`, by which the extrapolated density behind a wall differs from that of its mirror image, is left: all up to
/// half of the density, then less and less, and not at all where it would be all of it. There a shock stands between the wall and the
/// first line, which is its own mirror image, and the ghosts of smooth gas do not fit:
///
///     denser at the wall,     a shock that leaves it. The reflected velocity would give the wall's dense gas a slope, at its face
///     its pressure higher     half the speed of the gas before the shock: it would push the shock back, and where gas
///                             can leave along the wall the shock would stay for ever. The wall's own state has no slope
///     thinner at the wall     a shock that meets it. Ghosts with the density at the wall and the speed before the
///                             shock would push the wall's gas away as fast as it comes. The mirror's density does not
double part_of_change(double change, double inside) {
  return std::clamp(2 * (1 - std::fabs(change) / inside), 0.0, 1.0);
}

/// The same of the pressure, where only a rise makes a shock.
double part_of_rise(double rise, double inside) {
  return rise > 0 ? part_of_change(rise, inside) : 1;
}

}  // namespace

std::uint64_t wall_ghosts(FieldView q, ConstFieldView x, const SidePoints& side, const Wall& wall,
                          bool limited) {
  const WallVectors normals(wall.n, wall.closed);
  std::uint64_t count = 0;
  for (int k = 0; k < side.n(); ++k) {
    if (!side.live(k)) continue;
    const Vec2 n = normals(k);
    const double slope = pressure_slope(q, x, side, wall, k);
    const double v_n = n.dot(Vec2(load(q, side.at(k, 0)).segment<2>(1)));
    bool bounded = false;
    for (int m = 1; m <= Layout::ghosts; ++m) {
      const StateVector inside = load(q, side.at(k, m));
      const BoundedState beyond = extrapolated(load(q, side.at(k, 1 - m)), load(q, side.at(k, 2 - m)),
                                               load(q, side.at(k, 3 - m)), limited);
      StateVector ghost = beyond.q;
      const double change = 2 * m * slope, largest = limited ? 0.5 * inside[3] : (1 - 1e-3) * inside[3];
      ghost[3] = inside[3] - std::clamp(change, -largest, largest);
      bounded |= beyond.bounded || std::fabs(change) > largest;
      if (limited) {  // odd reflection: the wall stays where it is when a shock meets it
        Vec2 v = ghost.segment<2>(1);
        v += (2 * v_n - n.dot(Vec2(inside.segment<2>(1))) - n.dot(v)) * n;
        ghost.segment<2>(1) = v;
        const double change_of_density = ghost[0] - inside[0],
                     part = part_of_change(change_of_density, inside[0]);
        ghost[0] = inside[0] + part * change_of_density;
        if (change_of_density > 0) {
          const StateVector at_wall = load(q, side.at(k, 0));
          const double smooth = std::max(part, part_of_rise(at_wall[3] - inside[3], inside[3]));
          ghost += (1 - smooth) * (at_wall - ghost);
        }
        bounded |= part < 1;
      }
      store(q, side.at(k, -m), ghost);
    }
    count += bounded && side.counts(k);
  }
  return count;
}

}  // namespace fsi::fluid
