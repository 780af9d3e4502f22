#include "common/interface/modal.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "common/interface/band.hpp"
#include "common/interface/modal_system.hpp"

namespace fsi {

ModalLoad modal_load(const Eigen::SparseMatrix<double>& N, std::span<const NormalSide> gas,
                     std::span<const double> ds) {
  const auto points = static_cast<Eigen::Index>(gas.size());
  Eigen::VectorXd resistance(points), push(points);
  for (Eigen::Index i = 0; i < points; ++i) {
    const auto k = static_cast<std::size_t>(i);
    resistance[i] = gas[k].z * ds[k];
    push[i] = (gas[k].w_n + gas[k].z * gas[k].v_n) * ds[k];
  }
  const Eigen::SparseMatrix<double> resisted = N * resistance.asDiagonal();
  return {.A = resisted * N.transpose(), .f = N * push};
}

Eigen::VectorXd solve_modes(const Eigen::SparseMatrix<double>& S, const Eigen::VectorXd& right) {
  if (S.rows() > few_modes) return ModalSolver().solve(S, right);
  return solve_few_modes(Eigen::MatrixXd(S), right);
}

/// Column by column: L below the diagonal, D on it. A pivot that is round-off of its entry of the diagonal
/// belongs to a direction without resistance.
Eigen::VectorXd solve_few_modes(Eigen::MatrixXd S, Eigen::VectorXd x) {
  const Eigen::Index n = S.rows();
  Eigen::VectorXd inverse(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    double pivot = S(k, k);
    for (Eigen::Index j = 0; j < k; ++j) pivot -= S(k, j) * S(k, j) * S(j, j);
    inverse[k] = std::abs(pivot) > pivot_round_off * std::abs(S(k, k)) ? 1 / pivot : 0;
    for (Eigen::Index i = k + 1; i < n; ++i) {
      for (Eigen::Index j = 0; j < k; ++j) S(i, k) -= S(i, j) * S(k, j) * S(j, j);
      S(i, k) *= inverse[k];
    }
    S(k, k) = pivot;
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    for (Eigen::Index j = 0; j < k; ++j) x[k] -= S(k, j) * x[j];
  }
  for (Eigen::Index k = n; k-- > 0;) {
    x[k] *= inverse[k];
    for (Eigen::Index i = k + 1; i < n; ++i) x[k] -= S(i, k) * x[i];
  }
  return x;
}

Eigen::VectorXd project_modes(const Eigen::SparseMatrix<double>& S, const Eigen::VectorXd& g,
                              const ModalLoad& load, double dt) {
  return solve_modes(S + dt * load.A, g + dt * load.f);
}

Eigen::VectorXd balance(const Eigen::SparseMatrix<double>& N, std::span<const GasSide> gas,
                        std::span<const double> ds,
                        const std::function<Eigen::VectorXd(const ModalLoad&)>& answer) {
  return balance(N, gas,
                 [&](std::span<const NormalSide> tangents) { return answer(modal_load(N, tangents, ds)); });
}

Eigen::VectorXd balance(const Eigen::SparseMatrix<double>& N, std::span<const GasSide> gas,
                        const std::function<Eigen::VectorXd(std::span<const NormalSide>)>& answer) {
  std::vector<NormalSide> tangents(gas.size());
  double scale = 0;
  bool straight = true;
  for (std::size_t i = 0; i < gas.size(); ++i) {
    tangents[i] = gas[i].state;
    straight = straight && gas[i].curve.gamma == 0;
    scale = std::max(scale, std::fabs(gas[i].state.v_n) + gas[i].curve.sound());
  }
  Eigen::VectorXd q_dot = answer(tangents);
  if (straight || q_dot.size() == 0) return q_dot;

  const auto change_at = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
    const Eigen::VectorXd v_n = N.transpose() * at;
    for (std::size_t i = 0; i < gas.size(); ++i)
      tangents[i] = gas[i].tangent(v_n(static_cast<Eigen::Index>(i)));
    const Eigen::VectorXd next = answer(tangents);
    if (next.size() == 0) return next;
    return next - at;
  };
  const auto size_of = [&](const Eigen::VectorXd& change) {
    return (N.transpose() * change).cwiseAbs().maxCoeff();
  };
  // Near the solution a change leaves its square, which below `close` is less than round-off.
  constexpr double round_off = 1e-14, close = 1e-8, least_part = 1e-3;
  constexpr int most = 50;
  Eigen::VectorXd change = change_at(q_dot);
  for (int k = 0; k < most; ++k) {
    if (change.size() == 0) return change;  // nothing resists any more
    if (!(size_of(change) > round_off * scale)) return q_dot;
    if (size_of(change) <= close * scale) return q_dot + change;
    double part = 1;
    Eigen::VectorXd next = q_dot + change, after = change_at(next);
    while ((after.size() == 0 || size_of(after) > size_of(change)) && part > least_part) {
      part *= 0.5;
      next = q_dot + part * change;
      after = change_at(next);
    }
    q_dot = next;
    change = after;
  }
  return q_dot;
}

}  // namespace fsi
