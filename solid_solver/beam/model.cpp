#include "solid_solver/beam/model.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace fsi::beam {

namespace {

constexpr double shear_correction = 5.0 / 6;

/// Components along and across a section at `angle`.
Vec2 in_section(double angle, const Vec2& d) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * d.x() + s * d.y(), -s * d.x() + c * d.y()};
}

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

}  // namespace

Section plate_section(double rho, double lambda, double mu, double d) {
  const double E = 4 * mu * (lambda + mu) / (lambda + 2 * mu);  // E / (1 - nu^2)
  return {.EA = E * d,
          .GA = shear_correction * mu * d,
          .EI = E * d * d * d / 12,
          .mass = rho * d,
          .inertia = rho * d * d * d / 12};
}

Mat2 plate_stress(double d, const Resultants& force, double y, double angle, double theta) {
  const double axial = force.N / d - 12 * force.M * y / (d * d * d);
  const double shear = 1.5 * force.Q / d * std::max(0.0, 1 - 4 * y * y / (d * d));
  Mat2 S;
  S << axial, shear, shear, 0;
  return Eigen::Rotation2Dd(angle) * S * Eigen::Rotation2Dd(-angle - theta);
}

Line straight_line(const Vec2& from, const Vec2& to, int elements) {
  Line line;
  const Vec2 along = to - from;
  for (int k = 0; k <= elements; ++k) line.x.emplace_back(from + (static_cast<double>(k) / elements) * along);
  line.alpha.assign(line.x.size(), std::atan2(along.y(), along.x()));
  return line;
}

/// An element and its strains. Its degrees of freedom: x, y and theta of its first node, then of its second.
struct BeamModel::Strained {
  std::array<Eigen::Index, 6> index{};  ///< of its degrees of freedom
  double l = 1, chord = 1;              ///< length at rest and now
  Vec2 t = Vec2::UnitX();               ///< direction of its chord
  Section stiff;                        ///< with the compliance of its own bending
  double stretch = 0, shear = 0, kappa = 0;

  Vec2 across() const { return {-t[1], t[0]}; }
  /// Derivatives of l stretch, l shear and l kappa.
  Vec6 stretching() const { return {-t[0], -t[1], 0, t[0], t[1], 0}; }
  Vec6 shearing() const {
    const Vec2 n = l / chord * across();
    return {-n[0], -n[1], -0.5 * l, n[0], n[1], -0.5 * l};
  }
  static Vec6 bending() { return {0, 0, -1, 0, 0, 1}; }
  double N() const { return stiff.EA * stretch; }
  double Q() const { return stiff.GA * shear; }
  double M() const { return stiff.EI * kappa; }

  Vec6 gradient() const { return N() * stretching() + Q() * shearing() + M() * bending(); }

  Mat6 hessian(const Resultants& stress) const {
    const Vec6 b1 = stretching(), b2 = shearing(), b3 = bending();
    Mat6 H =
        (stiff.EA * b1 * b1.transpose() + stiff.GA * b2 * b2.transpose() + stiff.EI * b3 * b3.transpose()) /
        l;
    const Vec2 n = across();
    const Mat2 turning = stress.N / chord * n * n.transpose() -
                         stress.Q * l / (chord * chord) * (t * n.transpose() + n * t.transpose());
    for (const int row : {0, 3}) {
      for (const int column : {0, 3}) H.block<2, 2>(row, column) += row == column ? turning : Mat2(-turning);
    }
    return H;
  }
};

BeamModel::BeamModel(Line line, std::vector<Section> sections)
    : line_(std::move(line)), sections_(std::move(sections)), mass_(Eigen::VectorXd::Zero(freedoms())) {
  for (int element = 0; element < elements(); ++element) {
    const int a = element, b = second_node(element);
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    const Vec2 d = line_.x[j] - line_.x[i];
    const double turns = b < a ? std::round((line_.alpha[i] - line_.alpha[j]) / (2 * std::numbers::pi)) : 0;
    lengths_.push_back(d.norm());
    angles_.push_back(0.5 * (line_.alpha[i] + line_.alpha[j] + turns * 2 * std::numbers::pi));
    at_rest_.emplace_back(in_section(angles_.back(), d) / d.norm());
    for (const int node : {a, b}) {
      mass_.segment<2>(freedom_of(node)).array() += 0.5 * d.norm() * section(element).mass;
      mass_[3 * node + 2] += 0.5 * d.norm() * section(element).inertia;
    }
  }
}

double BeamModel::length() const {
  double sum = 0;
  for (const double l : lengths_) sum += l;
  return sum;
}

double BeamModel::angle_at(double s) const {
  const int element = std::min(static_cast<int>(s), elements() - 1);
  const double first = line_.alpha[static_cast<std::size_t>(element)];
  return first + 2 * (s - element) * (angle(element) - first);
}

Middles BeamModel::middles_around(double s) const {
  const int n = elements();
  int first = static_cast<int>(std::floor(s - 0.5));
  if (!line_.closed) first = std::clamp(first, 0, std::max(n - 2, 0));
  return {.before = (first + n) % n, .after = (first + 1) % n, .part = s - 0.5 - first};
}

BeamModel::Strained BeamModel::strain(const Eigen::VectorXd& u, int element) const {
  const auto k = static_cast<std::size_t>(element);
  const int a = element, b = second_node(element);
  Strained result;
  for (int c = 0; c < 3; ++c) {
    result.index[static_cast<std::size_t>(c)] = 3 * a + c;
    result.index[static_cast<std::size_t>(3 + c)] = 3 * b + c;
  }
  const double l = lengths_[k], angle = angles_[k] + 0.5 * (u[3 * a + 2] + u[3 * b + 2]);
  const Vec2 d = line_.x[static_cast<std::size_t>(b)] - line_.x[k] + u.segment<2>(freedom_of(b)) -
                 u.segment<2>(freedom_of(a));
  result.l = l;
  result.chord = d.norm();
  result.t = d / result.chord;
  result.stiff = sections_[k];
  result.stiff.GA = 1 / (1 / sections_[k].GA + l * l / (12 * sections_[k].EI));
  result.stretch = result.chord / l - 1;
  const Vec2 e = in_section(angle, d);
  result.shear = std::atan2(cross(at_rest_[k], e), at_rest_[k].dot(e));
  result.kappa = (u[3 * b + 2] - u[3 * a + 2]) / l;
  return result;
}

Eigen::VectorXd BeamModel::internal_force(const Eigen::VectorXd& u) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(freedoms());
  for (int element = 0; element < elements(); ++element) {
    const Strained strained = strain(u, element);
    const Vec6 gradient = strained.gradient();
    for (int i = 0; i < 6; ++i) force[strained.index[static_cast<std::size_t>(i)]] -= gradient[i];
  }
  return force;
}

Eigen::SparseMatrix<double> BeamModel::stiffness(const Eigen::VectorXd& u,
                                                 const std::vector<Resultants>& stress) const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(36 * elements()));
  for (int element = 0; element < elements(); ++element) {
    const Strained strained = strain(u, element);
    const Mat6 H = strained.hessian(stress[static_cast<std::size_t>(element)]);
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        entries.emplace_back(static_cast<int>(strained.index[static_cast<std::size_t>(i)]),
                             static_cast<int>(strained.index[static_cast<std::size_t>(j)]), H(i, j));
      }
    }
  }
  Eigen::SparseMatrix<double> K(freedoms(), freedoms());
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

ElementForce BeamModel::element_force(const Eigen::VectorXd& u, int element, const Resultants& stress) const {
  const Strained strained = strain(u, element);
  return {.index = strained.index, .force = -strained.gradient(), .stiffness = strained.hessian(stress)};
}

double BeamModel::strain_energy(const Eigen::VectorXd& u) const {
  double sum = 0;
  for (int element = 0; element < elements(); ++element) {
    const Strained strained = strain(u, element);
    sum += 0.5 * strained.l *
           (strained.N() * strained.stretch + strained.Q() * strained.shear + strained.M() * strained.kappa);
  }
  return sum;
}

Resultants BeamModel::resultants(const Eigen::VectorXd& u, int element) const {
  const Strained strained = strain(u, element);
  return {.N = strained.N(), .Q = strained.Q(), .M = strained.M()};
}

std::vector<Resultants> BeamModel::resultants(const Eigen::VectorXd& u) const {
  std::vector<Resultants> all;
  for (int element = 0; element < elements(); ++element) all.push_back(resultants(u, element));
  return all;
}

Resultants BeamModel::resultants_at(const Eigen::VectorXd& u, double s) const {
  const auto [before, after, part] = middles_around(s);
  const Resultants a = resultants(u, before), b = resultants(u, after);
  return {.N = std::lerp(a.N, b.N, part), .Q = std::lerp(a.Q, b.Q, part), .M = std::lerp(a.M, b.M, part)};
}

std::vector<Resultants> BeamModel::resultants_along(const Eigen::VectorXd& u,
                                                    const Eigen::VectorXd& change) const {
  std::vector<Resultants> all;
  for (int element = 0; element < elements(); ++element) {
    const Strained strained = strain(u, element);
    Vec6 d;
    for (int i = 0; i < 6; ++i) d[i] = change[strained.index[static_cast<std::size_t>(i)]];
    const Section& stiff = strained.stiff;
    all.push_back({.N = strained.N() + stiff.EA / strained.l * strained.stretching().dot(d),
                   .Q = strained.Q() + stiff.GA / strained.l * strained.shearing().dot(d),
                   .M = strained.M() + stiff.EI / strained.l * Strained::bending().dot(d)});
  }
  return all;
}

Eigen::VectorXd BeamModel::nodal_load(const std::vector<Vec2>& per_length) const {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(freedoms());
  for (int element = 0; element < elements(); ++element) {
    for (const int node : {element, second_node(element)})
      load.segment<2>(freedom_of(node)) += 0.5 * length(element) * per_length[static_cast<std::size_t>(node)];
  }
  return load;
}

}  // namespace fsi::beam
