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
/// Below this, corrections that no longer become smaller are
/// round-off, which the stretch of a thin beam magnifies.
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

std::vector<FreeMotion> places_among(const Eigen::SparseMatrix<double>& B) {
  std::vector<FreeMotion> free(static_cast<std::size_t>(B.rows()));
  for (int column = 0; column < B.cols(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(B, column); entry; ++entry)
      free[static_cast<std::size_t>(entry.row())] = {.column = column, .part = entry.value()};
  }
  return free;
}

BeamMotion::BeamMotion(BeamModel model, const std::array<End, 2>& ends)
    : model_(std::move(model)), B_(beam::free_motions(model_.line(), ends)) {
  find_places();
  start(Eigen::VectorXd::Zero(model_.freedoms()));
}

/// Where the entries of S are: those of the elements between free motions.
void BeamMotion::find_places() {
  free_ = places_among(B_);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(model_.freedoms());
  std::vector<std::array<int, 6>> columns;
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < B_.cols(); ++k) entries.emplace_back(k, k, 0.0);
  for (int element = 0; element < model_.elements(); ++element) {
    const ElementForce part = model_.element_force(rest, element, {});
    std::array<int, 6>& own = columns.emplace_back();
    for (std::size_t i = 0; i < 6; ++i) own[i] = free_motion(part.index[i]).column;
    for (const int row : own) {
      for (const int column : own) {
        if (column >= 0 && row >= column) entries.emplace_back(row, column, 0.0);
      }
    }
  }
  Eigen::SparseMatrix<double>& S = own_response_.S;
  S.resize(B_.cols(), B_.cols());
  S.setFromTriplets(entries.begin(), entries.end());
  const auto place = [&](int row, int column) {
    const int *rows = S.innerIndexPtr(), *starts = S.outerIndexPtr();
    return static_cast<int>(std::lower_bound(rows + starts[column], rows + starts[column + 1], row) - rows);
  };
  for (int k = 0; k < B_.cols(); ++k) diagonal_.push_back(place(k, k));
  for (const std::array<int, 6>& own : columns) {
    std::array<int, 36>& all = places_.emplace_back();
    for (std::size_t e = 0; e < 36; ++e) {
      const int row = own[e / 6], column = own[e % 6];
      all[e] = column >= 0 && row >= column ? place(row, column) : -1;
    }
  }
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
  throw Diverged(fmt::format(
      "the motion of the beam in a step of {:.3g} is not found in {} iterations; {}", dt, most_iterations,
      model_.mass().maxCoeff() > 0 ? "take a smaller `time.dt`"
                                   : "without mass it follows its load at once: let that grow from zero, or "
                                     "give the beam a mass (`rho`)"));
}

/// One iteration, and the largest change it made: of a displacement over the length, of a rotation.
double BeamMotion::improve(const ModalLoad* gas, std::vector<Resultants>& stress) {
  assemble(stress, own_response_);
  const auto& [S, g] = own_response_;
  const Eigen::VectorXd q_dot = gas != nullptr ? solver_.project(S, g, *gas, dt_) : solver_.solve(S, g);
  if (q_dot.size() == 0 || !q_dot.allFinite()) {
    throw Diverged(
        "the beam has a motion that no mass, no stiffness and no gas resists, or its numbers are not finite");
  }
  const Eigen::VectorXd before = u_;
  correct(q_dot);
  const Eigen::VectorXd change = u_ - before;
  stress = model_.resultants_along(before, change);
  const double length = model_.length();
  double largest = 0;
  for (Eigen::Index k = 0; k < change.size(); ++k)
    largest = std::max(largest, std::abs(change[k]) / (k % 3 == 2 ? 1 : length));
  return largest;
}

void BeamMotion::assemble(const std::vector<Resultants>& stress, Response& into) const {
  const BackwardDifference bdf = difference();
  const Eigen::VectorXd from_history = u_ - bdf.history(u_old_, u_older_) / bdf.leading;
  const Eigen::VectorXd past = bdf.history(v_old_, v_older_);
  const double scale = dt_ * dt_ / bdf.leading;
  double* const S = into.S.valuePtr();
  std::fill_n(S, into.S.nonZeros(), 0.0);
  into.g.setZero(modes());
  for (int element = 0; element < model_.elements(); ++element) {
    const auto k = static_cast<std::size_t>(element);
    const ElementForce part = model_.element_force(u_, element, stress[k]);
    Eigen::Matrix<double, 6, 1> own;
    std::array<FreeMotion, 6> free;
    for (std::size_t i = 0; i < 6; ++i) {
      own[static_cast<Eigen::Index>(i)] = from_history[part.index[i]];
      free[i] = free_motion(part.index[i]);
    }
    const Eigen::Matrix<double, 6, 1> load = part.force + part.stiffness * own;
    for (std::size_t i = 0; i < 6; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      if (free[i].column >= 0) into.g[free[i].column] += dt_ * free[i].part * load[row];
      for (std::size_t j = 0; j < 6; ++j) {
        const int place = places_[k][6 * i + j];
        if (place < 0) continue;
        S[place] += scale * free[i].part * free[j].part * part.stiffness(row, static_cast<Eigen::Index>(j));
      }
    }
  }
  for (Eigen::Index freedom = 0; freedom < model_.freedoms(); ++freedom) {
    const auto& [column, part] = free_motion(freedom);
    if (column < 0) continue;
    const double mass = model_.mass()[freedom];
    S[diagonal_[static_cast<std::size_t>(column)]] += bdf.leading * mass * part * part;
    into.g[column] += part * (mass * past[freedom] + dt_ * own_[freedom]);
  }
}

Response BeamMotion::lower_response() const {
  Response result = own_response_;
  assemble(model_.resultants(u_), result);
  return result;
}

Response BeamMotion::response() const {
  const Response lower = lower_response();
  return {.S = lower.S.selfadjointView<Eigen::Lower>(), .g = lower.g};
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
