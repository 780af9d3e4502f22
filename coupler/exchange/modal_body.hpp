#pragma once
/// A solid with degrees of freedom among the gases that it meets. Each of them answers its motion along an
/// interface of its own, and all of these answers add up:
///
///     (S + dt sum_k A_k) q_dot = g + dt sum_k f~_k          k: interfaces

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "common/interface/modal_system.hpp"
#include "common/interface/wave_curve.hpp"
#include "common/wire/messages.hpp"

namespace fsi::coupler {

/// One interface of such a solid, as predicted.
struct ModalSide {
  const Eigen::SparseMatrix<double>& N;  ///< mode vectors, modes x points
  std::span<const GasSide> gas;          ///< of each point
  std::span<const double> ds;            ///< length of interface that belongs to each point
};

class ModalBody {
 public:
  /// Velocities of the degrees of freedom at the end of a step dt. @param sides all interfaces
  /// @return empty where nothing resists one of them
  Eigen::VectorXd project(const wire::ModalResponse& response, std::span<const ModalSide> sides, double dt);

 private:
  Eigen::VectorXd project(const wire::ModalResponse& response, const ModalSide& side, double dt);

  Eigen::SparseMatrix<double> S_;  ///< of the last step
  AddedMass added_mass_;
  ModalSolver solver_;
};

}  // namespace fsi::coupler
