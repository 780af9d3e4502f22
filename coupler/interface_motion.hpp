#pragma once
/// Geometry and motion of one interface: its normals, the lengths that belong to its points, and where it
/// goes next. Arrays are component-major over the n points: component c of point k is at [c * n + k].

#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "common/core/archive.hpp"
#include "common/core/types.hpp"

namespace fsi::coupler {

/// True where the last point of a curve is the first one again.
bool is_closed(std::span<const double> x);

/// From the first to the last point of a periodic curve.
Vec2 period_of(std::span<const double> x);

/// Order of the points along an interface curve.
struct Curve {
  std::size_t n = 0;
  bool closed = false;    ///< the last point is the first one again, or the first one of the next period
  bool periodic = false;  ///< it is that of the next period
  double sign =
      1;  ///< +1: turning the direction of increasing index by -90 degrees gives the normal, -1: by +90
  /// The first and the last point, and their reference normals.
  struct End {
    Vec2 n0 = Vec2::Zero();
    bool slides = false;  ///< along a wall at right angles to the curve: the normal stays n0
  };
  End first = {}, last = {};

  /// From the initial positions `x` and the reference normals `n0` of the solid.
  /// @param is_periodic the curve goes on beyond its ends, a period further
  /// @throws std::invalid_argument where fewer than two points or normals without a clear side are given
  Curve(std::span<const double> x, std::span<const double> n0, bool is_periodic = false);
};

/// Unit normals, solid -> gas, from central differences along the curve; one-sided of second order at open
/// ends, but for those that slide along a wall. There, the mirror image in the wall continues the curve; a
/// one-sided difference would turn a ripple of the curve into a normal that pushes the end off the wall.
void unit_normals(const Curve& curve, std::span<const double> x, std::span<double> n);

/// Length from point 0 along the curve.
void arclength(std::span<const double> x, std::span<double> s);

/// Where an interface goes.
struct Path {
  using Position = std::function<Vec2(double x, double y, double t)>;
  Position position = {};  ///< at t of the point that is at (x, y) at t = 0; empty: nobody knows
  double time_scale = 1;   ///< time in which it changes by much [time]

  explicit operator bool() const { return static_cast<bool>(position); }
};

/// An interface that goes its own way, whatever the solid does: for chosen solutions.
class PrescribedMotion {
 public:
  /// @param x positions of the points at t = 0
  PrescribedMotion(Path path, std::span<const double> x);

  void position(double t, std::span<double> x) const;
  /// By central differences of the path.
  void velocity(double t, std::span<double> v) const;
  void acceleration(double t, std::span<double> a) const;

 private:
  Path::Position path_;
  double step_;  ///< of differences in time [time]
  std::vector<double> x_;

  template <class Value>
  void each(std::span<double> out, const Value& value) const;
};

/// Velocity and acceleration of the interface points, and the position they are commanded to.
class InterfaceMotion {
 public:
  explicit InterfaceMotion(std::size_t points) : v_(2 * points), a_(2 * points), mean_(2 * points) {}

  /// Projected velocity of the initial state, and its acceleration where the solid says one (empty: 0).
  void start(std::span<const double> v, std::span<const double> a);
  /// Projected velocity at the end of a step of size `dt`. The acceleration is of second order from the third velocity on.
  void take(std::span<const double> v, double dt);
  /// Position after the next step, x_s + dt v + dt^2/2 a. It starts from the solid's own position, so that
  /// what the gas and the solid differ by now is gone after the step.
  void command(std::span<const double> x_solid, double dt, std::span<double> x_next) const;
  std::span<const double> a() const { return a_; }
  void archive(Archive& archive);

 private:
  std::vector<double> v_, a_;
  std::vector<double> mean_;  ///< mean acceleration of the last step
  double dt_ = 0;             ///< its size [time]
  int steps_ = 0;
};

}  // namespace fsi::coupler
