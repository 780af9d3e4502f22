#include "fluid_solver/forcing.hpp"

namespace fsi::fluid {

namespace {

/// Step of the central differences, part of the scales: small against all that varies, so that their error, of
/// second order in it, and that of rounding lie far below those of any grid.
constexpr double part_of_scale = 1e-6;

template <class Action>
void each_point(const Layout& layout, const RankRows& rows, const Action& action) {
  constexpr int g = Layout::ghosts;
  for (int j = -g; j < layout.n2 + g; ++j) {
    if (!rows.has(j)) continue;
    for (int i = -g; i < layout.n1 + g; ++i) action(SidePoints::Index{i, j});
  }
}

/// Flux along direction c. paper eq. (1)
StateVector flux(const State& s, int c, double gamma) {
  const StateVector U = conserved(to_vector(s), gamma);
  const double v = c == 0 ? s.v1 : s.v2;
  StateVector f = v * U;
  f[1 + c] += s.p;
  f[3] += s.p * v;
  return f;
}

}  // namespace

StateVector Forcing::source(double x, double y, double t) const {
  const double d = part_of_scale * scales_.length, dt = part_of_scale * scales_.time;
  const StateVector in_t =
      conserved(to_vector(exact_(x, y, t + dt)), gamma_) - conserved(to_vector(exact_(x, y, t - dt)), gamma_);
  const StateVector in_x = flux(exact_(x + d, y, t), 0, gamma_) - flux(exact_(x - d, y, t), 0, gamma_);
  const StateVector in_y = flux(exact_(x, y + d, t), 1, gamma_) - flux(exact_(x, y - d, t), 1, gamma_);
  return in_t / (2 * dt) + (in_x + in_y) / (2 * d);
}

void Forcing::evaluate(ConstFieldView x, double t, FieldView source_field, const RankRows& rows) const {
  each_point(x.layout, rows, [&](SidePoints::Index at) {
    store(source_field, at, source(x(0, at.i, at.j), x(1, at.i, at.j), t));
  });
}

void Forcing::add(ConstFieldView source_field, double weight, FieldView q, const RankRows& rows) const {
  each_point(q.layout, rows, [&](SidePoints::Index at) {
    const StateVector U = conserved(load(q, at), gamma_) + weight * load(source_field, at);
    store(q, at, primitive(U, gamma_));
  });
}

}  // namespace fsi::fluid
