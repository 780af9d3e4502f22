#pragma once
/// A geometrically exact beam in the plane: a line of nodes, each with a position and the rotation of its section.
///
///     epsilon = |x'| - 1,   gamma = angle of x' - angle of the section,   kappa = theta'      stretch, shear, curvature
///     W = 1/2 int (EA epsilon^2 + GA gamma^2 + EI kappa^2) ds                                 strain energy
///
/// The axial force N = EA epsilon acts along the line, not along the normal of the section as in the theory of Simo and
/// Reissner. For small strains both are the same, but there a section can evade a tension beyond GA by shearing, and GA is
/// small here: elements join two nodes, with one point of integration in the middle (no locking); the bending of an
/// element between its nodes, which straight elements do not have, is a compliance l^2 / (12 EI) in series with that of
/// shear (R. H. MacNeal, A simple quadrilateral shell element, Computers & Structures 8, 1978: residual bending
/// flexibility). So a straight beam under small loads on its nodes has the exact deflections, whatever its number of
/// elements, and a thin strip under tension is a string.
///
/// Degrees of freedom: u_1, u_2 (displacement) and theta of every node, in this order. Source: J. C. Simo, A
/// finite strain beam formulation, Computer Methods in Applied Mechanics and Engineering 49, 1985.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "common/core/types.hpp"

namespace fsi::beam {

/// Of a cross-section of unit depth; stiffness in force, inertia per length.
struct Section {
  double EA = 1;       ///< axial stiffness [force/depth]
  double GA = 1;       ///< shear stiffness, shear correction included [force/depth]
  double EI = 1;       ///< bending stiffness [force*length^2/depth]
  double mass = 0;     ///< per length [mass/length/depth]
  double inertia = 0;  ///< rotary, per length [mass*length/depth]
};

/// The section of a plate of thickness d in plane strain: E' = E / (1 - nu^2), shear correction 5/6.
Section plate_section(double rho, double lambda, double mu, double d);

/// The line at rest. A closed one has as many elements as nodes, the last one back to the first node.
struct Line {
  std::vector<Vec2> x;        ///< nodes
  std::vector<double> alpha;  ///< angle of the tangent at every node, continuous along the line [rad]
  bool closed = false;
};

/// A straight line of `elements` elements.
Line straight_line(const Vec2& from, const Vec2& to, int elements);

/// Stress resultants of one element.
struct Resultants {
  double N = 0;  ///< axial force [force/depth]
  double Q = 0;  ///< shear force [force/depth]
  double M = 0;  ///< bending moment [force*length/depth]
};

/// Nominal stress in the section of a plate of thickness d, at the distance y from its centre line: axial force and
/// moment make it linear across the section, the shear force a parabola. P = S Lambda^T with a symmetric S: the shear
/// stress acts on layers along the line as it does on sections.
/// @param angle of the section at rest  @param theta its rotation
Mat2 plate_stress(double d, const Resultants& force, double y, double angle, double theta);

/// Two elements, and how far from the middle of the one to that of the other a place is.
struct Middles {
  int before = 0, after = 0;
  double part = 0;  ///< less than 0 or more than 1 beyond the outermost middles of an open line
};

/// Force and stiffness of one element on its degrees of freedom: those of its first node, then of its second.
struct ElementForce {
  std::array<Eigen::Index, 6> index{};    ///< among all degrees of freedom
  Eigen::Matrix<double, 6, 1> force;      ///< -dW/du
  Eigen::Matrix<double, 6, 6> stiffness;  ///< d^2 W / du^2
};

/// The first degree of freedom of a node: x, y and theta follow each other.
constexpr Eigen::Index freedom_of(int node) {
  return 3 * static_cast<Eigen::Index>(node);
}

class BeamModel {
 public:
  /// @param sections one for every element
  BeamModel(Line line, std::vector<Section> sections);

  int nodes() const { return static_cast<int>(line_.x.size()); }
  int elements() const { return static_cast<int>(sections_.size()); }
  Eigen::Index freedoms() const { return freedom_of(nodes()); }
  const Line& line() const { return line_; }
  const Section& section(int element) const { return sections_[static_cast<std::size_t>(element)]; }
  double length() const;
  double length(int element) const { return lengths_[static_cast<std::size_t>(element)]; }
  /// Angle of the section in the middle of an element at rest.
  double angle(int element) const { return angles_[static_cast<std::size_t>(element)]; }
  /// The same at a place on the line, in elements: linear between the nodes.
  double angle_at(double s) const;
  /// The elements whose middles are next to such a place.
  Middles middles_around(double s) const;

  /// Lumped: diagonal.
  const Eigen::VectorXd& mass() const { return mass_; }
  /// Force of the strains on the degrees of freedom, -dW/du.
  Eigen::VectorXd internal_force(const Eigen::VectorXd& u) const;
  /// Its derivative, with the sign of a stiffness: d^2 W / du^2.
  Eigen::SparseMatrix<double> stiffness(const Eigen::VectorXd& u) const {
    return stiffness(u, resultants(u));
  }
  /// The same with other stresses in its geometric part, one for every element.
  Eigen::SparseMatrix<double> stiffness(const Eigen::VectorXd& u,
                                        const std::vector<Resultants>& stress) const;
  /// One element's part of both. @param stress in the geometric part
  ElementForce element_force(const Eigen::VectorXd& u, int element, const Resultants& stress) const;
  double strain_energy(const Eigen::VectorXd& u) const;
  Resultants resultants(const Eigen::VectorXd& u, int element) const;
  std::vector<Resultants> resultants(const Eigen::VectorXd& u) const;
  /// At a place on the line, in elements: those of the elements belong to their middles, and are linear between
  /// these, and on to the ends.
  Resultants resultants_at(const Eigen::VectorXd& u, double s) const;
  /// Those at u + change by the strains' derivative at u.
  std::vector<Resultants> resultants_along(const Eigen::VectorXd& u, const Eigen::VectorXd& change) const;
  /// Force on the nodes of a force per length at every node.
  Eigen::VectorXd nodal_load(const std::vector<Vec2>& per_length) const;

 private:
  struct Strained;
  Strained strain(const Eigen::VectorXd& u, int element) const;
  int second_node(int element) const { return (element + 1) % nodes(); }

  Line line_;
  std::vector<Section> sections_;
  std::vector<double> lengths_;  ///< of the elements
  std::vector<double> angles_;   ///< of the sections in the middle of the elements at rest
  std::vector<Vec2> at_rest_;    ///< direction of the line in the frame of the section there
  Eigen::VectorXd mass_;
};

}  // namespace fsi::beam
