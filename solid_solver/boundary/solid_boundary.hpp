#pragma once
/// Boundary conditions and ghost points of one component grid, in the order that is known to be stable.
///
///     sides/        where the points are, what holds there, what is known of them     no law
///     conditions/   motion, traction and ghost points that are given or continue      no law
///     matching/     characteristics, and ghost points by which P(F) bears the load    with the law

#include <span>
#include <utility>
#include <vector>

#include "common/core/archive.hpp"
#include "common/ranks/rows/rank_rows.hpp"
#include "solid_solver/boundary/conditions/ghost_frame.hpp"
#include "solid_solver/boundary/conditions/given_motion.hpp"
#include "solid_solver/boundary/conditions/loaded_dissipation.hpp"
#include "solid_solver/boundary/conditions/tractions.hpp"
#include "solid_solver/boundary/interface.hpp"
#include "solid_solver/boundary/matching/characteristics.hpp"
#include "solid_solver/boundary/matching/matched_ghosts.hpp"
#include "solid_solver/kernels/sweep/dissipation.hpp"

namespace fsi::solid {

template <Law L>
class SolidBoundary {
 public:
  /// @param time_scale a time over which given tractions hardly change, for their time derivative
  /// @throws UserMistake when periodic sides do not come in pairs
  SolidBoundary(BoundaryGrid grid, const L& law, double rho, Boundaries boundaries, Limiter limiter,
                double time_scale)
      : sides_(std::move(grid), std::move(boundaries), limiter),
        chosen_(sides_.grid().x, time_scale),
        memory_(sides_),
        rows_(sides_),
        law_(law),
        rho_(rho),
        time_scale_(time_scale) {}

  /// Where the sides are, and what holds there.
  const Sides& sides() const { return sides_; }

  /// Sets the boundary points and both ghost lines of q at time t, in this order:
  ///  1. motion that is given (interface: v := v + (v_n - n.v) n; displacement, slip, symmetry, exact);
  ///  2. u on the first ghost line;
  ///  3. tractions that are given, paper eq. (42), and corners where the stress follows from them;
  ///  4. v and P on the first ghost line;
  ///  5. traction sides: ghost u from paper eq. (43), ghost v from its time derivative, tangential stress
  ///  from P(F);
  ///  6. P again on the first ghost line, then the second one and the corners of the ghost frame.
  /// Only discretised points are set, and ghost points beside valid ones.
  /// @throws Diverged where no displacement fits the traction
  void apply(FieldView q, double t, std::span<const InterfaceValues> projected);
  /// Ghost points beside interpolated points, by extrapolation, reflection or repetition.
  void refresh_ghosts(FieldView q, double t) const { frame().refresh(q, t); }

  /// How often a point kept its prediction, since waves that could leave through the side are none there.
  double waveless() const { return waveless_; }
  void set_waveless(double waveless) { waveless_ = waveless; }

  /// Tractions and their rates, what motion that is given changed, and that count.
  void archive(Archive& archive) {
    memory_.archive(archive);
    archive.number("waveless", waveless_);
  }
  /// From now on conditions are set in these rows only, and numbers that break elsewhere than in the own ones are
  /// left to their owner.
  void take_rows(const RankRows& rows) {
    sides_.take_rows(rows);
    rows_.lay_out(sides_);
  }
  /// What `archive` has of points in these rows, one point after the other.
  std::vector<double> scattered(const grid::RowRange& rows) const { return memory_.scattered(sides_, rows); }
  /// Puts it in its place; returns what follows it.
  std::span<const double> gather_scattered(const grid::RowRange& rows, std::span<const double> values) {
    return memory_.gather_scattered(sides_, rows, values);
  }

  /// From now on given values that are zero, and projected ones, are differences to this solution.
  void choose(const ChosenSolution* solution) { chosen_.choose(solution); }

  /// Takes back what paper eq. (41) with beta = beta^r did on the way from q to `next` to the traction of loaded sides,
  /// as far as it would make noise grow (traction_share). `t`: of the offset of a chosen solution.
  template <class Gradient>
  void correct_relaxation(ConstFieldView q, FieldView next, double beta, double t) const;

 private:
  GhostFrame frame() const { return {sides_, chosen_}; }
  void set_motion(FieldView q, double t, std::span<const InterfaceValues> projected);
  void set_tractions(FieldView q, double t, std::span<const InterfaceValues> projected);
  void set_states(FieldView q, double t) const;

  Sides sides_;
  ChosenValues chosen_;
  SideMemory memory_;
  LoadedRows rows_;
  L law_;
  double rho_;
  double time_scale_;
  double waveless_ = 0;
};

template <Law L>
void SolidBoundary<L>::apply(FieldView q, double t, std::span<const InterfaceValues> projected) {
  const MatchedGhosts<L> matched(sides_, chosen_, memory_, law_);
  set_motion(q, t, projected);
  frame().fill_line(q, t, {.first_plane = plane::u1, .last_plane = plane::v2, .m = -1});
  frame().fill_line(q, t, {.first_plane = plane::u1, .last_plane = plane::u2, .m = -2});
  set_tractions(q, t, projected);
  frame().fill_line(q, t, {.first_plane = plane::v1, .last_plane = plane::P22, .m = -1});
  // A loaded side takes the difference along it at a slip wall from the ghost point below the wall.
  for (const Side side : all_sides) {
    if (sides_.condition(side).slips()) matched.match_slip_side(q, side, t);
  }
  for (const Side side : all_sides) {
    if (sides_.loaded(side)) matched.match_loaded_side(q, side, t, rows_);
  }
  matched.match_corners(q, t);
  const Tractions tractions(sides_, chosen_, time_scale_);
  for (const Side side : all_sides) tractions.extend_stress_to_corners(q, side, t, memory_);
  frame().fill_line(q, t, {.first_plane = plane::P11, .last_plane = plane::P22, .m = -1});
  frame().fill_line(q, t, {.m = -2});
  frame().fill_corners(q, t);
}

template <Law L>
void SolidBoundary<L>::set_motion(FieldView q, double t, std::span<const InterfaceValues> projected) {
  GivenMotion(sides_, chosen_).set(q, t, projected, memory_);
  set_states(q, t);
}

/// They win at corners.
template <Law L>
void SolidBoundary<L>::set_states(FieldView q, double t) const {
  for (const Side side : all_sides) {
    if (sides_.condition(side).has_state()) frame().set_state(q, side, t, 0);
  }
}

template <Law L>
void SolidBoundary<L>::set_tractions(FieldView q, double t, std::span<const InterfaceValues> projected) {
  const Tractions tractions(sides_, chosen_, time_scale_);
  const Characteristics<L> characteristics(sides_, chosen_, law_, rho_);
  for (const Side side : all_sides) {
    if (sides_.loaded(side)) tractions.find(q, side, t, memory_);
  }
  for (const InterfaceValues& values : projected) {
    if (values.grid != sides_.grid().index) continue;
    tractions.find_projected(q, t, values, memory_);
    waveless_ += characteristics.slide(q, values, memory_, rows_);
  }
  waveless_ += characteristics.slide_corners(q, projected, memory_);
  waveless_ += characteristics.follow_corners(q, memory_);
  for (const Side side : all_sides) {
    const Condition& condition = sides_.condition(side);
    if (condition.knows_rate() || condition.moved() || condition.slips())
      waveless_ += characteristics.follow(q, side, t, memory_);
  }
  // A mirror image has no shear, whatever load begins where it ends.
  for (const Side side : all_sides) {
    if (sides_.loaded(side)) tractions.set_normal_stress(q, side, t, memory_);
  }
  for (const Side side : all_sides) {
    if (sides_.condition(side).walled()) tractions.set_normal_stress(q, side, t, memory_);
  }
  tractions.take_shear_of_corners(q, t);
  waveless_ += characteristics.set_corner_stress(q, memory_);
  set_states(q, t);
}

template <Law L>
template <class Gradient>
void SolidBoundary<L>::correct_relaxation(ConstFieldView q, FieldView next, double beta, double t) const {
  const BoundaryGrid& grid = sides_.grid();
  for (const Side side : all_sides) {
    if (!sides_.loaded(side)) continue;
    for (const int k : sides_.points(side)) {
      const SideMetrics& m = sides_.at(side, k);
      const bool turns = sides_.turns_near(side, k), corner = turns && sides_.at_end(side, k);
      const double back = turns ? 1.0 : 1.0 - traction_share(m, beta);
      if (back == 0 || (corner && direction_of(side) == 1)) continue;  // left and right do the corners
      const auto [i, j] = grid_point(sides_.layout(), side, k);
      const WideRow u1(q, plane::u1, j), u2(q, plane::u2, j);
      const Gradient gradient(grid.x, *grid.metrics, j);
      const std::ptrdiff_t a = sides_.layout().at(i, j);
      const Tensor2 P = minus(load(q, a).P, chosen_.offset(a, t));
      const Tensor2 taken = surplus(law_, gradient(i, u1.first(i), u2.first(i)), P, beta);
      SolidState s = load(next, a);
      // By components: products of vectors are rounded otherwise.
      const Vec2 of_side = traction_of(taken, m.n0);
      s.P = corner ? plus(s.P, taken) : plus_dyad(s.P, m.n0, {back * of_side.x(), back * of_side.y()});
      store(next, a, s);
    }
  }
}

}  // namespace fsi::solid
