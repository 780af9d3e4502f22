#include "coupler/exchange/modal_body.hpp"

#include "common/interface/modal.hpp"
#include "common/wire/sparse.hpp"

namespace fsi::coupler {

Eigen::VectorXd ModalBody::project(const wire::ModalResponse& response, const ModalSide& side, double dt) {
  const auto k = static_cast<Eigen::Index>(response.modes);
  wire::put_matrix(response.S, k, k, S_);
  const Eigen::VectorXd g = Eigen::Map<const Eigen::VectorXd>(response.g.data(), k);
  added_mass_.take(side.N);
  return balance(side.N, side.gas, [&](std::span<const NormalSide> gas) {
    return solver_.project(S_, g, added_mass_.load(gas, side.ds), dt);
  });
}

/// The points of all interfaces are those of one.
Eigen::VectorXd ModalBody::project(const wire::ModalResponse& response, std::span<const ModalSide> sides,
                                   double dt) {
  if (sides.size() == 1) return project(response, sides.front(), dt);
  std::vector<GasSide> gas;
  std::vector<double> ds;
  std::vector<Eigen::SparseMatrix<double>> parts;
  for (const ModalSide& side : sides) {
    parts.push_back(side.N);
    gas.insert(gas.end(), side.gas.begin(), side.gas.end());
    ds.insert(ds.end(), side.ds.begin(), side.ds.end());
  }
  const Eigen::SparseMatrix<double> N = side_by_side(parts);
  return project(response, ModalSide{.N = N, .gas = gas, .ds = ds}, dt);
}

}  // namespace fsi::coupler
