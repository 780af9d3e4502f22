#pragma once
/// Boundary conditions and ghost points of one component grid, in the order that is known to be stable.

#include <fmt/format.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/archive.hpp"
#include "common/core/failure.hpp"
#include "common/ranks/rows/rank_rows.hpp"
#include "solid_solver/boundary/ghost_lines.hpp"
#include "solid_solver/boundary/interface.hpp"
#include "solid_solver/boundary/traction_ghost.hpp"
#include "solid_solver/kernels/side_rows.hpp"
#include "solid_solver/solid_points.hpp"

namespace fsi::solid {

/// What a boundary works on.
struct BoundaryGrid {
  std::string name;
  int index = 0;     ///< of the grid among those of the body
  ConstFieldView x;  ///< reference positions with ghosts
  const ReferenceMetrics* metrics = nullptr;
  const SolidPoints* points = nullptr;
};

template <Law L>
class SolidBoundary {
 public:
  using Kind = Boundary::Kind;

  /// @param time_scale a time over which given tractions hardly change, for their time derivative
  /// @throws UserMistake when periodic sides do not come in pairs
  SolidBoundary(BoundaryGrid grid, const L& law, double rho, Boundaries boundaries, Limiter limiter,
                double time_scale);

  /// Sets the boundary points and both ghost lines of q at time t, in this order:
  ///  1. motion that is given (interface: v := v + (v_n - n.v) n; displacement, slip, symmetry, exact);
  ///  2. u on the first ghost line;
  ///  3. tractions that are given, paper eq. (42), and corners where the stress follows from them;
  ///  4. v and P on the first ghost line;
  ///  5. traction sides: ghost u from paper eq. (43), ghost v from its time derivative, tangential stress
  ///  from P(F);
  ///  6. P again on the first ghost line, then the second one and the corners of the ghost frame.
  /// Only discretised points are set, and ghost points beside valid ones.
  /// @throws NumbersBroke where no displacement fits the traction
  void apply(FieldView q, double t, std::span<const InterfaceValues> projected);
  /// Ghost points beside interpolated points, by extrapolation, reflection or repetition.
  void refresh_ghosts(FieldView q, double t) const;
  /// Conditions are applied next to interpolated points: these must have their values before.
  bool reads_interpolated_points() const;

  /// Tractions and their rates, and what motion that is given changed.
  void archive(Archive& archive);
  /// From now on conditions are set in these rows only, and numbers that break elsewhere than in the own ones are
  /// left to their owner.
  void take_rows(const RankRows& rows);
  /// Some of the side is in the rows.
  bool present(Side side) const { return present_[index(side)]; }
  /// What `archive` has of points in these rows, one point after the other.
  std::vector<double> scattered(const grid::RowRange& rows) const;
  /// Puts it in its place; returns what follows it.
  std::span<const double> gather_scattered(const grid::RowRange& rows, std::span<const double> values);

  /// From now on given values that are zero, and projected ones, are differences to this solution.
  void choose(const ChosenSolution* solution) { chosen_ = solution; }

  /// Takes back what paper eq. (40) across loaded sides, with beta = beta^u, did to their own points on the way
  /// from q to `next`: the ghost displacement there makes the traction right, it does not continue the field.
  void correct_displacement_dissipation(ConstFieldView q, FieldView next, double beta) const;
  /// Takes back what paper eq. (41) with beta = beta^r did on the way from q to `next` to the traction of loaded sides,
  /// as far as it would make noise grow (traction_share). `t`: of the offset of a chosen solution.
  template <class Gradient>
  void correct_relaxation(ConstFieldView q, FieldView next, double beta, double t) const;

  Kind kind(Side side) const { return kinds_[index(side)]; }
  /// Displacement and velocity of point k of a side where it also lies on a side whose motion is given.
  struct Motion {
    Vec2 u, v;
  };
  std::optional<Motion> given_motion(Side side, int k, double t) const;
  /// Normal of the wall, if any, along which point k of a side slides: a slip or symmetry side that meets
  /// this one there.
  std::optional<Vec2> wall_of(Side side, int k) const;
  /// Outward unit normal of the reference body.
  Vec2 normal(Side side, int k) const { return at(side, k).n0; }
  /// Geometry of point k of a side.
  const SideMetrics& at(Side side, int k) const { return metrics_[index(side)][static_cast<std::size_t>(k)]; }
  /// The load of a side follows the deformation: its area and its normal are the present ones.
  bool follows(Side side) const { return boundaries_[index(side)].load == LoadConfiguration::current; }

 private:
  static std::size_t index(Side side) { return static_cast<std::size_t>(side); }
  Layout layout() const { return grid_.x.layout; }
  const SideIndex& line_of(Side side) const { return lines_[index(side)]; }
  bool loaded(Side side) const { return kind(side) == Kind::traction || kind(side) == Kind::interface; }
  bool mirrored(Side side) const;
  /// Discretised points of a side, in the rows that the rank has.
  std::span<const int> points(Side side) const { return advanced_[index(side)]; }
  bool advanced(Side side, int k) const;
  void find_points(Side side);
  void lay_out_rows(Side side);
  SideRows rows_of(Side side) { return {rows_[index(side)].view()}; }
  /// Place of a discretised point in the rows of a side, which have all of them: the same loops give the same bits.
  std::size_t slot(Side side, int k) const { return slots_[index(side)][static_cast<std::size_t>(k)]; }
  template <class Action>
  void each_scattered(const grid::RowRange& rows, const Action& action) const;
  static bool end_of(const SideIndex& line, int k) { return k == 0 || k == line.n - 1; }
  Vec2 position(std::ptrdiff_t at) const { return {grid_.x.plane(0)[at], grid_.x.plane(1)[at]}; }
  /// False at a corner, unless the neighbour's ghost points are
  /// images, so that differences along the side are sound.
  bool inner(Side side, int k) const;
  /// Of the chosen solution; zero where there is none.
  SolidState chosen(std::ptrdiff_t at, double t) const;
  Tensor2 chosen_offset(std::ptrdiff_t at, double t) const;
  Tensor2 chosen_source(std::ptrdiff_t at, double t) const;
  Tensor2 chosen_strain_rate(std::ptrdiff_t at, double t) const;
  Vec2 side_normal_at_end(Side side, int k) const;
  /// Central differences along the side of u (first = plane::u1) or v over one index.
  static Vec2 difference_along(ConstFieldView q, const SideIndex& line, int first, int k);
  static Vec2 difference_across(ConstFieldView q, const SideIndex& line, int first, int k, double sign);

  void set_motion(FieldView q, double t, std::span<const InterfaceValues> projected);
  void project_velocity(FieldView q, double t, const InterfaceValues& values);
  void set_given_motion(FieldView q, Side side, double t);
  Motion displacement_of(Side side, const Vec2& x, double t) const;
  void remove_normal_motion(FieldView q, Side side, double t);
  void mirror(FieldView q, Side side, double t, const GhostRange& range) const;
  void set_exact(FieldView q, Side side, double t, int m) const;
  void fill_line(FieldView q, double t, const GhostRange& range) const;
  void fill_side(FieldView q, Side side, double t, const GhostRange& range) const;
  void set_tractions(FieldView q, double t, std::span<const InterfaceValues> projected);
  void find_traction(ConstFieldView q, Side side, double t);
  double stretch_along(ConstFieldView q, Side side, int k) const;
  void find_projected_traction(ConstFieldView q, double t, const InterfaceValues& values);
  Vec2 pressed_at_corner(ConstFieldView q, double t, const InterfaceValues& values, int k) const;
  void set_normal_stress(FieldView q, Side side, double t) const;
  Stiffness stiffness(ConstFieldView q, Side side, int k) const;
  Mat2 impedance(const Stiffness& K, Side side, int k) const;
  void follow_characteristics(FieldView q, Side side, double t) const;
  void slide_along_interface(FieldView q, const InterfaceValues& values);
  void set_corner_stress(FieldView q) const;
  struct SidePoint {
    Side side;
    int k;
  };
  void share_change_at_corner(ConstFieldView q, SolidState& s, const SidePoint& one,
                              const SidePoint& other) const;
  void extend_stress_to_corners(FieldView q, Side side, double t) const;
  void match_loaded_side(FieldView q, Side side, double t);
  void begin_match(ConstFieldView q, Side side, double t);
  void set_matched_ghosts(FieldView q, Side side, double t);
  void match_velocity(FieldView q, Side side, int k, double t, const BoundaryStrain& strain,
                      const Vec2& du) const;
  BoundaryStrain strain_along(ConstFieldView q, Side side, int k) const;
  void match_slip_side(FieldView q, Side side, double t) const;
  Tensor2 with_sharper_tangent(ConstFieldView q, Side side, int k, const Tensor2& F) const;
  /// Ghost points beyond this end of a side are images of inner ones.
  bool imaged(Side side, int end) const;
  void match_slip_point(FieldView q, Side side, int k, double t) const;
  void match_corners(FieldView q, double t) const;
  Tensor2 gradient(ConstFieldView q, Side side, int k, int first) const;
  void set_corner_ghosts(FieldView q, Side side, int k, int first, const Tensor2& gradient) const;
  static void set_ghost(FieldView q, const SideIndex& line, int k, int first, const Vec2& change);
  void fill_frame(FieldView q, double t) const;
  void broke(Side side, int k, double t) const;

  static constexpr Tensor2 identity = {1.0, 0.0, 0.0, 1.0};

  BoundaryGrid grid_;
  std::array<SideIndex, 4> lines_;
  L law_;
  double rho_;
  Boundaries boundaries_;
  std::array<Kind, 4> kinds_{};
  RankRows held_;  ///< rows that this rank has
  std::array<bool, 4> present_{true, true, true, true};
  std::array<std::vector<int>, 4> advanced_, interpolated_;  ///< points of the sides
  std::array<std::vector<std::size_t>, 4> slots_;
  std::array<std::vector<SideMetrics>, 4> metrics_;
  std::array<Field, 4> rows_;  ///< of the discretised points of loaded sides, for loops over them
  Limiter limiter_;
  double time_scale_;
  const ChosenSolution* chosen_ = nullptr;
  std::array<std::vector<Vec2>, 4> T_, T_rate_,
      v_change_;  ///< nominal traction n0^T P of the loaded sides and its rate
};

}  // namespace fsi::solid

#include "solid_solver/boundary/solid_boundary_matching.hpp"   // IWYU pragma: export
#include "solid_solver/boundary/solid_boundary_on_ranks.hpp"   // IWYU pragma: export
#include "solid_solver/boundary/solid_boundary_tractions.hpp"  // IWYU pragma: export
#include "solid_solver/boundary/solid_boundary_values.hpp"     // IWYU pragma: export
