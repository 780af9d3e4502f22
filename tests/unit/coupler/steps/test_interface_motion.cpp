/// Geometry and motion of an interface.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "common/interface/point_lengths.hpp"
#include "coupler/interface_motion.hpp"

namespace fsi::coupler {
namespace {

using std::numbers::pi;

/// Points of a curve, component-major.
std::vector<double> points_of(std::size_t n, const std::function<double(double)>& x,
                              const std::function<double(double)>& y) {
  std::vector<double> points(2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const double r = static_cast<double>(k) / static_cast<double>(n - 1);
    points[k] = x(r);
    points[n + k] = y(r);
  }
  return points;
}

/// Circle of radius 2, points clustered, run through with increasing or decreasing angle.
std::vector<double> circle(std::size_t n, bool backward) {
  const double turn = backward ? -2 * pi : 2 * pi;
  const auto angle = [=](double r) { return turn * (r + 0.05 * std::sin(2 * pi * r)); };
  return points_of(
      n, [=](double r) { return 2 * std::cos(angle(r)); }, [=](double r) { return 2 * std::sin(angle(r)); });
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

/// Unit vectors away from the middle of a curve's points.
std::vector<double> outwards(const std::vector<double>& x) {
  const std::size_t n = x.size() / 2;
  Vec2 middle = Vec2::Zero();
  for (std::size_t k = 0; k < n; ++k) middle += vector_at(x, k) / static_cast<double>(n);
  std::vector<double> away(x.size());
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 one = (vector_at(x, k) - middle).normalized();
    away[k] = one.x();
    away[n + k] = one.y();
  }
  return away;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (std::size_t k = 0; k < a.size(); ++k) worst = std::max(worst, std::abs(a[k] - b[k]));
  return worst;
}

TEST(UnitNormals, PointOutOfTheSolidWhicheverWayTheCurveRuns) {
  for (const bool backward : {false, true}) {
    const std::vector<double> x = circle(65, backward);
    const std::vector<double> outward = scaled(x, 0.5);
    const Curve curve(x, outward);
    EXPECT_TRUE(curve.closed);
    std::vector<double> n(x.size());
    unit_normals(curve, x, n);
    EXPECT_LE(largest_difference(n, outward), 1e-2);

    const Curve hole(x, scaled(outward, -1));  // the solid lies outside the circle
    unit_normals(hole, x, n);
    EXPECT_LE(largest_difference(n, scaled(outward, -1)), 1e-2);
  }
}

TEST(UnitNormals, ConvergeToSecondOrderOnClosedAndOpenCurvesEndsIncluded) {
  const auto error = [](std::size_t n, bool open) {
    std::vector<double> x = circle(n, false);
    if (open) {
      x = points_of(
          n, [](double r) { return 2 * std::cos(r + r * r); },
          [](double r) { return 2 * std::sin(r + r * r); });
    }
    const std::vector<double> outward = scaled(x, 0.5);
    std::vector<double> normals(x.size());
    unit_normals(Curve(x, outward), x, normals);
    return largest_difference(normals, outward);
  };
  for (const bool open : {false, true}) {
    const double coarse = error(65, open);
    const double fine = error(129, open);
    EXPECT_LE(fine, 2e-3);
    EXPECT_GE(std::log2(coarse / fine), 1.9) << (open ? "open" : "closed");
  }
}

TEST(UnitNormals, AreExactOnAStraightLineWithAnySpacing) {
  const std::vector<double> x = points_of(
      5, [](double r) { return 0.3 + 0.6 * (r + r * r); }, [](double r) { return -0.1 + 0.8 * (r + r * r); });
  std::vector<double> n0(10);
  std::fill(n0.begin(), n0.begin() + 5, 0.8);
  std::fill(n0.begin() + 5, n0.end(), -0.6);
  std::vector<double> n(10);
  unit_normals(Curve(x, n0), x, n);
  EXPECT_LE(largest_difference(n, n0), 1e-15);
}

// A ripple of one part in a thousand would tilt a one-sided difference there by as much as eight.
TEST(UnitNormals, OfEndsThatSlideAlongWallsStayThoseOfTheReferenceBody) {
  std::vector<double> x = points_of(
                          9, [](double) { return 0.0; }, [](double r) { return r; }),
                      n0(18), n(18);
  std::fill(n0.begin(), n0.begin() + 9, 1.0);
  Curve curve(x, n0);
  curve.first.slides = true;
  for (std::size_t k = 0; k < 9; ++k) x[k] = 0.3 + (k % 2 == 0 ? 1e-3 : -1e-3);
  unit_normals(curve, x, n);
  EXPECT_EQ(Vec2(n[0], n[9]), Vec2(1, 0));
  EXPECT_GT(std::abs(n[9 + 8]), 1e-3);
}

TEST(UnitNormals, AreTheSameAtTheTwoCopiesOfThePointThatClosesACurve) {
  const std::vector<double> x = circle(33, false);
  const Curve curve(x, x);
  std::vector<double> n(x.size());
  unit_normals(curve, x, n);
  EXPECT_EQ(n[0], n[32]);
  EXPECT_EQ(n[33], n[65]);
}

/// One period of a wave along y: its normals at the ends are those inside, a quarter of it further.
TEST(UnitNormals, OfAPeriodicCurveKnowNoEnds) {
  constexpr std::size_t n = 17, shift = 4;
  const auto wave = [](double offset) {
    return points_of(
        n, [=](double r) { return 0.1 * std::sin(2 * pi * (r + offset)); }, [](double r) { return 0.5 + r; });
  };
  std::vector<double> n0(2 * n);
  std::fill(n0.begin(), n0.begin() + n, 1.0);
  std::vector<double> here(2 * n), there(2 * n), ends(2 * n);
  const std::vector<double> x = wave(0), moved = wave(static_cast<double>(shift) / (n - 1));
  unit_normals(Curve(x, n0, true), x, here);
  unit_normals(Curve(moved, n0, true), moved, there);
  for (std::size_t c : {0U, 1U}) {
    EXPECT_EQ(here[c * n], here[c * n + n - 1]);
    for (std::size_t k = 0; k < n; ++k)
      EXPECT_NEAR(there[c * n + k], here[c * n + (k + shift) % (n - 1)], 1e-14) << k;
  }
  unit_normals(Curve(x, n0), x, ends);
  EXPECT_GT(std::abs(ends[n] - here[n]), 1e-3) << "one-sided differences are others";
}

TEST(PointLengths, AddUpToTheLengthOfTheCurve) {
  const std::vector<double> x = circle(257, false);
  std::vector<double> ds(257), n(x.size());
  unit_normals(Curve(x, outwards(x)), x, n);
  point_lengths(x, n, ds);
  const double chords = std::accumulate(ds.begin(), ds.end(), 0.0);
  EXPECT_NEAR(chords, 4 * pi, 3e-3);  // chords of two steps fall short by (2 pi / 128)^2 / 24 of the length
}

/// A closed polygon with as many points on each side as said, the first corner where it closes.
std::vector<double> polygon(const std::vector<Vec2>& corners, const std::vector<int>& points) {
  std::vector<Vec2> all;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2 way = corners[(k + 1) % corners.size()] - corners[k];
    for (int i = 0; i < points[k]; ++i)
      all.emplace_back(corners[k] + way * (static_cast<double>(i) / points[k]));
  }
  all.push_back(corners[0]);
  std::vector<double> x(2 * all.size());
  for (std::size_t k = 0; k < all.size(); ++k) x[k] = all[k].x(), x[all.size() + k] = all[k].y();
  return x;
}

TEST(PointLengths, LetAConstantPressurePushNoBodyWhateverItsCorners) {
  const std::vector<double> x = polygon({{0.2, 0}, {1.3, 0.1}, {0.7, 0.8}, {0.1, 0.3}}, {7, 4, 5, 3});
  const std::size_t points = x.size() / 2;
  for (const double side : {1.0, -1.0}) {
    std::vector<double> n0 = outwards(x), n(x.size()), ds(points);
    for (double& value : n0) value *= side;
    unit_normals(Curve(x, n0), x, n);
    point_lengths(x, n, ds);
    Vec2 force = Vec2::Zero();
    double moment = 0;
    for (std::size_t k = 0; k < points; ++k) {
      force += ds[k] * vector_at(n, k);
      moment += ds[k] * (vector_at(x, k).x() * n[points + k] - vector_at(x, k).y() * n[k]);
    }
    EXPECT_LT(force.norm(), 1e-15 * static_cast<double>(points));
    EXPECT_LT(std::abs(moment), 1e-14);
  }
}

TEST(PointLengths, OfABodyOnAWallTurnThePressureIntoTheForceOnItsFoot) {
  std::vector<double> x, y;
  for (int k = 0; k <= 4; ++k) x.push_back(0.25), y.push_back(0.1 * k);
  for (int k = 1; k <= 3; ++k) x.push_back(0.25 - 0.25 * k / 3), y.push_back(0.4);
  for (int k = 1; k <= 4; ++k) x.push_back(0), y.push_back(0.4 - 0.1 * k);
  const std::size_t points = x.size();
  x.insert(x.end(), y.begin(), y.end());
  std::vector<double> n0(x.size()), n(x.size()), ds(points);
  for (std::size_t k = 0; k < points; ++k)
    n0[k] = k < 4 ? 1 : k > 8 ? -1 : 0, n0[points + k] = k >= 4 && k <= 8 ? 1 : 0;
  unit_normals(Curve(x, n0), x, n);
  point_lengths(x, n, ds);
  Vec2 force = Vec2::Zero();
  for (std::size_t k = 0; k < points; ++k) force += ds[k] * vector_at(n, k);
  EXPECT_NEAR(force.x(), 0, 1e-15);
  EXPECT_NEAR(force.y(), 0.25, 1e-15);
}

TEST(Curve, RefusesNormalsThatDoNotStandOnIt) {
  const std::vector<double> x = circle(33, false);
  std::vector<double> along(x.size());
  for (std::size_t k = 0; k < 33; ++k) {
    along[k] = -x[33 + k];
    along[33 + k] = x[k];
  }
  EXPECT_THROW(Curve(x, along), std::invalid_argument);
  EXPECT_THROW(Curve(x, std::vector<double>{}), std::invalid_argument);
  EXPECT_THROW(Curve(std::vector<double>{0.0, 0.0}, std::vector<double>{1.0, 0.0}), std::invalid_argument);
}

TEST(InterfaceMotion, PredictsAnAcceleratedPathToThirdOrderPerStep) {
  const auto path = [](double t) { return std::sin(t); };
  const auto error = [&](double dt) {
    InterfaceMotion motion(1);
    motion.start(std::vector<double>{std::cos(0.5 - dt), 0.0}, {});
    motion.take(std::vector<double>{std::cos(0.5), 0.0}, dt);
    std::vector<double> next(2);
    motion.command(std::vector<double>{path(0.5), 0.0}, dt, next);
    return std::abs(next[0] - path(0.5 + dt));
  };
  EXPECT_LE(error(0.01), 1e-6);
  EXPECT_GE(std::log2(error(0.02) / error(0.01)), 2.9);
}

TEST(InterfaceMotion, FirstStepOfABodyThatSaysHowItAcceleratesIsOfThirdOrderToo) {
  const auto error = [](double dt) {  // a point that goes round
    InterfaceMotion motion(1);
    motion.start(std::vector<double>{0.0, 2.0}, std::vector<double>{-4.0, 0.0});
    std::vector<double> next(2);
    motion.command(std::vector<double>{1.0, 0.0}, dt, next);
    return std::hypot(next[0] - std::cos(2 * dt), next[1] - std::sin(2 * dt));
  };
  EXPECT_LE(error(0.01), 2e-6);
  EXPECT_GE(std::log2(error(0.02) / error(0.01)), 2.9);
}

TEST(InterfaceMotion, AccelerationIsExactWhenItGrowsLinearlyWhateverTheSteps) {
  InterfaceMotion motion(1);
  const auto velocity = [](double t) { return std::vector<double>{0.3 * t + 0.7 * t * t, -t * t}; };
  motion.start(velocity(1.0), {});
  motion.take(velocity(1.1), 0.1);
  motion.take(velocity(1.35), 0.25);
  EXPECT_NEAR(motion.a()[0], 0.3 + 1.4 * 1.35, 1e-13);
  EXPECT_NEAR(motion.a()[1], -2 * 1.35, 1e-13);
}

TEST(InterfaceMotion, UniformMotionStartsWithoutAcceleration) {
  InterfaceMotion motion(2);
  const std::vector<double> v{0.5, 0.5, -0.25, -0.25};
  motion.start(v, {});
  EXPECT_TRUE(std::ranges::all_of(motion.a(), [](double a) { return a == 0; }));
  motion.take(v, 0.1);
  EXPECT_TRUE(std::ranges::all_of(motion.a(), [](double a) { return a == 0; }));
}

TEST(PrescribedMotion, GoesAlongItsPathWithTheVelocityAndAccelerationOfThePath) {
  const PrescribedMotion motion({.position = [](double x, double y, double t) -> Vec2 {
                                  return {x + 0.5 * t + y * t * t, y + std::sin(2 * t)};
                                }},
                                points_of(
                                    3, [](double r) { return r; }, [](double r) { return 2 * r; }));
  constexpr double t = 0.3, rounding = 1e-6;
  std::vector<double> x(6), v(6), a(6);
  motion.position(t, x);
  motion.velocity(t, v);
  motion.acceleration(t, a);
  EXPECT_DOUBLE_EQ(x[1], 0.5 + 0.5 * t + t * t);
  EXPECT_DOUBLE_EQ(x[5], 2 + std::sin(2 * t));
  EXPECT_NEAR(v[2], 0.5 + 2 * 2 * t, rounding);
  EXPECT_NEAR(v[3], 2 * std::cos(2 * t), rounding);
  EXPECT_NEAR(a[1], 2, rounding);
  EXPECT_NEAR(a[4], -4 * std::sin(2 * t), rounding);
}

TEST(PrescribedMotion, IsTheSameToTheBitInOtherUnits) {
  constexpr double length = 0x1p-7, time = 0x1p11, t = 0.3;
  const Path::Position go = [](double x, double y, double s) -> Vec2 {
    return {x + 0.3 * std::sin(3 * s + y), y + s * s};
  };
  const std::vector<double> x{0, 0.5, 1, 0, 0.25, 2};
  std::vector<double> scaled = x;
  for (double& each : scaled) each *= length;
  const PrescribedMotion one({.position = go, .time_scale = 0.7}, x);
  const PrescribedMotion other({.position = [&](double a, double b, double s) -> Vec2 {
                                  return length * go(a / length, b / length, s / time);
                                },
                                .time_scale = 0.7 * time},
                               scaled);
  std::vector<double> v(6), a(6), its_v(6), its_a(6);
  one.velocity(t, v);
  one.acceleration(t, a);
  other.velocity(t * time, its_v);
  other.acceleration(t * time, its_a);
  for (std::size_t k = 0; k < v.size(); ++k) {
    EXPECT_EQ(length / time * v[k], its_v[k]);
    EXPECT_EQ(length / (time * time) * a[k], its_a[k]);
  }
}

}  // namespace
}  // namespace fsi::coupler
