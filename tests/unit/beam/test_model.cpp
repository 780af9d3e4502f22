/// The mechanics of a beam at rest and its small vibrations.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "beams.hpp"

namespace fsi::beam {
namespace {

using namespace testing;

/// Some state far from rest.
Eigen::VectorXd bent(const BeamModel& model) {
  Eigen::VectorXd u(model.freedoms());
  for (Eigen::Index k = 0; k < u.size(); ++k) u[k] = 0.2 * std::sin(1.7 * static_cast<double>(k) + 0.3);
  return u;
}

const Section thick{.EA = 3, .GA = 1.1, .EI = 0.2, .mass = 1, .inertia = 0.05};

TEST(BeamModel, ItsForceIsTheGradientOfItsEnergyAndItsStiffnessThatOfItsForce) {
  for (const BeamModel& model : {straight(thick, 4), ring(thick, 0.7, 5)}) {
    const Eigen::VectorXd u = bent(model), force = model.internal_force(u);
    const Eigen::MatrixXd K(model.stiffness(u));
    constexpr double step = 1e-6;
    for (Eigen::Index k = 0; k < u.size(); ++k) {
      Eigen::VectorXd up = u, down = u;
      up[k] += step;
      down[k] -= step;
      EXPECT_NEAR(force[k], -(model.strain_energy(up) - model.strain_energy(down)) / (2 * step), 1e-8);
      const Eigen::VectorXd column = (model.internal_force(down) - model.internal_force(up)) / (2 * step);
      EXPECT_LE((K.col(k) - column).norm(), 1e-7);
    }
    EXPECT_LE((K - K.transpose()).norm(), 1e-15 * K.norm());
  }
}

TEST(BeamModel, ATurnOfTheWholeStrainsNothing) {
  for (const BeamModel& model : {straight(thick, 4), ring(thick, 0.7, 5)}) {
    constexpr double angle = 2.1;
    Eigen::VectorXd u(model.freedoms());
    for (int node = 0; node < model.nodes(); ++node) {
      const Vec2 x = model.line().x[static_cast<std::size_t>(node)];
      const Vec2 turned(std::cos(angle) * x.x() - std::sin(angle) * x.y() + 3,
                        std::sin(angle) * x.x() + std::cos(angle) * x.y());
      u.segment<2>(freedom_of(node)) = turned - x;
      u[3 * node + 2] = angle;
    }
    EXPECT_LE(model.strain_energy(u), 1e-28);
    EXPECT_LE(model.internal_force(u).norm(), 1e-13);
  }
}

TEST(BeamModel, ACantileverUnderASmallLoadHasTheDeflectionOfTimoshenkoWithAnyNumberOfElements) {
  for (const int elements : {1, 2, 7}) {
    Section massless = thick;
    massless.mass = massless.inertia = 0;
    const BeamModel model = straight(massless, elements);
    constexpr double load = 1e-7;
    const BeamMotion tip = at_rest(model, cantilever, on_tip(model, 1, load));
    const double exact = load * (1 / (3 * thick.EI) + 1 / thick.GA);
    EXPECT_NEAR(tip.u()[model.freedoms() - 2] / exact, 1, 1e-9);
  }
}

/// Tip of the elastica of length and bending stiffness 1 under an end load P across it, by shooting with fine
/// Runge-Kutta steps: theta'' = -P cos(theta), theta(0) = 0, theta'(1) = 0.
Vec2 elastica_tip(double P) {
  const auto shoot = [&](double kappa, Vec2& tip) {
    constexpr int steps = 4000;
    constexpr double h = 1.0 / steps;
    double theta = 0, rate = kappa;
    tip.setZero();
    for (int k = 0; k < steps; ++k) {
      const double a = -P * std::cos(theta);
      const double theta_mid = theta + h / 2 * rate + h * h / 8 * a, b = -P * std::cos(theta_mid);
      const double theta_end = theta + h * rate + h * h / 2 * b, c = -P * std::cos(theta_end);
      tip += h / 6 *
             (Vec2(std::cos(theta), std::sin(theta)) + 4 * Vec2(std::cos(theta_mid), std::sin(theta_mid)) +
              Vec2(std::cos(theta_end), std::sin(theta_end)));
      theta += h * rate + h * h / 6 * (a + 2 * b);
      rate += h / 6 * (a + 4 * b + c);
    }
    return rate;
  };
  double low = 0, high = P;
  Vec2 tip;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (shoot(middle, tip) > 0 ? high : low) = middle;
  }
  return tip;
}

TEST(BeamModel, ACantileverBentFarIsTheElastica) {
  const Vec2 exact = elastica_tip(10);
  EXPECT_NEAR(1 - exact.x(), 0.55500, 1e-5);  // Mattiasson's table (1981)
  EXPECT_NEAR(exact.y(), 0.81061, 1e-5);
  const auto error = [&](int elements) {
    const BeamModel model = straight(slender(), elements);
    const BeamMotion tip = at_rest(model, cantilever, on_tip(model, 1, 10), 20);
    return (Vec2(1, 0) + tip.u().segment<2>(model.freedoms() - 3) - exact).norm();
  };
  const double coarse = error(20), fine = error(40);
  note("elastica, P L^2/EI = 10, 40 elements: tip over L", fine, coarse);
  EXPECT_LE(fine, 1e-4);
  EXPECT_GE(std::log2(coarse / fine), 1.9);
}

TEST(BeamModel, AnEndMomentRollsItUpToACircle) {
  const BeamModel model = straight(slender(), 20);
  const BeamMotion rolled = at_rest(model, cantilever, on_tip(model, 2, 2 * pi), 20);
  const double open = (Vec2(1, 0) + rolled.u().segment<2>(model.freedoms() - 3)).norm();
  note("bar rolled up by an end moment 2 pi EI/L, 20 elements: gap over L", open);
  EXPECT_LE(open, 1e-6);  // strains of 1e-8
  EXPECT_NEAR(rolled.u()[model.freedoms() - 1], 2 * pi, 1e-6);
  const Resultants middle = model.resultants(rolled.u(), 10);
  EXPECT_NEAR(middle.M, 2 * pi, 1e-6);
  EXPECT_NEAR(middle.Q, 0, 1e-6);
}

TEST(BeamModel, UnderAUniformLoadItsForcesAndMomentAreOfSecondOrderUpToItsEnds) {
  constexpr double load = 1e-7;
  for (const double s : {0.0, 0.33, 0.5, 1.0}) {
    const auto errors = [&](int elements) {
      const BeamModel model = straight(thick, elements);
      const std::vector<Vec2> uniform(static_cast<std::size_t>(model.nodes()), Vec2(0, load));
      Section massless = thick;
      massless.mass = massless.inertia = 0;
      const BeamMotion bent = at_rest(straight(massless, elements), cantilever, model.nodal_load(uniform));
      const Resultants at = model.resultants_at(bent.u(), s * elements);
      return std::array{std::abs(at.Q / load - (1 - s)), std::abs(at.M / load - (1 - s) * (1 - s) / 2)};
    };
    const auto coarse = errors(10), fine = errors(20);
    for (const std::size_t k : {0U, 1U}) {
      EXPECT_LE(coarse[k], 5e-3) << "at " << s;
      EXPECT_LE(fine[k], coarse[k] / 3.5 + 1e-6) << "at " << s;
    }
  }
}

TEST(BeamModel, AtANodeItsForcesAndAngleAreTheSameFromBothDirections) {
  constexpr double close = 1e-12;
  for (const BeamModel& model : {straight(thick, 4), ring(thick, 0.7, 5)}) {
    const Eigen::VectorXd u = bent(model);
    const int n = model.elements();
    for (int node = model.line().closed ? 0 : 1; node < n; ++node) {
      const double before = (node > 0 ? node : n) - close, after = node + close;
      const Resultants a = model.resultants_at(u, before), b = model.resultants_at(u, after);
      for (const double jump : {a.N - b.N, a.Q - b.Q, a.M - b.M}) EXPECT_NEAR(jump, 0, 1e-10);
      EXPECT_NEAR(std::remainder(model.angle_at(before) - model.angle_at(after), 2 * pi), 0, 1e-10);
    }
    for (int element = 0; element < n; ++element) {
      EXPECT_NEAR(model.resultants_at(u, element + 0.5).M, model.resultants(u, element).M, 1e-13);
      EXPECT_NEAR(model.angle_at(element + 0.5), model.angle(element), 1e-13);
    }
  }
}

TEST(BeamModel, ThatOfOneElementHasItsForcesEverywhere) {
  const BeamModel model = straight(thick, 1);
  const Eigen::VectorXd u = bent(model);
  for (const double s : {0.0, 0.3, 1.0}) EXPECT_EQ(model.resultants_at(u, s).M, model.resultants(u, 0).M);
}

TEST(PlateStress, MakesTheForcesOfItsSectionAndNoMomentOnAnyPartOfIt) {
  constexpr double d = 0.2, angle = 0.4, theta = 1.1;
  const Resultants force{.N = 0.3, .Q = -0.7, .M = 0.05};
  const Eigen::Rotation2Dd turn(theta), section(angle);
  constexpr int parts = 400;
  Vec2 sum = Vec2::Zero();
  double moment = 0;
  for (int k = 0; k < parts; ++k) {
    const double y = d * ((k + 0.5) / parts - 0.5);
    const Mat2 P = plate_stress(d, force, y, angle, theta);
    const Vec2 pull = (turn * section).inverse() * (P.transpose() * (section * Vec2(1, 0)));
    sum += d / parts * pull;
    moment -= d / parts * y * pull[0];
    const Mat2 FP = turn * P;  // of a section that does not strain
    EXPECT_NEAR(FP(0, 1), FP(1, 0), 1e-13);
  }
  EXPECT_LE((sum - Vec2(force.N, force.Q)).norm(), 1e-5);
  EXPECT_NEAR(moment, force.M, 1e-6);
  const Mat2 outline = plate_stress(d, force, d / 2, angle, theta);
  EXPECT_LE((outline.transpose() * (section * Vec2(0, 1))).norm(), 1e-13);
}

/// Angular frequencies in ascending order, from the stiffness at u.
Eigen::VectorXd frequencies(const BeamModel& model, const std::array<End, 2>& ends) {
  const Eigen::SparseMatrix<double> B = free_motions(model.line(), ends);
  const Eigen::MatrixXd K(B.transpose() * model.stiffness(Eigen::VectorXd::Zero(model.freedoms())) * B);
  const Eigen::MatrixXd M = B.transpose() * model.mass().asDiagonal() * B;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(K, M, Eigen::EigenvaluesOnly);
  return modes.eigenvalues().cwiseMax(0).cwiseSqrt();
}

TEST(BeamModel, AHingedBeamHasTheFrequenciesOfTimoshenko) {
  const Section section = plate_section(1.3, 2, 1, 0.1);
  const auto exact = [&](int n) {  // slower root of the frequency equation
    const double k = n * pi, a = section.mass * section.inertia / section.GA;
    const double b = section.mass + (section.inertia + section.mass * section.EI / section.GA) * k * k;
    return std::sqrt((b - std::sqrt(b * b - 4 * a * section.EI * std::pow(k, 4))) / (2 * a));
  };
  const auto error = [&](int elements, int n) {
    const Eigen::VectorXd found = frequencies(straight(section, elements), hinged);
    return (found.array() / exact(n) - 1).abs().minCoeff();
  };
  for (const int n : {1, 2, 3}) {
    note(fmt::format("hinged Timoshenko beam, 60 elements: frequency {}", n), error(60, n), error(30, n));
    EXPECT_LE(error(60, n), 1e-3) << "mode " << n;
  }
  EXPECT_GE(std::log2(error(30, 3) / error(60, 3)), 1.9);
}

TEST(BeamModel, AThinCantileverHasTheFrequenciesOfEulerAndBernoulli) {
  Section section = slender(0.7);
  section.inertia = 1e-9;
  const Eigen::VectorXd found = frequencies(straight(section, 60), cantilever);
  const double unit = std::sqrt(section.EI / section.mass);
  for (const auto& [k, root] : {std::pair{0, 1.8751041}, {1, 4.6940911}}) {
    const double error = std::abs(found[k] / (root * root * unit) - 1);
    note(fmt::format("thin cantilever, 60 elements: frequency {}", k + 1), error);
    EXPECT_LE(error, 1e-3);
  }
}

TEST(BeamModel, ARingHasThreeRigidMotionsAndItsFrequenciesOfBending) {
  const Section section{.EA = 1e6, .GA = 1e6, .EI = 1, .mass = 0.7, .inertia = 1e-6};
  constexpr double R = 0.8;
  const Eigen::VectorXd found = frequencies(ring(section, R, 80), loose);
  const auto exact = [&](double n) {  // without stretch, A. E. H. Love
    return n * (n * n - 1) / std::sqrt(n * n + 1) * std::sqrt(section.EI / section.mass) / (R * R);
  };
  note("ring, 80 elements: frequency of two waves", std::abs(found[3] / exact(2) - 1));
  EXPECT_LE(found[2], 1e-3 * exact(2));
  for (const int k : {3, 4}) EXPECT_NEAR(found[k] / exact(2), 1, 2e-3);
  for (const int k : {5, 6}) EXPECT_NEAR(found[k] / exact(3), 1, 5e-3);
}

TEST(BeamModel, ARingUnderPressureBecomesSmallerByItsHoopStrain) {
  constexpr double R = 0.8, p = 1e-5;
  const BeamModel model = ring(thick, R, 64);
  std::vector<Vec2> push;
  for (const Vec2& x : model.line().x) push.emplace_back(-p * x.normalized());
  // Rigid motions are free: a little mass holds them.
  Section heavy = thick;
  heavy.mass = 1e-6;
  const BeamModel with_mass = ring(heavy, R, 64);
  const BeamMotion pressed = at_rest(with_mass, loose, model.nodal_load(push));
  for (int node = 0; node < 64; ++node) {
    const Vec2 out = model.line().x[static_cast<std::size_t>(node)].normalized();
    EXPECT_NEAR(out.dot(pressed.u().segment<2>(freedom_of(node))) / (-p * R * R / thick.EA), 1, 2e-3);
  }
  note("ring under pressure, 64 elements: hoop force",
       std::abs(model.resultants(pressed.u(), 5).N / (-p * R) - 1));
  EXPECT_NEAR(model.resultants(pressed.u(), 5).N / (-p * R), 1, 2e-3);
}

/// Smallest stiffness of a beam under an axial load.
double smallest_stiffness(double load, const std::array<End, 2>& ends, int elements = 60) {
  const BeamModel model = straight(slender(), elements);
  const BeamMotion pressed = at_rest(model, cantilever, on_tip(model, 0, -load));  // stays straight
  const Eigen::SparseMatrix<double> B = free_motions(model.line(), ends);
  const Eigen::MatrixXd K(B.transpose() * model.stiffness(pressed.u()) * B);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

TEST(BeamModel, ItBucklesUnderEulersLoad) {
  for (const auto& [ends, critical] : {std::pair{cantilever, pi * pi / 4}, std::pair{hinged, pi * pi}}) {
    EXPECT_GT(smallest_stiffness(0.998 * critical, ends), 0);
    EXPECT_LT(smallest_stiffness(1.002 * critical, ends), 0);
  }
  note("Euler's loads, cantilever and hinged, 60 elements: bracketed to", 2e-3);
}

TEST(BeamModel, NoTensionMakesItYieldHoweverFewItsElements) {
  for (const int elements :
       {2, 5, 20}) {  // what they bend between their nodes counts as 12 EI / l^2 of shear stiffness
    double before = 0;
    for (const double times : {0.0, 0.5, 2.0, 20.0, 2000.0}) {
      const double stiffness = smallest_stiffness(-times * 12 * elements * elements, hinged, elements);
      EXPECT_GE(stiffness, 0.999 * before) << elements << " elements, " << times;
      EXPECT_GT(stiffness, 0);
      before = stiffness;
    }
  }
}

TEST(BeamModel, AStripUnderTensionVibratesAsAString) {
  constexpr double tension = 1e6, mass = 0.7;
  const auto error = [&](int elements, int n) {
    Section section = slender(mass);
    section.EI = 1e-3;
    section.inertia = 1e-12;
    const BeamModel model = straight(section, elements);
    const BeamMotion pulled = at_rest(model, cantilever, on_tip(model, 0, tension));
    const Eigen::SparseMatrix<double> B = free_motions(model.line(), hinged);
    const Eigen::MatrixXd K(B.transpose() * model.stiffness(pulled.u()) * B);
    const Eigen::MatrixXd M = B.transpose() * model.mass().asDiagonal() * B;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(K, M, Eigen::EigenvaluesOnly);
    const double exact = n * pi * std::sqrt(tension / mass / (1 + tension / section.EA));
    return (modes.eigenvalues().cwiseMax(0).cwiseSqrt().array() / exact - 1).abs().minCoeff();
  };
  for (const int n : {1, 2, 3}) {
    note(fmt::format("strip under tension, 40 elements: frequency {} of a string", n), error(40, n),
         error(20, n));
    EXPECT_GE(std::log2(error(20, n) / error(40, n)), 1.9) << n;
    EXPECT_LE(error(40, n), 3e-3) << n;
  }
}

TEST(BeamModel, AThinStripUnderAUniformLoadIsAMembraneWithFewElements) {
  Section section = slender();
  section.EI = 1e-2;
  constexpr double load = 2e4;
  const double exact =
      std::cbrt(3 * load / (64 * section.EA));  // a flat parabola, of the stretch that its tension makes
  const auto error = [&](int elements) {
    const BeamModel model = straight(section, elements);
    const std::vector<Vec2> push(model.line().x.size(), Vec2(0, load));
    BeamMotion blown(model, {End::clamped, End::clamped});
    constexpr int steps = 60;
    for (int k = 1; k <= steps; ++k)
      blown.advance(1, std::pow(1.5, k - steps) * model.nodal_load(push), nullptr);
    const double N = model.resultants(blown.u(), elements / 2).N;
    EXPECT_GT(N, 100 * 12 * section.EI * elements * elements);
    return std::abs(blown.u()[3 * (elements / 2) + 1] / exact - 1);
  };
  note("membrane, 20 elements: deflection under a uniform load", error(20), error(10));
  EXPECT_LE(error(10), 2e-2);
  EXPECT_LE(error(20), 6e-3);
}

}  // namespace
}  // namespace fsi::beam
