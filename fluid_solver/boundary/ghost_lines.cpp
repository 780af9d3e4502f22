#include "fluid_solver/boundary/ghost_lines.hpp"

#include <algorithm>
#include <cmath>

namespace fsi::fluid {

namespace {

/// Of three numbers of one sign the one nearest to zero, else zero.
double nearest_to_zero(double a, double b, double c) {
  if (a > 0 && b > 0 && c > 0) return std::min({a, b, c});
  if (a < 0 && b < 0 && c < 0) return std::max({a, b, c});
  return 0;
}

bool positive(const StateVector& q) {
  return q[0] > 0 && q[3] > 0;
}

Vec2 rotated_inward(const Vec2& tangent, const Vec2& inward) {
  const Vec2 normal = Vec2(-tangent[1], tangent[0]).normalized();
  return normal.dot(inward) > 0 ? normal : Vec2(-normal);
}

/// Of an increment of the state away from q keeps the waves that leave through a side with outward normal n
/// and normal speed g_n.
StateVector leaving(const StateVector& q, const StateVector& increment, const Vec2& n, double g_n,
                    double gamma) {
  const Vec2 v(q[1], q[2]), dv(increment[1], increment[2]);
  const double a = std::sqrt(gamma * q[3] / q[0]), z = q[0] * a, u = n.dot(v) - g_n;
  const double du = n.dot(dv), dp = increment[3];
  const double plus = u + a > 0 ? 0.5 * (dp + z * du) : 0;
  const double minus = u - a > 0 ? 0.5 * (dp - z * du) : 0;
  const bool carried =
      u > 1e-10 * a;  // entropy and shear go with the gas; gas at rest, up to round-off, carries nothing
  const Vec2 shear = carried ? Vec2(dv - du * n) : Vec2::Zero();
  const double entropy = carried ? increment[0] - dp / (a * a) : 0;
  const Vec2 dv_left = shear + (plus - minus) / z * n;
  return {entropy + (plus + minus) / (a * a), dv_left[0], dv_left[1], plus + minus};
}

}  // namespace

BoundedState positive_or(const StateVector& q, const StateVector& fallback) {
  if (positive(q)) return {.q = q};
  return {.q = fallback, .bounded = true};
}

BoundedState extrapolated(const StateVector& q0, const StateVector& q1, const StateVector& q2, bool limited) {
  StateVector result;
  for (int c = 0; c < 4; ++c) {
    const double last = q0[c] - q1[c], before = q1[c] - q2[c];
    const double third_order = 2 * last - before;
    result[c] = q0[c] + (limited ? nearest_to_zero(third_order, 2 * last, 2 * before) : third_order);
  }
  return positive_or(result, q0);
}

Vec2 inward_normal(ConstFieldView x, const SidePoints& side, int k) {
  return rotated_inward(position(x, side, k + 1, 0) - position(x, side, k - 1, 0),
                        position(x, side, k, 1) - position(x, side, k, 0));
}

Vec2 straight_normal(ConstFieldView x, const SidePoints& side) {
  return rotated_inward(position(x, side, side.n() - 1, 0) - position(x, side, 0, 0),
                        position(x, side, 0, 1) - position(x, side, 0, 0));
}

std::uint64_t outflow_ghosts(FieldView q, ConstFieldView x, const SidePoints& side, std::span<const double> v,
                             const GasOptions& options) {
  std::uint64_t count = 0;
  const bool limited = options.limiter != Limiter::none;
  const auto n = static_cast<std::size_t>(side.n());
  for (int k = 0; k < side.n(); ++k) {
    if (!side.live(k)) continue;
    const Vec2 outward = -inward_normal(x, side, k);
    const auto point = static_cast<std::size_t>(k);
    const double g_n = outward.dot(Vec2(v[point], v[n + point]));
    bool bounded = false;
    for (int m = 1; m <= Layout::ghosts; ++m) {
      const StateVector q0 = load(q, side.at(k, 1 - m)), q1 = load(q, side.at(k, 2 - m)),
                        q2 = load(q, side.at(k, 3 - m));
      const BoundedState whole = extrapolated(q0, q1, q2, limited);
      const BoundedState value = positive_or(q0 + leaving(q0, whole.q - q0, outward, g_n, options.gamma), q0);
      bounded |= whole.bounded || value.bounded;
      store(q, side.at(k, -m), value.q);
    }
    count += bounded && side.counts(k);
  }
  return count;
}

std::uint64_t extrapolated_ghosts(FieldView q, const SidePoints& side, bool limited) {
  std::uint64_t count = 0;
  for (int k = 0; k < side.n(); ++k) {
    if (!side.live(k)) continue;
    bool bounded = false;
    for (int m = 1; m <= Layout::ghosts; ++m) {
      const BoundedState value = extrapolated(load(q, side.at(k, 1 - m)), load(q, side.at(k, 2 - m)),
                                              load(q, side.at(k, 3 - m)), limited);
      bounded |= value.bounded;
      store(q, side.at(k, -m), value.q);
    }
    count += bounded && side.counts(k);
  }
  return count;
}

void given_lines(FieldView q, ConstFieldView x, const SidePoints& side, const StateField& state, double t) {
  for (int m = 0; m <= Layout::ghosts; ++m) {
    for (int k = m == 0 ? 0 : -Layout::ghosts; k < side.n() + (m == 0 ? 0 : Layout::ghosts); ++k) {
      if (!side.live(k)) continue;
      const Vec2 place = position(x, side, k, -m);
      store(q, side.at(k, -m), to_vector(state(place[0], place[1], t)));
    }
  }
}

void symmetry_ghosts(FieldView q, ConstFieldView x, const SidePoints& side, int first, int last) {
  const Vec2 n = straight_normal(x, side);
  for (int m = 1; m <= Layout::ghosts; ++m) {
    for (int k = first; k < last; ++k) {
      if (side.elsewhere(k)) continue;
      StateVector value = load(q, side.at(k, m));
      value.segment<2>(1) -= 2 * n.dot(value.segment<2>(1)) * n;
      store(q, side.at(k, -m), value);
    }
  }
}

void periodic_ghosts(FieldView q, const SidePoints& side, int first, int last) {
  for (int m = 1; m <= Layout::ghosts; ++m) {
    for (int k = first; k < last; ++k) {
      if (!side.elsewhere(k)) store(q, side.at(k, -m), load(q, side.at(k, side.depth() - m)));
    }
  }
}

}  // namespace fsi::fluid
