#include "solid_solver/beam/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "common/core/failure.hpp"

namespace fsi::beam {

namespace {

/// Newton's iteration doubles the digits each time; who needs more than this diverges.
constexpr int most_iterations = 30;
/// Displacements over the length, and rotations, are exact to this: the next correction would be its square.
constexpr double converged = 1e-9;
/// Below this, corrections that no longer become smaller are round-off, which the stretch of a thin beam
/// magnifies.
constexpr double almost = 1e-6;

}  // namespace

Eigen::SparseMatrix<double> free_motions(const Line& line, const std::array<End, 2>& ends) {
  const auto nodes = static_cast<int>(line.x.size());
  std::vector<Eigen::Triplet<double>> entries;
  int column = 0;
  const auto leave = [&](int node, int freedom) { entries.emplace_back(3 * node + freedom, column++, 1.0); };
  for (int node = 0; node < nodes; ++node) {
    const bool first = node == 0, at_end = !line.closed && (first || node == nodes - 1);
    const End end = at_end ? ends[first ? 0 : 1] : End::free;
    if (end == End::free) {
      leave(node, 0);
      leave(node, 1);
    }
    if (end == End::guided) {
      const double alpha = line.alpha[static_cast<std::size_t>(node)];
      entries.emplace_back(3 * node, column, -std::sin(alpha));
      entries.emplace_back(3 * node + 1, column++, std::cos(alpha));
    }
    if (end == End::free || end == End::pinned) leave(node, 2);
  }
  Eigen::SparseMatrix<double> B(freedom_of(nodes), column);
  B.setFromTriplets(entries.begin(), entries.end());
  return B;
}

BeamMotion::BeamMotion(BeamModel model, const std::array<End, 2>& ends)
    : model_(std::move(model)), B_(beam::free_motions(model_.line(), ends)) {
  start(Eigen::VectorXd::Zero(model_.freedoms()));
}

void BeamMotion::start(const Eigen::VectorXd& u_dot) {
  u_ = u_old_ = u_older_ = own_ = Eigen::VectorXd::Zero(model_.freedoms());
  u_dot_ = B_ * (B_.transpose() * u_dot);
  v_old_ = v_older_ = u_dot_;
}

Eigen::VectorXd BeamMotion::displacement_of(const Eigen::VectorXd& u_dot) const {
  const BackwardDifference bdf = difference();
  return (dt_ * u_dot + bdf.history(u_old_, u_older_)) / bdf.leading;
}

void BeamMotion::advance(double dt, const Eigen::VectorXd& own, const ModalLoad* gas) {
  const double reach = dt_ > 0 ? dt / dt_ : 0;  // of the acceleration of the last step
  const Eigen::VectorXd guess = u_dot_ + reach * (u_dot_ - v_old_);
  std::vector<Resultants> stress = model_.resultants(u_);
  u_older_ = std::exchange(u_old_, u_);
  v_older_ = std::exchange(v_old_, u_dot_);
  dt_before_ = std::exchange(dt_, dt);
  own_ = own;
  u_dot_ = guess;
  u_ = displacement_of(u_dot_);
  double change = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const double before = std::exchange(change, improve(gas, stress));
    if (change <= converged || (change <= almost && change >= 0.5 * before)) return;
  }
  throw NumbersBroke(fmt::format(
      "the motion of the beam in a step of {:.3g} is not found in {} iterations; take a smaller `time.dt`",
      dt, most_iterations));
}

/// One iteration, and the largest change it made: of a displacement over the length, of a rotation.
double BeamMotion::improve(const ModalLoad* gas, std::vector<Resultants>& stress) {
  const Response own = response(stress);
  const Eigen::VectorXd q_dot =
      gas != nullptr ? project_modes(own.S, own.g, *gas, dt_) : solve_modes(own.S, own.g);
  if (q_dot.size() == 0 || !q_dot.allFinite()) {
    throw NumbersBroke(
        "the beam has a motion that no mass, no stiffness and no gas resists, or its numbers are not finite");
  }
  const Eigen::VectorXd before = u_;
  correct(q_dot);
  const Eigen::VectorXd change = u_ - before;
  stress = model_.resultants_along(before, change);
  double largest = 0;
  for (Eigen::Index k = 0; k < change.size(); ++k)
    largest = std::max(largest, std::abs(change[k]) / (k % 3 == 2 ? 1 : model_.length()));
  return largest;
}

Response BeamMotion::response(const std::vector<Resultants>& stress) const {
  const BackwardDifference bdf = difference();
  const Eigen::SparseMatrix<double> K = model_.stiffness(u_, stress);
  const Eigen::VectorXd from_history = u_ - bdf.history(u_old_, u_older_) / bdf.leading;
  const Eigen::VectorXd past = bdf.history(v_old_, v_older_);
  const Eigen::VectorXd load = own_ + model_.internal_force(u_) + K * from_history;
  Eigen::SparseMatrix<double> S = (dt_ * dt_ / bdf.leading) * K;
  S.diagonal() += bdf.leading * model_.mass();
  return {.S = B_.transpose() * S * B_,
          .g = B_.transpose() * (model_.mass().cwiseProduct(past) + dt_ * load)};
}

void BeamMotion::correct(const Eigen::VectorXd& q_dot) {
  u_dot_ = B_ * q_dot;
  u_ = displacement_of(u_dot_);
}

Vec2 BeamMotion::momentum() const {
  Vec2 sum = Vec2::Zero();
  for (int node = 0; node < model_.nodes(); ++node)
    sum += model_.mass()[freedom_of(node)] * u_dot_.segment<2>(freedom_of(node));
  return sum;
}

double BeamMotion::angular_momentum() const {
  double sum = 0;
  for (int node = 0; node < model_.nodes(); ++node) {
    const Vec2 x = model_.line().x[static_cast<std::size_t>(node)] + u_.segment<2>(freedom_of(node));
    const Vec2 v = u_dot_.segment<2>(freedom_of(node));
    sum += model_.mass()[freedom_of(node)] * (x.x() * v.y() - x.y() * v.x()) +
           model_.mass()[3 * node + 2] * u_dot_[3 * node + 2];
  }
  return sum;
}

void BeamMotion::archive(Archive& archive) {
  for (const auto& [name, values] : {std::pair{"u", &u_},
                                     {"u_old", &u_old_},
                                     {"u_older", &u_older_},
                                     {"u_dot", &u_dot_},
                                     {"v_old", &v_old_},
                                     {"v_older", &v_older_},
                                     {"own", &own_}})
    archive.values(name, {values->data(), static_cast<std::size_t>(values->size())});
  archive.number("dt", dt_);
  archive.number("dt_before", dt_before_);
}

}  // namespace fsi::beam
