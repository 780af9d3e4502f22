#pragma once
/// A domain covered by overlapping component grids (paper section 4.1): a Cartesian background and
/// body-fitted grids before it.
///
///     . . . . . . . .     .  discretised point of the background
///     . . o o o o . .     o  interpolates from the body-fitted grid (as many layers as the stencils need)
///     . o o /---\ o .     x  unused: behind the curve (or needed by nobody)
///     . o o | x x |       ---  curve: first line of a body-fitted grid, whose outermost lines interpolate
///                              from the background or from another body-fitted grid
///
/// A body that passes between two points of the background without one behind its curve would not be there for it: the
/// points nearest to its middle are unused then, too.
///
/// Background points are classified by the crossings of the grid rows with the curves; what is known of a row
/// are intervals, so an update costs as much as the curves are long, whatever the number of points, and
/// depends on the present positions only.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/archive.hpp"
#include "common/core/field.hpp"
#include "common/core/types.hpp"
#include "common/grid/cartesian_grid.hpp"
#include "common/grid/intervals.hpp"
#include "common/grid/overlap/donor_search.hpp"
#include "common/grid/overlap/hole_cutting.hpp"
#include "common/grid/overlap/implicit_system.hpp"
#include "common/grid/overlap/interpolation.hpp"

namespace fsi::grid {

/// A grid whose first line (bottom or top) bounds the domain
/// and cuts the other grids; the opposite side interpolates.
struct BodyFittedGrid {
  std::string name = "grid";
  int n1 = 0, n2 = 0;
  Side curve = Side::bottom;   ///< bottom: the domain lies to the left of the curve; top: to its right
  Curve ends = Curve::closed;  ///< open: both ends on the boundary of the background, or on `wall`
  int wall = 0;                ///< the grid on whose curve, straight there, both ends stand; 0: none
  std::string of = {};         ///< for people: what the curve is the outline of; "": say the grid's name
};

struct OverlapOptions {
  int layers = 2;     ///< of interpolation points: half-width of the widest stencil, corners included
  bool trim = false;  ///< leave unused the outer lines of body-fitted grids that no background point needs
};

enum class PointKind : std::uint8_t { unused, interpolated, discretised };

/// What an update did and what it had to put up with.
struct OverlapCounts {
  std::size_t interpolated = 0;    ///< points, all grids
  std::size_t width_2 = 0;         ///< of these with two donors per direction: second order only
  std::size_t implicit = 0;        ///< of these with donors that are interpolated themselves
  std::size_t narrowed = 0;        ///< of these with two donors because three would amplify errors
  std::size_t lines_left_out = 0;  ///< of body-fitted grids, for others that are too near
  std::size_t exposed = 0;         ///< points that were unused before
  std::size_t extrapolated =
      0;  ///< of these behind the old curve or out of the background, by less than two lines
  bool operator==(const OverlapCounts&) const = default;
};

/// The worst of all connections since the start.
struct OverlapRecord {
  /// Implicit points: how much larger than its cause an error may arrive, and where and when; 1 where there
  /// are none to speak of.
  double amplification = 1;  ///< [-]
  int grid = 0, i = 0, j = 0;
  Vec2 x = Vec2::Zero();
  double t = 0;                                                ///< [time]
  std::size_t implicit = 0, narrowed = 0, lines_left_out = 0;  ///< most at a time, see OverlapCounts
};

/// Vertices of a body-fitted grid after and before a step (fields of n1 x n2 points, planes x1, x2).
struct GridPositions {
  ConstFieldView x, x_old;
};

class CompositeGrid {
 public:
  /// Grid 0 is the background, grid k > 0 is bodies[k - 1]. @throws UserMistake
  CompositeGrid(CartesianGrid background, std::vector<BodyFittedGrid> bodies, OverlapOptions options = {});

  /// Connects the grids where they are, without a past. @throws Diverged at points without donors, and
  /// where points are donors of nothing but each other
  void connect(std::span<const ConstFieldView> x, double t);
  /// Connects the moved grids and finds the points that were unused
  /// before. The views must stay valid for the call only.
  /// @throws Diverged at points without donors, or uncovered by a motion of more than a cell
  void update(std::span<const GridPositions> x, double t);

  int grids() const { return static_cast<int>(parts_.size()); }
  const CartesianGrid& background() const { return background_; }
  const BodyFittedGrid& body(int grid) const { return bodies_[static_cast<std::size_t>(grid) - 1]; }
  const std::string& name(int grid) const { return grid == 0 ? background_.name : body(grid).name; }
  Layout layout(int grid) const { return part(grid).layout; }

  /// Runs of discretised points of each row: what kernels sweep.
  const RowSets& discretised(int grid) const { return part(grid).now.discretised; }
  /// Runs of points with a value: discretised and interpolated.
  const RowSets& valid(int grid) const { return part(grid).now.valid; }
  PointKind kind(int grid, int i, int j) const;

  /// Interpolates all planes of all fields, one per grid; points
  /// that are donors of each other get their common solution.
  void interpolate(std::span<const FieldView> fields) const { interpolate(fields, interpolation_); }
  /// The same at some of the points: `lists` are those of interpolation(), and have fewer points where they are not
  /// implicit.
  void interpolate(std::span<const FieldView> fields, std::span<const InterpolationList> lists) const;
  /// Gives the points that were unused before the last update
  /// values of the time before it: `fields` hold that time.
  void fill_exposed(std::span<const FieldView> fields) const { fill_exposed(fields, exposed_); }
  /// The same at some of the points.
  static void fill_exposed(std::span<const FieldView> fields, std::span<const InterpolationList> lists);

  std::span<const InterpolationList> interpolation() const { return interpolation_; }
  std::span<const InterpolationList> exposed() const { return exposed_; }
  const OverlapCounts& counts() const { return counts_; }
  const OverlapRecord& record() const { return record_; }
  /// The record, to be written or read back; all else is found again by connecting.
  void archive(Archive& archive);

  /// More than that, and errors of implicit points would be felt: twice what three donors per direction that
  /// are known have at most next to the stencil's ends, (25/16) each.
  static constexpr double sound_amplification = 3.125;  ///< [-]

 private:
  struct Part {
    Layout layout;
    GridRows rows;
    PointSets now, before;
  };
  /// Positions and point sets of one time: that of the update or the one before.
  struct Level {
    bool before = false;
    double behind_curve = 0;  ///< how far behind a curve a donor stencil may reach, in lines [-]
    double outside = 0;       ///< how far out of the background, in cells [-]
    int widest = 3;           ///< donors per direction
  };
  /// That of an update: the chord of two curve points may cut off half a thin line.
  static constexpr Level present(int widest) {
    return {.before = false, .behind_curve = 0.5, .outside = 0, .widest = widest};
  }
  /// Cell of a body-fitted grid from which a search starts; grid 0: none known.
  struct Start {
    int grid = 0, i = 0, j = 0;
  };
  struct Orphans {
    std::size_t count = 0;
    int grid = 0, i = 0, j = 0;
    Vec2 x = Vec2::Zero();
  };

  CartesianGrid background_;
  std::vector<BodyFittedGrid> bodies_;
  OverlapOptions options_;
  std::vector<Part> parts_;
  std::vector<CurveCut> cuts_;
  std::vector<GridPositions> positions_;
  std::vector<InterpolationList> interpolation_, exposed_;
  std::optional<ImplicitSystem> implicit_;  ///< where points are donors of each other
  OverlapCounts counts_;
  OverlapRecord record_;
  Orphans orphans_;
  /// A point of the background that is unused since a body thinner than a cell passes beside it.
  struct PinchedPoint {
    int j = 0, i = 0;
    int grid = 0;  ///< of the body's curve
    auto operator<=>(const PinchedPoint&) const = default;
  };
  std::vector<PinchedPoint> pinched_;       ///< in order
  std::vector<Interval> intervals_, runs_;  ///< work memory
  std::vector<int> cutters_;

  const Part& part(int grid) const { return parts_[static_cast<std::size_t>(grid)]; }
  Part& part(int grid) { return parts_[static_cast<std::size_t>(grid)]; }
  bool curve_below(int grid) const { return body(grid).curve == Side::bottom; }
  CuttingCurve curve_of(int grid) const;
  CellMap cells_of(int grid, const Level& level) const;
  Donors donors_of(int grid, const Level& level) const;
  Vec2 position_of(int grid, int i, int j, const Level& level) const;
  InterpolationList& list_for(std::vector<InterpolationList>& lists, int target, const Stencil& stencil);

  void connect_now(double t);
  void cut_background();
  void find_pinched();
  bool is_kept_apart(const Pinch& pinch);
  bool is_near_hole(int i, int j);
  bool is_pinched(const Vec2& x, int grid) const;
  void expect_curve_inside(int grid, double t) const;
  void cut_body(int grid, double t);
  bool touches(int grid, int other);
  bool cut_away(const Vec2& x, int spared) const;
  void limit_lines(int grid, int lines);
  /// How far a connection goes on that will not do: the number of orphans is for messages.
  enum class Orphaned : std::uint8_t { stop_at_first, count_all };
  void connect_all(bool trim, int most_lines, Orphaned points);
  void connect_with_fewer_lines();
  void connect_grid(int grid, Orphaned points);
  void trim_lines();
  void find_exposed();
  void connect_run(int grid, int j, Interval run, const Level& level, std::vector<InterpolationList>& lists);
  std::optional<Stencil> stencil_for(int grid, const Vec2& x, Start& start, const Level& level) const;
  void solve_for_implicit(double t);
  void note_worst(double t);
  void narrow(std::span<const ImplicitPoint> points);
  void count_exposed(const Stencil& stencil);
  Start nearest_start(int i, int j) const;
  std::optional<Stencil> donor_in(Start& start, const Vec2& x, const Level& level) const;
  std::optional<Stencil> donor_anywhere(int target, const Vec2& x, const Level& level) const;
  /// A point of a grid, and where it is.
  struct GridPoint {
    int grid = 0, i = 0, j = 0;
    Vec2 x = Vec2::Zero();
  };
  GridPoint point_of(const ImplicitPoint& point) const;
  void orphan(int grid, int i, int j, const Vec2& x);
  void report_orphans(double t, const char* what) const;
  std::string nearest_curves(const Vec2& x, double t) const;
  [[noreturn]] void report_unsolved(const ImplicitPoint& point, double t) const;
};

}  // namespace fsi::grid
