#include "fluid_solver/boundary/boundary_conditions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "common/core/failure.hpp"
#include "fluid_solver/boundary/far_field.hpp"
#include "fluid_solver/boundary/ghost_lines.hpp"

namespace fsi::fluid {

namespace {

template <class Kind>
bool is(const Boundary& boundary) {
  return std::holds_alternative<Kind>(boundary);
}

bool is_mirror(const Boundary& boundary) {
  return is<Symmetry>(boundary) || is<Periodic>(boundary);
}

class BoundaryConditions {
 public:
  BoundaryConditions(Component& component, const BoundaryTask& task)
      : component_(component),
        task_(task),
        q_(component.state()),
        x_(component.grid().x()),
        layout_(q_.layout) {}

  void set_points() {
    each<Interface>([this](const SidePoints& side) { set_interface(side); });
    each<SlipWall>([this](const SidePoints& side) { set_slip_wall(side); });
    each<Symmetry>([this](const SidePoints& side) { set_symmetry(side); });
    each<Inflow>([this](const SidePoints& side) { set_inflow(side); });
    each<FarField>([this](const SidePoints& side) { set_far_field(side); });
    each<Dirichlet>([this](const SidePoints& side) { set_dirichlet(side); });
    each<Periodic>([this](const SidePoints& side) { set_periodic(side); });
  }

  void set_ghosts() {
    mirror(0);
    for (const Side side : all_sides) ghosts(points_of(side));
    for (const Side side : {Side::left, Side::right}) {
      for (const Side other : {Side::bottom, Side::top}) corner(side, other);
    }
    each<Dirichlet>([this](const SidePoints& side) { set_dirichlet(side); });
    mirror(Layout::ghosts);
  }

  /// Ghosts of the mirror sides, `reach` points beyond the ends of each side.
  void mirror(int reach) {
    each<Symmetry>([&](const SidePoints& side) { symmetry(side, reach); });
    each<Periodic>([&](const SidePoints& side) { periodic_ghosts(q_, side, -reach, side.n() + reach); });
  }

 private:
  Component& component_;
  const BoundaryTask& task_;
  FieldView q_;
  ConstFieldView x_;
  Layout layout_;

  SidePoints points_of(Side side) const { return {layout_, side, component_.live(side), &component_.rows()}; }
  bool limited() const { return task_.options.limiter != Limiter::none; }

  const Forcing* forcing() const { return component_.forcing(); }
  StateVector exact(const Vec2& place) const {
    return to_vector(forcing()->exact()(place[0], place[1], task_.t));
  }

  /// Mirror images, of the difference to the exact solution where there is one.
  void symmetry(const SidePoints& side, int reach) const {
    if (forcing() == nullptr) return symmetry_ghosts(q_, x_, side, -reach, side.n() + reach);
    const Vec2 n = straight_normal(x_, side);
    for (int m = 1; m <= Layout::ghosts; ++m) {
      for (int k = -reach; k < side.n() + reach; ++k) {
        if (side.elsewhere(k)) continue;
        StateVector difference = load(q_, side.at(k, m)) - exact(position(x_, side, k, m));
        difference.segment<2>(1) -= 2 * n.dot(difference.segment<2>(1)) * n;
        store(q_, side.at(k, -m), exact(position(x_, side, k, -m)) + difference);
      }
    }
  }

  /// Velocity of the gas on a wall: that of the wall, or the exact one.
  Vec2 wall_velocity(const WallMotion& wall, const SidePoints& side, int k) const {
    if (forcing() != nullptr) return exact(position(x_, side, k, 0)).segment<2>(1);
    const auto n = wall.velocity.size() / 2, point = static_cast<std::size_t>(k);
    return {wall.velocity[point], wall.velocity[n + point]};
  }

  template <class Kind, class Action>
  void each(const Action& action) const {
    for (const Side side : all_sides) {
      if (is<Kind>(component_.boundary(side))) action(points_of(side));
    }
  }

  const InterfaceValues& values_of(Side side) const {
    const auto found = std::ranges::find(task_.interfaces, side, &InterfaceValues::side);
    if (found == task_.interfaces.end()) {
      throw std::logic_error(fmt::format("no interface values for side \"{}\"", name_of(side)));
    }
    return *found;
  }

  Wall wall_of(const SidePoints& side) const {
    const auto [first, last] = side.neighbours();
    Wall wall;
    if (is<Interface>(component_.boundary(side.side()))) {
      const InterfaceValues& values = values_of(side.side());
      wall = {.n = values.n, .v = values.v, .a = values.a};
    } else {
      const WallMotion& motion = component_.wall(side.side());
      wall = {.n = motion.normal, .v = motion.velocity, .a = motion.acceleration};
    }
    wall.closed = is<Periodic>(component_.boundary(first));
    wall.mirrored_first = is_mirror(component_.boundary(first));
    wall.mirrored_last = is_mirror(component_.boundary(last));
    return wall;
  }

  /// All ranks look at all points, so that all of them find the same one.
  void check_interface(const SidePoints& side, const InterfaceValues& values) const {
    for (std::size_t k = 0; k < static_cast<std::size_t>(side.n()); ++k) {
      const auto at = side.at(static_cast<int>(k), 0);
      const double p_I = task_.options.p_e - values.w_n[k];
      if (!(p_I > 0 && std::isfinite(p_I) && std::isfinite(values.v_n[k]))) {
        throw NumbersBroke(
            fmt::format(
                "p^I = {:.3g}, v_n^I = {:.3g}{}", p_I, values.v_n[k],
                task_.options.wave_curve ? "" : "; write interface.riemann: exact, for jumps of this size"),
            {.t = task_.t,
             .grid = component_.grid().name(),
             .point = {at.i, at.j},
             .position = {x_(0, at.i, at.j), x_(1, at.i, at.j)}});
      }
    }
  }

  /// n.v := v_n^I, p := p_e - w_n^I, and the density that goes with the change of pressure.
  void set_interface(const SidePoints& side) {
    const InterfaceValues& values = values_of(side.side());
    const auto n = static_cast<std::size_t>(side.n());
    check_interface(side, values);
    for (std::size_t k = 0; k < n; ++k) {
      const auto at = side.at(static_cast<int>(k), 0);
      if (side.elsewhere(static_cast<int>(k))) continue;
      const Vec2 normal(values.n[k], values.n[n + k]);
      const double p_I = task_.options.p_e - values.w_n[k];
      StateVector state = load(q_, at);
      const Vec2 v = state.segment<2>(1);
      state.segment<2>(1) = v + (values.v_n[k] - normal.dot(v)) * normal;
      state[0] *= density_ratio(p_I / state[3]);
      state[3] = p_I;
      store(q_, at, state);
    }
  }

  /// Of the gas through the wave that changes its pressure so many times: behind a shock by Rankine and
  /// Hugoniot, else at constant entropy.
  double density_ratio(double pressure_ratio) const {
    const double gamma = task_.options.gamma, k = (gamma - 1) / (gamma + 1);
    if (pressure_ratio > 1 && task_.options.wave_curve)
      return (pressure_ratio + k) / (k * pressure_ratio + 1);
    return std::pow(pressure_ratio, 1 / gamma);
  }

  /// n.v := that of the wall; pressure and density follow along
  /// the simple wave that makes this change of velocity.
  void set_slip_wall(const SidePoints& side) {
    const WallMotion& wall = component_.wall(side.side());
    const auto n = static_cast<std::size_t>(side.n());
    const double gamma = task_.options.gamma;
    for (std::size_t k = 0; k < n; ++k) {
      if (!side.live(static_cast<int>(k))) continue;
      const auto at = side.at(static_cast<int>(k), 0);
      const Vec2 normal(wall.normal[k], wall.normal[n + k]);
      StateVector state = load(q_, at);
      const double change =
          normal.dot(wall_velocity(wall, side, static_cast<int>(k)) - Vec2(state.segment<2>(1)));
      const double a = std::sqrt(gamma * state[3] / state[0]);
      const double a_ratio = std::max(1 + 0.5 * (gamma - 1) * change / a, 0.1);
      state.segment<2>(1) += change * normal;
      state[0] *= std::pow(a_ratio, 2 / (gamma - 1));
      state[3] *= std::pow(a_ratio, 2 * gamma / (gamma - 1));
      if (forcing() != nullptr) bring_in(state, side, wall, static_cast<int>(k));
      store(q_, at, state);
    }
  }

  /// Gas with a chosen solution may come in through a wall, and brings entropy and shear with it: three waves
  /// come in there, and a condition for one of them leaves the others to extrapolation, from which errors at
  /// corners grow.
  void bring_in(StateVector& state, const SidePoints& side, const WallMotion& wall, int k) const {
    const auto n = wall.velocity.size() / 2, point = static_cast<std::size_t>(k);
    const StateVector chosen = exact(position(x_, side, k, 0));
    const Vec2 normal(wall.normal[point], wall.normal[n + point]),
        own(wall.velocity[point], wall.velocity[n + point]);
    if (normal.dot(Vec2(chosen.segment<2>(1)) - own) <= 0) return;
    state[0] = chosen[0] * std::pow(state[3] / chosen[3], 1 / task_.options.gamma);
    state.segment<2>(1) = chosen.segment<2>(1);
  }

  void set_symmetry(const SidePoints& side) {
    const Vec2 normal = straight_normal(x_, side);
    for (int k = 0; k < side.n(); ++k) {
      if (side.elsewhere(k)) continue;
      StateVector state = load(q_, side.at(k, 0));
      double v_n = normal.dot(Vec2(state.segment<2>(1)));
      if (forcing() != nullptr) v_n -= normal.dot(Vec2(exact(position(x_, side, k, 0)).segment<2>(1)));
      state.segment<2>(1) -= v_n * normal;
      store(q_, side.at(k, 0), state);
    }
  }

  void set_inflow(const SidePoints& side) {
    const StateField& given = std::get<Inflow>(component_.boundary(side.side())).state;
    for (int k = 0; k < side.n(); ++k) {
      if (!side.live(k)) continue;
      const Vec2 place = position(x_, side, k, 0);
      store(q_, side.at(k, 0), to_vector(given(place[0], place[1], task_.t)));
    }
  }

  void set_far_field(const SidePoints& side) {
    const StateField& given = std::get<FarField>(component_.boundary(side.side())).state;
    const std::vector<double>& velocity = component_.wall(side.side()).velocity;
    const auto n = static_cast<std::size_t>(side.n());
    for (std::size_t k = 0; k < n; ++k) {
      const int point = static_cast<int>(k);
      if (!side.live(point)) continue;
      const Vec2 place = position(x_, side, point, 0), outward = -inward_normal(x_, side, point);
      const StateVector beyond = to_vector(given(place[0], place[1], task_.t));
      const OpenSide open{.n = outward,
                          .speed = outward.dot(Vec2(velocity[k], velocity[n + k])),
                          .gamma = task_.options.gamma};
      store(q_, side.at(point, 0), between(load(q_, side.at(point, 0)), beyond, open));
    }
  }

  void set_dirichlet(const SidePoints& side) {
    given_lines(q_, x_, side, std::get<Dirichlet>(component_.boundary(side.side())).state, task_.t);
  }

  /// The last point is the first of the next period.
  void set_periodic(const SidePoints& side) {
    if (!at_upper_end(side.side())) return;
    for (int k = 0; k < side.n(); ++k) {
      if (!side.elsewhere(k)) store(q_, side.at(k, 0), load(q_, side.at(k, side.depth())));
    }
  }

  void ghosts(const SidePoints& side) {
    const Boundary& boundary = component_.boundary(side.side());
    // Gas with a chosen solution may cross a wall: the momentum equation on it does not hold.
    const bool is_wall = is<Interface>(boundary) || is<SlipWall>(boundary), crossed = forcing() != nullptr;
    if (is_wall && !crossed) wall_ghosts(q_, x_, side, wall_of(side), limited());
    const bool given = is<Inflow>(boundary) || is<FarField>(boundary);
    if (given || (is_wall && crossed)) extrapolated_ghosts(q_, side, limited());
    if (is<Outflow>(boundary))
      outflow_ghosts(q_, x_, side, component_.wall(side.side()).velocity, task_.options);
  }

  /// Where two sides meet that are no mirrors: q(-a, -b) = q(-a, 0) + q(0, -b) - q(0, 0).
  void corner(Side side, Side other) {
    for (const Side one : {side, other}) {
      if (is_mirror(component_.boundary(one)) || is<Idle>(component_.boundary(one))) return;
    }
    const int i0 = at_upper_end(side) ? layout_.n1 - 1 : 0, j0 = at_upper_end(other) ? layout_.n2 - 1 : 0;
    const int out1 = at_upper_end(side) ? 1 : -1, out2 = at_upper_end(other) ? 1 : -1;
    const StateVector q0 = load(q_, {i0, j0});
    for (int a = 1; a <= Layout::ghosts; ++a) {
      for (int b = 1; b <= Layout::ghosts; ++b) {
        const int i = i0 + a * out1, j = j0 + b * out2;
        const StateVector value = load(q_, {i, j0}) + load(q_, {i0, j}) - q0;
        store(q_, {i, j}, value[0] > 0 && value[3] > 0 ? value : q0);
      }
    }
  }
};

}  // namespace

void set_boundary_points(Component& component, const BoundaryTask& task) {
  BoundaryConditions(component, task).set_points();
}

void set_ghosts(Component& component, const BoundaryTask& task) {
  BoundaryConditions(component, task).set_ghosts();
}

void close_periods(Component& component) {
  const FieldView q = component.state();
  if (!std::holds_alternative<Periodic>(component.boundary(Side::top))) return;
  if (!component.rows().has(q.layout.n2 - 1)) return;
  const SidePoints top(q.layout, Side::top);
  for (int k = 0; k < top.n(); ++k) store(q, top.at(k, 0), load(q, top.at(k, top.depth())));
}

void mirror_ghosts(Component& component, double t) {
  const GasOptions options;
  const BoundaryTask task{.t = t, .options = options, .interfaces = {}};
  BoundaryConditions(component, task).mirror(Layout::ghosts);
}

}  // namespace fsi::fluid
