// Loops over the points of a side: what they find is held against the relations it has to fulfil.

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/types.hpp"
#include "solid_solver/boundary/traction_ghost.hpp"
#include "solid_solver/kernels/side_rows.hpp"
#include "solid_solver/laws/neo_hookean.hpp"
#include "solid_solver/laws/saint_venant_kirchhoff.hpp"

namespace fsi::solid {
namespace {

constexpr int n = 21;  // no multiple of any vector's length
constexpr double spacing = 0.05;

/// Points of a side, each with a normal and a stretch of its own.
class Points {
 public:
  Points() : field_(Layout(n, SideRows::count), 1), rows_{field_.view()} {
    for (int k = 0; k < n; ++k) {
      const double angle = 0.3 * k, sign = k % 2 == 0 ? 1.0 : -1.0;
      rows_[SideRows::normal1][k] = std::cos(angle);
      rows_[SideRows::normal2][k] = std::sin(angle);
      rows_[SideRows::across1][k] = sign * std::cos(angle) / spacing;
      rows_[SideRows::across2][k] = sign * std::sin(angle) / spacing;
      rows_[SideRows::size][k] = 1 / spacing;
      rows_[SideRows::scale][k] = sign * spacing;
      rows_.F().set(k, 1 + 0.1 * std::sin(k), 0.08 * std::cos(k), -0.05 * std::sin(2 * k),
                    1 - 0.1 * std::cos(k));
      rows_[SideRows::open][k] = 1;
    }
  }
  const SideRows& rows() const { return rows_; }
  Vec2 normal(int k) const { return {rows_[SideRows::normal1][k], rows_[SideRows::normal2][k]}; }
  /// F with a derivative across of point k.
  Tensor2 strained(int k, const Vec2& d) const {
    return plus_dyad(rows_.F().at(k), d, {rows_[SideRows::across1][k], rows_[SideRows::across2][k]});
  }
  void ask(int k, const Vec2& T) const {
    rows_[SideRows::T1][k] = T.x();
    rows_[SideRows::T2][k] = T.y();
  }
  Vec2 found(int k) const { return {rows_[SideRows::d1][k], rows_[SideRows::d2][k]}; }
  double open(int k) const { return rows_[SideRows::open][k]; }

 private:
  Field field_;
  SideRows rows_;
};

TEST(Eq43MatchTractions, FindsTheTractionOfEveryPoint) {
  const NeoHookean law{.lambda = 1.2, .mu = 0.8};
  const Points points;
  for (int k = 0; k < n; ++k) {
    const Vec2 d = 0.2 * spacing * Vec2(std::sin(5.0 * k), std::cos(3.0 * k));
    points.ask(k, traction_of(law.P(points.strained(k, d)), points.normal(k)));
  }
  match_tractions(law, points.rows());
  for (int k = 0; k < n; ++k) {
    EXPECT_EQ(points.open(k), 0) << k;
    const Vec2 there = traction_of(law.P(points.strained(k, points.found(k))), points.normal(k));
    const Vec2 asked(points.rows()[SideRows::T1][k], points.rows()[SideRows::T2][k]);
    EXPECT_NEAR((there - asked).norm(), 0, 1e-14) << k;
  }
}

TEST(Eq43MatchTractions, LeavesPointsThatNeedCareToTheSearchPointByPoint) {
  // In uniaxial strain this law bears at most (lambda + 2 mu) / sqrt(27) = 0.54.
  const SaintVenantKirchhoff law{.lambda = 1.2, .mu = 0.8};
  const Points points;
  for (int k = 0; k < n; ++k) points.ask(k, k == 7 ? -2.0 * points.normal(k) : Vec2(Vec2::Zero()));
  points.rows()[SideRows::next1][3] = -2 * points.rows()[SideRows::scale][3] * points.normal(3).x();
  points.rows()[SideRows::next2][3] =
      -2 * points.rows()[SideRows::scale][3] * points.normal(3).y();  // inside out
  match_tractions(law, points.rows());
  for (int k = 0; k < n; ++k) {
    if (k == 3 || k == 7) {
      EXPECT_NE(points.open(k), 0) << k;
    } else {
      EXPECT_EQ(points.open(k), 0) << k;
    }
  }
}

/// w J F^-1 of a plane tensor, by components.
Tensor2 pressed_stress(double w, const Tensor2& F) {
  return {w * F.a22, -w * F.a12, -w * F.a21, w * F.a11};
}

/// Loads and gaps of the points.
void set_gaps(const Points& points, double load) {
  for (int k = 0; k < n; ++k) {
    const Vec2 n0 = points.normal(k);
    points.ask(k, traction_of(pressed_stress(load, points.rows().F().at(k)), n0));
    points.rows()[SideRows::gap1][k] = 0.02 * std::sin(3.0 * k);
    points.rows()[SideRows::gap2][k] = 0.03 * std::cos(2.0 * k);
    points.rows().P().set(k, 1, 2, 3, 4);
  }
}

TEST(Eq43PressedGaps, GiveTheTangentialStressThatAPressureHasWithTheDerivativeFromInside) {
  constexpr double w = -1.7;
  const Points points;
  set_gaps(points, w);
  add_pressed_gaps(points.rows());
  for (int k = 0; k < n; ++k) {
    const Vec2 n0 = points.normal(k), t0(-n0.y(), n0.x());
    const Vec2 gap(points.rows()[SideRows::gap1][k], points.rows()[SideRows::gap2][k]);
    const Tensor2 F = points.rows().F().at(k), inside = plus_dyad(F, gap, n0);
    const Tensor2 change = minus(points.rows().P().at(k), {1, 2, 3, 4});
    const Tensor2 expected = minus(pressed_stress(w, inside), pressed_stress(w, F));
    EXPECT_NEAR((traction_of(change, t0) - traction_of(expected, t0)).norm(), 0, 1e-14) << k;
    EXPECT_NEAR(traction_of(change, n0).norm(), 0, 1e-14) << k;
  }
}

TEST(Eq43PressedGaps, LeaveSidesAlonePulledOrUnloaded) {
  for (const double w : {0.0, 0.4}) {
    const Points points;
    set_gaps(points, w);
    add_pressed_gaps(points.rows());
    for (int k = 0; k < n; ++k) EXPECT_EQ(points.rows().P().a12[k], 2) << w << ", " << k;
  }
}

TEST(Eq43MatchTractions, LeavesPointsAloneThatAreNotAsked) {
  const NeoHookean law{.lambda = 1.2, .mu = 0.8};
  const Points points;
  points.rows()[SideRows::open][4] = 0;
  points.rows()[SideRows::d1][4] = 0.25;
  match_tractions(law, points.rows());
  EXPECT_EQ(points.open(4), 0);
  EXPECT_EQ(points.found(4).x(), 0.25);
}

TEST(Eq23Impedance, OfAllPointsIsTheRootOfTheAcousticMatrixTimesTheDensity) {
  constexpr double rho = 1.7;
  const NeoHookean law{.lambda = 1.2, .mu = 0.8};
  const Points points;
  find_impedances(law, points.rows(), rho);
  for (int k = 0; k < n; ++k) {
    Mat2 Z;
    Z << points.rows()[SideRows::B11][k], points.rows()[SideRows::B12][k], points.rows()[SideRows::B12][k],
        points.rows()[SideRows::B22][k];
    const Mat2 B = matrix(acoustic_matrix(law.K(points.rows().F().at(k)), points.normal(k)));
    EXPECT_NEAR((Z * Z - rho * B).norm(), 0, 1e-13) << k;
  }
}

}  // namespace
}  // namespace fsi::solid
