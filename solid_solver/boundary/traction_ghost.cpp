#include "solid_solver/boundary/traction_ghost.hpp"

#include <Eigen/Eigenvalues>

namespace fsi::solid {

Tensor2 least_change(const Stiffness& K, const Tensor2& defect) {
  // H = d2psi/dF_ji dF_kl is symmetric once the stress is written in the order of F, that is transposed.
  Eigen::Matrix4d H;
  for (int c = 0; c < 4; ++c) {
    const Tensor2 e =
        contract(K, {c == 0 ? 1.0 : 0.0, c == 1 ? 1.0 : 0.0, c == 2 ? 1.0 : 0.0, c == 3 ? 1.0 : 0.0});
    H.col(c) << e.a11, e.a21, e.a12, e.a22;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(H);
  const Eigen::Vector4d& strength = eigen.eigenvalues();
  int weakest = 0;
  for (int c = 1; c < 4; ++c) {
    if (std::abs(strength[c]) < std::abs(strength[weakest])) weakest = c;
  }
  Eigen::Vector4d y =
      eigen.eigenvectors().transpose() * Eigen::Vector4d(defect.a11, defect.a21, defect.a12, defect.a22);
  for (int c = 0; c < 4; ++c) y[c] = c == weakest ? 0.0 : y[c] / strength[c];
  const Eigen::Vector4d x = eigen.eigenvectors() * y;
  return {x[0], x[1], x[2], x[3]};
}

}  // namespace fsi::solid
