#include "fluid_solver/boundary/boundary_conditions.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

#include "fluid_solver/boundary/every_boundary.hpp"
#include "fluid_solver/boundary/gas_side.hpp"

namespace fsi::fluid {

namespace {

class BoundaryConditions {
 public:
  BoundaryConditions(Component& component, const BoundaryTask& task)
      : component_(component),
        task_(task),
        q_(component.state()),
        x_(component.grid().x()),
        layout_(q_.layout) {
    std::ranges::copy(all_sides, by_precedence_.begin());
    std::ranges::stable_sort(by_precedence_, {},
                             [&](Side side) { return component_.facts(side).precedence; });
  }

  void set_points() {
    std::array<StateVector, 4> predicted;
    each_corner_of_equals([&](const Corner& corner) { predicted[corner.index] = load(q_, corner.at); });
    for (const Side side : by_precedence_) {
      visit(side, [](const auto& kind, const GasSide& at) {
        if constexpr (requires { kind.set_points(at); }) {
          kind.set_points(at);
        } else if constexpr (requires { kind.set_point(at, 0); }) {
          for (int k = 0; k < at.points.n(); ++k) {
            if (at.points.live(k)) kind.set_point(at, k);
          }
        }
      });
    }
    each_corner_of_equals(
        [&](const Corner& corner) { let_neither_go_first(corner, predicted[corner.index]); });
  }

  void set_ghosts() {
    mirror(0);
    for (const Side side : all_sides) {
      visit(side, [](const auto& kind, const GasSide& at) {
        if constexpr (requires { kind.set_ghosts(at); }) kind.set_ghosts(at);
      });
    }
    for (const Side side : {Side::left, Side::right}) {
      for (const Side other : {Side::bottom, Side::top}) corner(side, other);
    }
    for (const Side side : all_sides) {
      visit(side, [](const auto& kind, const GasSide& at) {
        if constexpr (requires { kind.set_after_corners(at); }) kind.set_after_corners(at);
      });
    }
    mirror(Layout::ghosts);
  }

  /// How often a bound acted, at the points of the sides.
  std::uint64_t bounded() const { return bounded_; }

  /// Ghosts of the mirror sides, `reach` points beyond the ends of each side.
  void mirror(int reach) {
    for (const Side side : by_precedence_) {
      visit(side, [reach](const auto& kind, const GasSide& at) {
        if constexpr (requires { kind.mirror(at, reach); }) kind.mirror(at, reach);
      });
    }
  }

 private:
  Component& component_;
  const BoundaryTask& task_;
  FieldView q_;
  ConstFieldView x_;
  Layout layout_;
  std::array<Side, 4> by_precedence_{};
  std::uint64_t bounded_ = 0;

  template <class Action>
  void visit(Side side, const Action& action) {
    const GasSide at = seen(side);
    std::visit([&](const auto& kind) { action(kind, at); }, component_.boundary(side));
  }

  /// Where side `across`, left or right, with its point k meets `beside`, bottom or top, with its point l.
  struct Corner {
    std::size_t index;
    Side across, beside;
    int k, l;
    SidePoints::Index at;
  };

  /// Corners of two sides that set their points one by one and neither of which takes precedence.
  template <class Action>
  void each_corner_of_equals(const Action& action) {
    std::size_t index = 0;
    for (const Side across : {Side::left, Side::right}) {
      for (const Side beside : {Side::bottom, Side::top}) {
        const int i = at_upper_end(across) ? layout_.n1 - 1 : 0,
                  j = at_upper_end(beside) ? layout_.n2 - 1 : 0;
        const Corner corner{
            .index = index++, .across = across, .beside = beside, .k = j, .l = i, .at = {i, j}};
        if (component_.facts(across).precedence != component_.facts(beside).precedence) continue;
        if (sets_point(across, corner.k) && sets_point(beside, corner.l)) action(corner);
      }
    }
  }
  bool sets_point(Side side, int k) {
    bool does = false;
    visit(side, [&](const auto& kind, const GasSide& at) {
      if constexpr (requires { kind.set_point(at, k); }) does = at.points.live(k);
    });
    return does;
  }
  void set_point(Side side, int k) {
    visit(side, [k](const auto& kind, const GasSide& at) {
      if constexpr (requires { kind.set_point(at, k); }) kind.set_point(at, k);
    });
  }
  /// The point has what `beside` made of what `across` did, and gets the mean of it and the other order.
  void let_neither_go_first(const Corner& corner, const StateVector& predicted) {
    const StateVector one_order = load(q_, corner.at);
    const std::uint64_t counted = bounded_;
    store(q_, corner.at, predicted);
    set_point(corner.beside, corner.l);
    set_point(corner.across, corner.k);
    store(q_, corner.at, 0.5 * (one_order + load(q_, corner.at)));
    bounded_ = counted;
  }

  bool is_mirror(Side side) const { return component_.facts(side).beyond != Beyond::other; }

  const InterfaceValues* projected(Side side) const {
    const auto found = std::ranges::find(task_.interfaces, side, &InterfaceValues::side);
    return found == task_.interfaces.end() ? nullptr : &*found;
  }

  /// Whether of two sides one is an interface and the other one a wall.
  bool is_foot(Side one, Side other) const {
    const GasBoundaryFacts &a = component_.facts(one), &b = component_.facts(other);
    return (a.is_wall && b.meets_solid) || (a.meets_solid && b.is_wall);
  }

  /// Of an interface along `one`, its normal where it meets `other`.
  std::optional<Vec2> normal_at_end(Side one, Side other) const {
    const InterfaceValues* values = projected(one);
    if (values == nullptr) return std::nullopt;
    const std::size_t n = values->n.size() / 2, k = at_upper_end(other) ? n - 1 : 0;
    return Vec2(values->n[k], values->n[n + k]);
  }

  GasSide seen(Side side) {
    const SidePoints points(layout_, side, component_.live(side), component_.rows(), component_.valid());
    const auto [first, last] = points.neighbours();
    return {.q = q_,
            .x = x_,
            .points = points,
            .t = task_.t,
            .options = task_.options,
            .motion = component_.wall(side),
            .forcing = component_.forcing(),
            .projected = projected(side),
            .closed = component_.facts(first).beyond == Beyond::period,
            .mirrored_first = is_mirror(first),
            .mirrored_last = is_mirror(last),
            .held = {is_foot(first, side), is_foot(last, side)},
            .crossing = {normal_at_end(first, side), normal_at_end(last, side)},
            .grid = component_.grid().name(),
            .bounded = bounded_};
  }

  /// Where two sides meet that are no mirrors: q(-a, -b) = q(-a, 0) + q(0, -b) - q(0, 0).
  void corner(Side side, Side other) {
    for (const Side one : {side, other}) {
      if (is_mirror(one) || std::holds_alternative<Idle>(component_.boundary(one))) return;
    }
    const int i0 = at_upper_end(side) ? layout_.n1 - 1 : 0, j0 = at_upper_end(other) ? layout_.n2 - 1 : 0;
    const int out1 = at_upper_end(side) ? 1 : -1, out2 = at_upper_end(other) ? 1 : -1;
    const StateVector q0 = load(q_, {i0, j0});
    bool bounded = false;
    for (int a = 1; a <= Layout::ghosts; ++a) {
      for (int b = 1; b <= Layout::ghosts; ++b) {
        const int i = i0 + a * out1, j = j0 + b * out2;
        const StateVector value = load(q_, {i, j0}) + load(q_, {i0, j}) - q0;
        const BoundedState ghost = positive_or(value, q0);
        bounded |= ghost.bounded;
        store(q_, {i, j}, ghost.q);
      }
    }
    bounded_ += bounded && seen(side).points.counts(j0);
  }
};

}  // namespace

void set_boundary_points(Component& component, const BoundaryTask& task) {
  BoundaryConditions conditions(component, task);
  conditions.set_points();
  component.count_bounded_side_points(conditions.bounded());
}

void set_ghosts(Component& component, const BoundaryTask& task) {
  BoundaryConditions conditions(component, task);
  conditions.set_ghosts();
  component.count_bounded_side_points(conditions.bounded());
}

void close_periods(Component& component) {
  const FieldView q = component.state();
  if (component.facts(Side::top).beyond != Beyond::period) return;
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
