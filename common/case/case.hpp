#pragma once
/// The typed form of a case file: what `configs/*.yaml` says after expressions of the parameters are
/// evaluated, overrides applied and everything checked. docs/case_file.md
/// is generated from the same description.

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/core/boundary_kinds.hpp"
#include "common/core/choices.hpp"
#include "common/core/input/expression.hpp"
#include "common/core/types.hpp"

namespace fsi {

/// Gas state as expressions of x, y, r, t. Where the file gives T, p is rho * T.
struct GasExpressions {
  Expression rho, v1, v2, p;
};

/// Vector field as expressions of x, y, r, t.
struct VectorExpressions {
  Expression c1, c2;
};

/// Tensor field as expressions of x, y, r, t.
struct TensorExpressions {
  Expression c11, c12, c21, c22;
};

/// One mapped component grid.
struct GridSpec {
  enum class Kind { rectangle, mapped, block };
  Kind kind = Kind::rectangle;
  std::string name;
  int n1 = 0, n2 = 0;                         ///< points, both ends included
  double x_a = 0, x_b = 1, y_a = 0, y_b = 1;  ///< rectangle [length]
  double rotation = 0;                        ///< of the whole grid about the origin [rad]
  VectorExpressions map;                      ///< mapped: x(r, s, t), y(r, s, t) on the unit square
  std::array<Vec2, 4> corners = {};           ///< block: at (r, s) = (0, 0), (1, 0), (1, 1), (0, 1)
  bool moving = false;                        ///< the mapping depends on t
  std::array<bool, 2> periodic{false, false};
  double shake = 0;  ///< random displacement of each inner point at each step, in cells [-]
  std::uint64_t shake_seed = 1;
};

/// Points of a curve, the body to the left of their direction.
struct CurveSpec {
  std::vector<double> x;  ///< 2 n, component-major; of a closed curve the last point is the first one
  double spacing = 0;     ///< mean distance of points [length]
  /// Open: sides of the background on which its ends lie; of a curve on a wall, those it stands for: the side
  /// whose direction into the domain is nearest to the wall's.
  std::optional<std::array<Side, 2>> walls = {};
  std::string on = {};             ///< the gas's grid along the wall on which both ends stand; empty: sides
  std::array<Vec2, 2> along = {};  ///< direction of that wall at the first and at the last point
  std::vector<int> corners = {};   ///< points at which it turns sharply
  bool elastic_corners = false;    ///< they are those of an elastic body

  bool closed() const { return !walls.has_value(); }
  int points() const { return static_cast<int>(x.size() / 2); }
};

/// What holds on a side; which of it means something its kind says (common/case/schema/boundary_facts.hpp).
struct BoundarySpec {
  BoundaryKind kind = BoundaryKind::symmetry;
  std::string solid = {};                               ///< interface of a gas: the solid on the other side
  std::string fluid = {};                               ///< interface of a solid: the gas on the other side
  bool from_reference = false;                          ///< data of `reference`
  std::optional<GasExpressions> state = {};             ///< of a gas
  std::optional<VectorExpressions> vector = {};         ///< `value`: traction per unit area, or displacement
  std::optional<VectorExpressions> velocity = {};       ///< time derivative of a displacement
  LoadConfiguration load = LoadConfiguration::current;  ///< of a solid
  std::map<std::string, double> numbers = {};           ///< other keys of its kind: numbers
  std::map<std::string, Expression> fields = {};        ///< the same: fields
  std::map<std::string, VectorExpressions> vectors = {};  ///< the same: vectors
};

/// A grid marched from a curve, before a rectangular background.
struct BodyFittedSpec {
  std::string name;
  std::string solid;  ///< gas: whose outline the curve is; "" for a wall
  CurveSpec curve;
  Side side =
      Side::bottom;    ///< of the grid, where the curve is: bottom, domain to its left, or top, to its right
  int lines = 8;       ///< the curve included
  double spacing = 0;  ///< of the first line from the curve [length]
  double growth = 1;   ///< ratio of successive distances [-]
  double concave_smoothing = 1;  ///< of lines that converge, in parts of the grid's depth [-]
  std::optional<VectorExpressions>
      map;  ///< x(r, s), y(r, s), r along the curve and s from it, instead of marching
  std::array<BoundarySpec, 4> boundary;  ///< left, right, bottom, top
};

struct GasScheme {
  /// Mach number from which on a shock along grid lines breaks up without viscosity (docs/results.md, cylinders in fast streams).
  static constexpr double strong_shock = 2;

  RiemannSolver riemann = RiemannSolver::roe;
  GasLimiter limiter = GasLimiter::minmod;
  double entropy_fix = 0.1;  ///< width of the sonic-point fix, part of a [-]
  /// Coefficient of max(0, -div v) on undivided differences [-]; left open: none, and strong shocks are noticed.
  std::optional<double> shock_viscosity;
  double linear_diffusion = 0;  ///< of undivided second differences [1/time]
};

/// A background of the gas that is finest where the gas or a body needs it.
struct RefineSpec {
  int levels = 1;  ///< each three times as coarse as the next finer one; 1: the same spacing everywhere
  RefinedQuantity variable = RefinedQuantity::rho;
  double threshold = 3e-3;  ///< refine where undivided second differences exceed this part of the range [-]
  int buffer = 2;           ///< points of the coarser level around what is to be refined
  int every = 6;            ///< steps between two adaptations
  std::array<int, 2> asked{};  ///< points of the background before some were added for the levels
};

/// A gas, with a program of its own.
struct FluidSpec {
  std::string name = "fluid";  ///< of the participant: "fluid", or that under `fluids`
  std::string path = "fluid";  ///< of its section, for messages
  double gamma = 1.4;          ///< [-]
  double p_e = 0;              ///< [pressure]
  GridSpec grid;
  RefineSpec refine;
  std::array<BoundarySpec, 4> boundary;  ///< left, right, bottom, top
  std::vector<BodyFittedSpec> body_fitted;
  GasScheme scheme;
  bool initial_from_reference = false;
  std::optional<GasExpressions> initial;
};

/// Coefficient with a rate and a 1/dt part: beta = rate * dt + scaled.
struct Beta {
  double rate = 0;    ///< [1/time]
  double scaled = 0;  ///< [-]
};

struct SolidScheme {
  SolidLimiter limiter = SolidLimiter::mc;
  Beta tangential_stress;     ///< beta^P of (39)
  Beta displacement;          ///< beta^u of (40)
  Beta relaxation;            ///< beta^r of (41)
  double bulk_diffusion = 0;  ///< undivided second differences of v and P [1/time]
};

/// The centre line of a solid that is a beam, and what holds its ends.
struct BeamSpec {
  std::vector<Vec2> line;  ///< a straight line through two points, a spline through more
  bool closed = false;     ///< a ring
  int elements = 0;
  Expression thickness;  ///< of the reference position
  std::array<BeamEnd, 2> ends{BeamEnd::free, BeamEnd::free};
};

/// What a rigid body may do, in the order of whatever holds it.
inline constexpr std::array<std::string_view, 3> rigid_motions{"x", "y", "rotation"};

/// What holds a rigid body at a point of it, its pivot; springs are at rest at t = 0.
struct MountingSpec {
  std::optional<Vec2> pivot;                   ///< at t = 0; none: the centre of mass
  std::array<bool, 3> free{true, true, true};  ///< of `rigid_motions`
  /// Of `rigid_motions`: displacement or angle as a formula of t, whatever the gas does. [length], [rad]
  std::array<std::optional<Expression>, 3> given{};
  std::array<double, 3> spring{};  ///< [force/length/depth], [force*length/depth]
  std::array<double, 3> damper{};  ///< the same times time

  bool holds() const {
    const auto any = [](const std::array<double, 3>& of) { return of != std::array<double, 3>{}; };
    return free != std::array{true, true, true} || any(spring) || any(damper);
  }
  bool moves_as_given() const { return std::ranges::any_of(given, &std::optional<Expression>::has_value); }
};

struct SolidSpec {
  std::string name;
  std::string law;      ///< the executable is solid_solver_<law>, or `program` where the law is external
  std::string program;  ///< of an external solid: a name among the programs, or a path
  std::map<std::string, double> data;  ///< numbers for that program, or of the law besides lambda and mu
  double rho = 1, lambda = 1, mu = 1;  ///< [mass/volume], [pressure]
  bool fixed = false;                  ///< a rigid body that stays where it is
  MountingSpec mounting;               ///< of a rigid body that does not
  GridSpec grid;
  std::array<BoundarySpec, 4> boundary;
  /// Along the outline; none where the outline is that of `grid`. Of a block its curve alone counts.
  std::vector<BodyFittedSpec> body_fitted;
  SolidScheme scheme;
  std::optional<BeamSpec> beam;
  bool initial_from_reference = false;
  std::optional<VectorExpressions> initial_u, initial_v;
  std::optional<VectorExpressions> body_force;  ///< force per unit reference volume

  /// Of a rigid body: is there anything besides a gas that changes how it moves?
  bool is_driven() const { return !fixed && (body_force || mounting.holds() || mounting.pivot); }
};

struct TimeSpec {
  double end = 1;       ///< [time]
  double cfl = 0.9;     ///< safety factor C_CFL [-]
  double growth = 1.2;  ///< largest ratio of successive steps [-]
  bool multirate = false;
  int robin_order = 2;        ///< 1 linear, 2 quadratic extrapolation of the Robin data
  std::optional<double> dt;   ///< largest step, for studies [time]
  double join_timeout = 20;   ///< [s]
  double peer_timeout = 4;    ///< [s]
  double step_timeout = 120;  ///< [s]
};

struct ProjectionSpec {
  Projection projection = Projection::simplified;
  GasResponse riemann = GasResponse::exact;
};

struct InterfaceSpec : ProjectionSpec {
  std::optional<VectorExpressions> motion;  ///< position at t of the point that is at (x, y) at t = 0
};

struct ProbeSpec {
  std::string name, in;  ///< in: a gas ("fluid") or a solid
  double x = 0, y = 0;   ///< gas: where; solid: reference position [length]
};

struct OutputSpec {
  std::vector<double> times;
  std::vector<double> left_out = {};  ///< times after the end that the file asks for
  std::vector<ProbeSpec> probes;
  int checkpoint_every = 0;         ///< steps; 0: never
  double checkpoint_seconds = 600;  ///< of wall time [s]
  bool checkpoint_at_end = true;    ///< so that the run can be extended
  bool go_on = false;               ///< where results cannot be written, without them
};

/// Where an exact or a fine solution comes from.
struct ReferenceSpec {
  ReferenceKind kind = ReferenceKind::none;
  std::map<std::string, double> numbers;  ///< data of a named solution
  std::optional<GasExpressions> fluid;    ///< expressions, manufactured
  std::optional<VectorExpressions> u;     ///< expressions, manufactured: solid displacement of x, y, t
  std::optional<VectorExpressions> v;     ///< manufactured: solid velocity where it is not du/dt
  std::optional<TensorExpressions> P;     ///< manufactured: nominal stress where it is not P(F(u))

  /// By a program of its own, whose table is complete after the run.
  bool computed() const { return kind == ReferenceKind::piston_1d || kind == ReferenceKind::rotating_disk; }
  /// By formulas of the case.
  bool in_formulas() const {
    return kind == ReferenceKind::expressions || kind == ReferenceKind::manufactured;
  }
};

struct Expectation {
  std::string quantity;            ///< path in summary.json, "errors.rho"
  std::optional<double> max, min;  ///< [unit of the quantity]
  std::optional<std::string> equals;
};

struct Case {
  std::string name, title, path;
  bool in_si = false;               ///< all numbers are in m, s, kg
  std::string digest;               ///< of the resolved text: all programs of a run must agree
  std::string restart_digest;       ///< of the part that a restart must not change
  std::string resolved;             ///< the case with parameters and overrides filled in, as YAML
  std::vector<std::string> chosen;  ///< keys that the file left open, with the values chosen for them
  std::vector<std::string> unused;  ///< parameters that nothing in the file needs
  std::map<std::string, double> parameters;
  std::map<std::string, std::string> formulas;  ///< of the parameters that others give
  double grid_factor = 1;                       ///< j of h = 1 / (10 j) [-]
  TimeSpec time;
  InterfaceSpec interface;
  std::vector<FluidSpec> fluids;  ///< one from `fluid`, or all of `fluids`
  std::vector<SolidSpec> solids;
  OutputSpec output;
  ReferenceSpec reference;
  std::vector<Expectation> expect;
};

/// Reads, checks and resolves a case. `overrides` are "key=value"
/// texts of --set, `laws` "NAME=LAW" of --solid.
/// @throws UserMistake with file:line:column
Case load_case(const std::string& path, const std::vector<std::string>& overrides = {},
               const std::vector<std::string>& laws = {});

/// The gas of this name; nullptr where there is none.
const FluidSpec* fluid_named(const Case& problem, const std::string& name);

/// Name of the fields of a gas: "fluid", or "fluid_<name>" of one among several.
std::string fields_name(const FluidSpec& fluid);

/// Whether a side of a solid has a load of its own.
bool carries_load(const BoundarySpec& spec);

/// A solid whose one grid lies between the four straight sides of its outline.
bool is_block(const SolidSpec& solid);

/// @{ Component grids besides `grid`: of a block there are none.
const std::vector<BodyFittedSpec>& fitted_grids(const FluidSpec& fluid);
const std::vector<BodyFittedSpec>& fitted_grids(const SolidSpec& solid);
/// @}

/// The side of a solid's grid that is the interface to this gas; none for a solid with an outline of its own.
std::optional<Side> side_to(const SolidSpec& solid, const std::string& fluid);

/// True where a grid or a side of a gas meets a solid.
bool meets(const FluidSpec& fluid, const std::string& solid);
/// The gases a solid meets, in the order of its sides.
std::vector<std::string> gases_at(const SolidSpec& solid);

/// What the interface of a solid with a gas is called: as the solid, or "<solid>.<gas>" where it meets several
/// gases.
std::string interface_name(const SolidSpec& solid, const std::string& fluid);

/// The file a user means: a path, or a name in one of `folders`.
/// @throws UserMistake with the nearest name
std::string find_case(const std::string& path_or_name, const std::vector<std::string>& folders);

/// Folder configs/ of this source tree.
std::string configs_folder();

}  // namespace fsi
