#include "coupler/exchange/transfer.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "common/core/component_major.hpp"
#include "common/wire/sparse.hpp"

namespace fsi::coupler {

namespace {

/// A direction carries a force if its part of sum ds n n^T is more than this of the largest.
constexpr double no_force = 1e-10;

/// A point counts as clamped where the marks of its neighbours, weighted, come to this.
constexpr double clamped = 1 - 1e-9;

std::vector<double> lengths(std::span<const double> x) {
  std::vector<double> ds(x.size() / 2);
  point_lengths(x, ds);
  return ds;
}

/// u at a place that moved from x_0: positions are carried over as displacements, exact at t = 0.
std::vector<double> difference(std::span<const double> x, std::span<const double> x_0) {
  std::vector<double> u(x.begin(), x.end());
  for (std::size_t k = 0; k < u.size(); ++k) u[k] -= x_0[k];
  return u;
}

}  // namespace

Vec2 force_of(std::span<const double> x, std::span<const double> n, std::span<const double> w_n) {
  const std::vector<double> ds = lengths(x);
  Vec2 force = Vec2::Zero();
  for (std::size_t k = 0; k < ds.size(); ++k) force += ds[k] * w_n[k] * vector_at(n, k);
  return force;
}

void impose_force(std::span<const double> x, std::span<const double> n, const Vec2& wanted,
                  std::span<double> w_n) {
  const std::vector<double> ds = lengths(x);
  Mat2 carried = Mat2::Zero();
  for (std::size_t k = 0; k < ds.size(); ++k)
    carried += ds[k] * vector_at(n, k) * vector_at(n, k).transpose();
  Eigen::SelfAdjointEigenSolver<Mat2> directions;
  directions.computeDirect(carried);
  const Vec2 missing = wanted - force_of(x, n, w_n);
  Vec2 c = Vec2::Zero();
  for (Eigen::Index i = 0; i < 2; ++i) {
    const double part = directions.eigenvalues()[i];
    if (part <= no_force * directions.eigenvalues()[1]) continue;
    const Vec2 direction = directions.eigenvectors().col(i);
    c += direction.dot(missing) / part * direction;
  }
  for (std::size_t k = 0; k < ds.size(); ++k) w_n[k] += vector_at(n, k).dot(c);
}

InterfaceTransfer::InterfaceTransfer(const Curve& curve, std::span<const double> coarse,
                                     std::span<const double> fine)
    : curve_(curve),
      to_fine_(coarse, fine, curve.periodic),
      to_coarse_(fine, coarse, curve.periodic),
      modes_to_fine_(to_fine_.cubic_weights()),
      x_0_(coarse.begin(), coarse.end()),
      x_0_fine_(fine.begin(), fine.end()) {}

const wire::PredictedInterface& InterfaceTransfer::bring(const wire::PredictedInterface& coarse) {
  x_ = coarse.x;
  v_ = coarse.v;
  brought_ = coarse;
  const std::size_t m = to_fine_.points();
  const auto fill = [&](const std::vector<double>& from, std::vector<double>& to, auto how) {
    to.resize(from.size() / curve_.n * m);
    (to_fine_.*how)(from, to);
  };
  fill(difference(coarse.x, x_0_), brought_.x, &CurveInterpolation::cubic);
  for (std::size_t k = 0; k < 2 * m; ++k) brought_.x[k] += x_0_fine_[k];
  fill(coarse.v, brought_.v, &CurveInterpolation::cubic);
  fill(coarse.w, brought_.w, &CurveInterpolation::cubic);
  fill(coarse.p, brought_.p, &CurveInterpolation::cubic);
  bring_modes(coarse.modal);
  fill(coarse.z_f, brought_.z_f, &CurveInterpolation::linear);
  fill(coarse.rho, brought_.rho, &CurveInterpolation::linear);
  fill(coarse.gamma, brought_.gamma, &CurveInterpolation::linear);
  fill(coarse.Z, brought_.Z, &CurveInterpolation::linear);
  std::vector<double> marks(coarse.fixed.size()), fine_marks;
  std::ranges::transform(coarse.fixed, marks.begin(),
                         [](std::uint8_t freedom) { return freedom == wire::Freedom::fixed ? 1.0 : 0.0; });
  fill(marks, fine_marks, &CurveInterpolation::linear);
  brought_.fixed.assign(fine_marks.size(), 0);
  std::ranges::transform(fine_marks, brought_.fixed.begin(),
                         [](double mark) { return static_cast<std::uint8_t>(mark >= clamped); });
  if (coarse.fixed.empty()) return brought_;
  if (coarse.fixed.front() == wire::Freedom::slides) brought_.fixed.front() = wire::Freedom::slides;
  if (coarse.fixed.back() == wire::Freedom::slides) brought_.fixed.back() = wire::Freedom::slides;
  return brought_;
}

void InterfaceTransfer::bring_modes(const wire::ModalResponse& coarse) {
  if (coarse.modes == 0) return;
  const auto n = static_cast<Eigen::Index>(curve_.n);
  brought_.modal.N = wire::entries_of(wire::matrix_of(coarse.N, coarse.modes, n) * modes_to_fine_);
}

std::vector<double> InterfaceTransfer::at_coarse(std::span<const double> fine) const {
  std::vector<double> result(fine.size() / to_fine_.points() * curve_.n);
  to_coarse_.cubic(fine, result);
  return result;
}

void InterfaceTransfer::resolve(std::span<double> fine) const {
  to_fine_.cubic(at_coarse(fine), fine);
}

/// The coarser side keeps its own normals and its own normal velocity; only what the projection changed is
/// carried over, so that a uniform motion stays one.
void InterfaceTransfer::give(std::span<const double> x, wire::ProjectedInterface& answer) const {
  std::vector<double> change = answer.v_n;
  for (std::size_t k = 0; k < change.size(); ++k)
    change[k] -= vector_at(answer.n, k).dot(vector_at(brought_.v, k));
  const Vec2 force = force_of(x, answer.n, answer.w_n);
  answer.n.resize(2 * curve_.n);
  unit_normals(curve_, x_, answer.n);
  answer.v_n = at_coarse(change);
  for (std::size_t k = 0; k < curve_.n; ++k) answer.v_n[k] += vector_at(answer.n, k).dot(vector_at(v_, k));
  answer.w_n = at_coarse(answer.w_n);
  impose_force(x_, answer.n, force, answer.w_n);
  answer.v = at_coarse(answer.v);
  answer.a = at_coarse(answer.a);
  answer.x_next = at_coarse(difference(answer.x_next, x_0_fine_));
  for (std::size_t k = 0; k < 2 * curve_.n; ++k) answer.x_next[k] += x_0_[k];
  std::vector<double> z_f(curve_.n);
  to_coarse_.linear(answer.z_f, z_f);
  answer.z_f = std::move(z_f);
  give_robin(answer);
}

/// The newest level is that of the state just handed over; the older ones keep their distance to it.
void InterfaceTransfer::give_robin(wire::ProjectedInterface& answer) const {
  if (answer.robin_t.empty()) return;
  answer.robin_r = at_coarse(answer.robin_r);
  for (std::size_t k = 0; k < curve_.n; ++k) {
    const double offset = answer.w_n[k] + answer.z_f[k] * answer.v_n[k] - answer.robin_r[k];
    for (std::size_t level = 0; level < answer.robin_t.size(); ++level)
      answer.robin_r[level * curve_.n + k] += offset;
  }
}

}  // namespace fsi::coupler
