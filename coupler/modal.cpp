#include "coupler/modal.hpp"

#include <Eigen/Cholesky>

namespace fsi::coupler {

ModalLoad modal_load(const Eigen::MatrixXd& N, std::span<const NormalSide> gas, std::span<const double> ds) {
  const auto modes = N.rows();
  ModalLoad load{.A = Eigen::MatrixXd::Zero(modes, modes), .f = Eigen::VectorXd::Zero(modes)};
  for (std::size_t i = 0; i < gas.size(); ++i) {
    const Eigen::VectorXd column = N.col(static_cast<Eigen::Index>(i));
    load.A += gas[i].z * ds[i] * column * column.transpose();
    load.f += (gas[i].w_n + gas[i].z * gas[i].v_n) * ds[i] * column;
  }
  return load;
}

const Eigen::VectorXd& ModalMotion::advance(const Eigen::MatrixXd& M, const Eigen::VectorXd& f_own,
                                            const ModalLoad& load, double dt) {
  // With r = dt / dt_before; r = 0 turns the formula into backward Euler.
  const double r = dt_before_ > 0 ? dt / dt_before_ : 0;
  const Eigen::MatrixXd left = (1 + 2 * r) / (1 + r) * M + dt * load.A;
  const Eigen::VectorXd old = (1 + r) * now_ - r * r / (1 + r) * before_;
  const Eigen::VectorXd right = M * old + dt * (load.f + f_own);
  before_ = now_;
  now_ = left.ldlt().solve(right);
  dt_before_ = dt;
  return now_;
}

void ModalMotion::archive(Archive& archive) {
  archive.values("now", {now_.data(), static_cast<std::size_t>(now_.size())});
  archive.values("before", {before_.data(), static_cast<std::size_t>(before_.size())});
  archive.number("dt_before", dt_before_);
}

}  // namespace fsi::coupler
