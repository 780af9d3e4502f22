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

/// The same of gas inside, lines 1 to 3: nobody knows how the wall begins to move, and the pressure on it may be new.
double initial_slope(ConstFieldView q, const SidePoints& side, int k, bool limited) {
  const auto p = [&](int line) { return load(q, side.at(k, line))[3]; };
  const double first = p(2) - p(1), second = p(3) - p(2), at_wall = 2.5 * first - 1.5 * second;
  if (!limited) return at_wall;
  if (first * second <= 0) return 0;
  return first > 0 ? std::clamp(at_wall, 0.0, 2 * first) : std::clamp(at_wall, 2 * first, 0.0);
}

/// 0 up to `low`, 1 from `high` on.
double ramp(double value, double low, double high) {
  return std::clamp((value - low) / (high - low), 0.0, 1.0);
}

/// What the gas beside a point of a wall is told by the wall and the next two lines of the grid.
struct WallGas {
  StateVector at_wall, first, second;
  Vec2 n;        ///< unit normal into the gas
  double slope;  ///< change of pressure per line, by the momentum equation on the wall
  double gamma;

  /// 1 where a shock leaves: the ghosts of smooth gas do not fit there, extrapolation makes dense gas behind the wall,
  /// and only what the scheme makes of the image gets the entropy of the shock. In smooth gas what the pressure has
  /// beyond its slope falls with h^2.
  double shock() const {
    constexpr double smooth = 0.05, sharp = 0.15;  // of the pressure
    return ramp(std::max(rise(first, 1), rise(second, 2)), smooth, sharp);
  }

  /// 1 where the gas runs against the wall faster than it does behind any shock that the wall reflects: none has left
  /// yet, and where gas can leave along the wall it may stay for ever. With the image's state the wall's dense gas has a
  /// slope of the normal velocity, at its face half the speed of the gas before the shock, which pushes the shock back.
  /// The wall's own state has no slope.
  double stream() const {
    constexpr double behind_shocks = 1.5, before_shocks = 2;  // Mach numbers
    const double a = std::sqrt(gamma * first[3] / first[0]);
    return ramp(n.dot(Vec2(at_wall.segment<2>(1) - first.segment<2>(1))) / a, behind_shocks, before_shocks);
  }

 private:
  /// Of the pressure at the wall above that of smooth gas, over the pressure inside.
  double rise(const StateVector& inside, int line) const {
    return (at_wall[3] - (inside[3] - line * slope)) / std::min(inside[3], at_wall[3]);
  }
};

/// Of gas inside, with its normal velocity reflected about that of the wall.
Vec2 reflected(const WallGas& gas, const StateVector& inside) {
  const Vec2 v = inside.segment<2>(1);
  return v + 2 * gas.n.dot(Vec2(gas.at_wall.segment<2>(1)) - v) * gas.n;
}

/// How much of `change`, by which the extrapolated density behind a wall differs from that of its image, is left: all up
/// to half of the density, then less and less, and not at all where it would be all of it. There a shock meets the wall:
/// ghosts with the density at the wall and the speed before the shock would push the wall's gas away as fast as it comes.
double part_of_change(double change, double inside) {
  return 1 - ramp(std::fabs(change) / inside, 0.5, 1);
}

/// Line -m behind the wall, from line m inside and from what smooth gas would have there. The pressure of both is that
/// of the image and of the wall's slope.
StateVector behind_wall(const WallGas& gas, const StateVector& inside, const StateVector& smooth) {
  StateVector ghost = smooth, image = inside;
  image.segment<2>(1) = reflected(gas, inside);
  image[3] = smooth[3];
  // odd reflection here, too: the wall stays where it is when a shock meets it
  ghost.segment<2>(1) += gas.n.dot(Vec2((image - smooth).segment<2>(1))) * gas.n;
  ghost[0] = inside[0] + part_of_change(smooth[0] - inside[0], inside[0]) * (smooth[0] - inside[0]);
  ghost += gas.shock() * (image - ghost);
  return ghost + gas.shock() * gas.stream() * (gas.at_wall - ghost);
}

}  // namespace

std::uint64_t wall_ghosts(FieldView q, ConstFieldView x, const SidePoints& side, const Wall& wall,
                          const GasOptions& options) {
  const bool limited = options.limiter != Limiter::none;
  const double share = limited ? 0.5 : 1 - 1e-3;  // of the pressure inside, that its change may have
  const WallVectors normals(wall.n, wall.closed);
  std::uint64_t count = 0;
  for (int k = 0; k < side.n(); ++k) {
    if (!side.live(k)) continue;
    const WallGas gas{
        .at_wall = load(q, side.at(k, 0)),
        .first = load(q, side.at(k, 1)),
        .second = load(q, side.at(k, 2)),
        .n = normals(k),
        .slope = wall.a.empty() ? initial_slope(q, side, k, limited) : pressure_slope(q, x, side, wall, k),
        .gamma = options.gamma};
    bool bounded = false;
    for (int m = 1; m <= Layout::ghosts; ++m) {
      const StateVector inside = load(q, side.at(k, m));
      const BoundedState beyond = extrapolated(load(q, side.at(k, 1 - m)), load(q, side.at(k, 2 - m)),
                                               load(q, side.at(k, 3 - m)), limited);
      StateVector ghost = beyond.q;
      const double change = 2 * m * gas.slope, largest = share * inside[3];
      ghost[3] = inside[3] - std::clamp(change, -largest, largest);
      bounded |= beyond.bounded || std::fabs(change) > largest;
      if (limited) {
        bounded |= part_of_change(ghost[0] - inside[0], inside[0]) < 1;
        ghost = behind_wall(gas, inside, ghost);
      }
      store(q, side.at(k, -m), ghost);
    }
    count += bounded && side.counts(k);
  }
  return count;
}

}  // namespace fsi::fluid
