/// The fluid-solid Riemann problem, in two and three dimensions.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "common/interface/riemann.hpp"

namespace fsi::coupler {
namespace {

/// Rounding of some ten operations on numbers of order one.
constexpr double rounding = 1e-13;

/// A random interface point together with the waves it was made from.
template <int D>
struct Sample {
  SolidPoint<D> solid;
  GasPoint<D> gas;
  Vector<D> n;
  Matrix<D> Y;  ///< columns: polarisation of the solid's waves
  Vector<D> z;  ///< their impedances

  NormalState projected(Projection how) const { return project<D>(solid, normal_side<D>(gas, n), n, how); }
};

template <int D>
class FluidSolidRiemannProblem : public ::testing::Test {
 protected:
  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vector<D> vector() {
    return Vector<D>::NullaryExpr([this] { return number(-1, 1); });
  }
  /// A chain of random turns in the coordinate planes.
  Matrix<D> rotation() {
    Matrix<D> Q = Matrix<D>::Identity();
    for (int i = 0; i < D; ++i) {
      for (int j = i + 1; j < D; ++j) {
        const double angle = number(-3, 3);
        const Vector<D> a = Q.col(i);
        const Vector<D> b = Q.col(j);
        Q.col(i) = std::cos(angle) * a + std::sin(angle) * b;
        Q.col(j) = std::cos(angle) * b - std::sin(angle) * a;
      }
    }
    return Q;
  }
  Sample<D> sample(double solid_scale = 1.0) {
    Sample<D> s;
    s.n = rotation().col(0);
    s.Y = rotation();
    s.z = solid_scale * (vector().array() * 0.4 + 1.0).matrix();
    s.solid = {
        .v = vector(), .w = vector(), .Z = s.Y * s.z.asDiagonal() * s.Y.transpose(), .z_p = s.z.maxCoeff()};
    s.gas = {.v = vector(), .p = number(0.5, 1.5), .p_e = number(0.5, 1.5), .z_f = number(0.5, 1.5)};
    return s;
  }
  std::vector<Sample<D>> samples() {
    std::vector<Sample<D>> all;
    for (int k = 0; k < 50; ++k) all.push_back(sample());
    return all;
  }
  /// The solid's whole interface velocity: its waves carry the traction from w_0 to w_n n.
  static Vector<D> solid_velocity(const Sample<D>& s, const NormalState& state) {
    Vector<D> v = s.solid.v;
    const Vector<D> change = state.w_n * s.n - s.solid.w;
    for (int j = 0; j < D; ++j) v += s.Y.col(j).dot(change) / s.z(j) * s.Y.col(j);
    return v;
  }

 private:
  std::mt19937_64 random_{7};
};

template <class D>
class RiemannProblem : public FluidSolidRiemannProblem<D::value> {};

using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(RiemannProblem, Dimensions);

TYPED_TEST(RiemannProblem, Eq19LiesOnTheGasCharacteristicInBothProjections) {
  for (const auto& s : this->samples()) {
    for (const Projection how : {Projection::full, Projection::simplified}) {
      const NormalState state = s.projected(how);
      const double p = s.gas.p_e - state.w_n;
      EXPECT_NEAR(p - s.gas.z_f * state.v_n, s.gas.p - s.gas.z_f * s.n.dot(s.gas.v), rounding);
    }
  }
}

TYPED_TEST(RiemannProblem, Eq20Eq24LiesOnEveryCharacteristicOfTheSolidAndMovesWithIt) {
  for (const auto& s : this->samples()) {
    const NormalState state = s.projected(Projection::full);
    const auto v = this->solid_velocity(s, state);
    EXPECT_NEAR(s.n.dot(v), state.v_n, rounding);  // both sides move together along the normal
    for (int j = 0; j < s.z.size(); ++j) {
      const auto y = s.Y.col(j);
      const double after = state.w_n * y.dot(s.n) - s.z(j) * y.dot(v);
      const double before = y.dot(s.solid.w) - s.z(j) * y.dot(s.solid.v);
      EXPECT_NEAR(after, before, rounding);
    }
  }
}

TYPED_TEST(RiemannProblem, Eq12WavesThatLeaveCarryThePowerOfTheWavesThatCame) {
  // A wave of amplitude r on a characteristic of impedance z carries the power r^2 / (4 z). With equal normal
  // velocity and traction on both sides, and no tangential
  // traction, the interface neither stores nor makes any.
  for (const auto& s : this->samples()) {
    const NormalState state = s.projected(Projection::full);
    const auto v = this->solid_velocity(s, state);
    const double gas_w = s.gas.p_e - s.gas.p;
    const double gas_in = gas_w + s.gas.z_f * s.n.dot(s.gas.v);
    const double gas_out = state.w_n - s.gas.z_f * state.v_n;
    double power = (gas_in * gas_in - gas_out * gas_out) / (4 * s.gas.z_f);
    for (int j = 0; j < s.z.size(); ++j) {
      const auto y = s.Y.col(j);
      const double in = y.dot(s.solid.w) - s.z(j) * y.dot(s.solid.v);
      const double out = state.w_n * y.dot(s.n) + s.z(j) * y.dot(v);
      power += (in * in - out * out) / (4 * s.z(j));
    }
    EXPECT_NEAR(power, 0.0, 10 * rounding);
  }
}

TYPED_TEST(RiemannProblem, Eq28DoesNotDependOnTheDirectionOfTheAxes) {
  for (const auto& s : this->samples()) {
    const auto Q = this->rotation();
    auto turned = s;
    turned.n = Q * s.n;
    turned.solid.v = Q * s.solid.v;
    turned.solid.w = Q * s.solid.w;
    turned.solid.Z = Q * s.solid.Z * Q.transpose();
    turned.gas.v = Q * s.gas.v;
    for (const Projection how : {Projection::full, Projection::simplified, Projection::traditional}) {
      EXPECT_NEAR(turned.projected(how).v_n, s.projected(how).v_n, rounding);
      EXPECT_NEAR(turned.projected(how).w_n, s.projected(how).w_n, rounding);
    }
  }
}

TYPED_TEST(RiemannProblem, Eq28EqualStatesStayAsTheyAre) {
  for (auto s : this->samples()) {
    s.solid.v = s.gas.v;
    s.solid.w = (s.gas.p_e - s.gas.p) * s.n;
    const double v_n = s.n.dot(s.gas.v);
    const double w_n = s.gas.p_e - s.gas.p;
    EXPECT_NEAR(s.projected(Projection::full).v_n, v_n, rounding);
    EXPECT_NEAR(s.projected(Projection::full).w_n, w_n, rounding);
    s.solid.w.setZero();
    s.gas.p = s.gas.p_e;
    EXPECT_NEAR(s.projected(Projection::full).v_n, v_n, 1e-15);  // uniform motion: only n.v itself is rounded
    EXPECT_NEAR(s.projected(Projection::simplified).v_n, v_n, 1e-15);
    EXPECT_NEAR(s.projected(Projection::simplified).w_n, 0.0, 1e-15);
  }
}

TYPED_TEST(RiemannProblem, Eq29IsTheFullProjectionOfAnIsotropicSolidWithoutTangentialTraction) {
  for (auto s : this->samples()) {
    s.solid.Z = s.solid.z_p * s.solid.Z.Identity();
    s.solid.w = s.n.dot(s.solid.w) * s.n;
    const NormalState full = s.projected(Projection::full);
    const NormalState simplified = s.projected(Projection::simplified);
    EXPECT_NEAR(simplified.v_n, full.v_n, rounding);
    EXPECT_NEAR(simplified.w_n, full.w_n, rounding);
  }
}

TYPED_TEST(RiemannProblem, Eq29IsTheImpedanceWeightedAverageOfTheTwoSides) {
  for (auto s : this->samples()) {
    const double z = s.solid.z_p;
    const double gas_v = s.n.dot(s.gas.v);
    s.solid.w = (s.gas.p_e - s.gas.p) * s.n;  // equal tractions: the velocity is the plain weighted mean
    const NormalState state = s.projected(Projection::simplified);
    EXPECT_NEAR((z + s.gas.z_f) * state.v_n, z * s.n.dot(s.solid.v) + s.gas.z_f * gas_v, rounding);
  }
}

TYPED_TEST(RiemannProblem, Eq28AVeryHeavySolidIsAMovingWall) {
  for (int k = 0; k < 20; ++k) {
    auto s = this->sample(1e12);
    const double v_n = s.n.dot(s.solid.v);
    const NormalState state = s.projected(Projection::full);
    EXPECT_NEAR(state.v_n, v_n, 1e-11);  // up to the ratio of the impedances
    EXPECT_NEAR(state.w_n, at_wall(v_n, normal_side(s.gas, s.n)).w_n, 1e-11);
  }
}

TYPED_TEST(RiemannProblem, Eq28AVeryLightSolidIsAFreeSurfaceMovedByTheGas) {
  for (int k = 0; k < 20; ++k) {
    auto s = this->sample(1e-12);
    s.solid.w *= 1e-12;  // a light solid bears no load
    const NormalState state = s.projected(Projection::full);
    EXPECT_NEAR(state.w_n, 0.0, 1e-11);
    EXPECT_NEAR(state.v_n, s.n.dot(s.gas.v) + (s.gas.p_e - s.gas.p) / s.gas.z_f, 1e-11);
  }
}

TYPED_TEST(RiemannProblem, TraditionalTakesVelocityFromTheSolidAndTractionFromTheGas) {
  for (const auto& s : this->samples()) {
    const NormalState state = s.projected(Projection::traditional);
    EXPECT_EQ(state.v_n, s.n.dot(s.solid.v));
    EXPECT_EQ(state.w_n, s.gas.p_e - s.gas.p);
  }
}

/// The paper's own road in two dimensions: reference frame, rotation R, angle theta.
class InAngles : public FluidSolidRiemannProblem<2> {
 protected:
  struct Road {
    double c = 0, s = 0, z_p = 0, z_s = 0;  ///< (25) and the scaled impedances of (23)
    double v1 = 0, v2 = 0, w1 = 0, w2 = 0;  ///< solid in the frame (n, t)
    double z_hat() const { return z_p * z_s / (c * c * z_s + s * s * z_p); }
    double k_hat() const { return s * c * (z_p - z_s) / (c * c * z_s + s * s * z_p); }
  };

  static Road road_of(const Sample<2>& sample) {
    const Vector<2> t(-sample.n.y(), sample.n.x());
    const int p = sample.z(0) > sample.z(1) ? 0 : 1;
    const Vector<2> y_p = sample.Y.col(p);
    return {.c = sample.n.dot(y_p),
            .s = t.dot(y_p),
            .z_p = sample.z(p),
            .z_s = sample.z(1 - p),
            .v1 = sample.n.dot(sample.solid.v),
            .v2 = t.dot(sample.solid.v),
            .w1 = sample.n.dot(sample.solid.w),
            .w2 = t.dot(sample.solid.w)};
  }
};

TEST_F(InAngles, Eq27ImpedanceMatrixGivesTheImpedanceOfTheAngleFormula) {
  for (const Sample<2>& s : samples()) {
    const Road road = road_of(s);
    const NormalSide side = normal_side<2>(s.solid, s.n);
    EXPECT_NEAR(side.z, road.z_hat(), rounding);
    EXPECT_NEAR(side.w_n, road.w1 - road.k_hat() * road.w2, rounding);
  }
}

TEST_F(InAngles, Eq25PolarisationAlongTheNormalLeavesThePWaveAlone) {
  // theta = 0: neither the s-wave nor the tangential traction matters.
  for (Sample<2> s : samples()) {
    const Vector<2> t(-s.n.y(), s.n.x());
    s.solid.Z = 1.7 * s.n * s.n.transpose() + 0.4 * t * t.transpose();
    const NormalState state = s.projected(Projection::full);
    s.solid.w += 0.9 * t;
    s.solid.v -= 0.3 * t;
    s.solid.Z += 0.2 * t * t.transpose();
    EXPECT_NEAR(s.projected(Projection::full).v_n, state.v_n, rounding);
    EXPECT_NEAR(s.projected(Projection::full).w_n, state.w_n, rounding);
    EXPECT_NEAR(normal_side<2>(s.solid, s.n).z, 1.7, rounding);
  }
}

TEST_F(InAngles, Eq26HoldsBetweenThePredictedAndTheProjectedState) {
  for (const Sample<2>& s : samples()) {
    const Road road = road_of(s);
    const NormalState state = s.projected(Projection::full);
    EXPECT_NEAR(state.w_n - road.z_hat() * state.v_n,
                road.w1 - road.k_hat() * road.w2 - road.z_hat() * road.v1, rounding);
  }
}

TEST_F(InAngles, Eq28EqualsTheFormulasOfThePaper) {
  for (const Sample<2>& s : samples()) {
    const Road road = road_of(s);
    const double z = road.z_hat();
    const double z0 = s.gas.z_f;
    const double v0 = s.n.dot(s.gas.v);
    const double w0 = s.gas.p_e - s.gas.p;
    const double k = road.k_hat() * road.w2;
    const double v_n = (z * road.v1 + z0 * v0 + w0 - road.w1 + k) / (z + z0);
    const double w_n = (road.w1 / z + w0 / z0 + v0 - road.v1 - k / z) / (1 / z + 1 / z0);
    EXPECT_NEAR(s.projected(Projection::full).v_n, v_n, rounding);
    EXPECT_NEAR(s.projected(Projection::full).w_n, w_n, rounding);
  }
}

TEST_F(InAngles, Eq21Eq22Eq23RelationsOfTheReferenceFrameHoldAfterTheTurnToTheDeformedFrame) {
  // A point described in the reference frame (n0, t0): waves
  // y_j, z_j of unit reference area, components of v and P.
  const double eta = 0.7;
  for (int k = 0; k < 50; ++k) {
    const Matrix<2> reference = rotation();  // columns n0, t0
    const Matrix<2> deformed = rotation();   // columns n, t
    const Matrix<2> R = deformed.transpose() * reference;
    const Matrix<2> y = rotation();
    const Vector<2> z(number(1, 2), number(0.3, 0.9));
    const Vector<2> v_bar = vector();
    const Vector<2> w_bar = vector();

    Sample<2> s;
    s.n = deformed.col(0);
    s.solid = {
        .v = deformed * R * v_bar, .w = eta * deformed * R * w_bar, .Z = Matrix<2>::Zero(), .z_p = 1.0};
    s.solid.Z = eta * reference * y * z.asDiagonal() * y.transpose() * reference.transpose();
    s.gas = {.v = vector(), .p = number(0.5, 1.5), .p_e = 1.0, .z_f = number(0.5, 1.5)};
    const NormalState state = s.projected(Projection::full);

    // Back in the reference frame both relations of (20) must hold with the same tangential velocity.
    const Vector<2> w_I = R.transpose() * Vector<2>(state.w_n, 0) / eta;
    const Vector<2> known = R.transpose() * Vector<2>(state.v_n, 0);
    const Vector<2> along = R.transpose() * Vector<2>(0, 1);
    Vector<2> tangential;
    for (int j = 0; j < 2; ++j) {
      const Vector<2> y_j = y.col(j);
      const double residual = y_j.dot(w_I - w_bar) - z(j) * y_j.dot(known - v_bar);
      tangential(j) = residual / (z(j) * y_j.dot(along));
    }
    EXPECT_NEAR(tangential(0), tangential(1),
                rounding * (1 + 1 / std::abs(y.col(0).dot(along) * y.col(1).dot(along))));
  }
}

}  // namespace
}  // namespace fsi::coupler
