#include "coupler/exchange/transfer.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "common/core/component_major.hpp"
#include "common/interface/point_lengths.hpp"
#include "common/wire/sparse.hpp"

namespace fsi::coupler {

namespace {

/// A direction carries a force if its pivot of sum ds n n^T is more than this of the largest.
constexpr double no_force = 1e-10;

/// A point counts as clamped where the marks of its neighbours, weighted, come to this.
constexpr double clamped = 1 - 1e-9;

/// u at a place that moved from x_0: positions are carried over as displacements, exact at t = 0.
std::vector<double> difference(std::span<const double> x, std::span<const double> x_0) {
  std::vector<double> u(x.begin(), x.end());
  for (std::size_t k = 0; k < u.size(); ++k) u[k] -= x_0[k];
  return u;
}

/// Do two curves with the same ends run in opposite directions?
bool run_oppositely(std::span<const double> x, std::span<const double> other) {
  const Vec2 first = vector_at(other, 0);
  return (first - vector_at(x, x.size() / 2 - 1)).norm() < (first - vector_at(x, 0)).norm();
}

}  // namespace

InterfaceTransfer::InterfaceTransfer(const Curve& curve, std::span<const double> coarse,
                                     std::span<const double> fine, bool to_gas)
    : curve_(curve),
      to_gas_(to_gas),
      to_fine_(coarse, fine, curve.periodic),
      to_coarse_(fine, coarse, curve.periodic),
      modes_to_fine_(to_fine_.cubic_weights()),
      x_0_(coarse.begin(), coarse.end()),
      x_0_fine_(fine.begin(), fine.end()),
      opposite_(run_oppositely(coarse, fine)) {}

const wire::PredictedInterface& InterfaceTransfer::bring(const wire::PredictedInterface& coarse) {
  x_ = coarse.x;
  v_ = coarse.v;
  p_ = coarse.p;
  brought_ = coarse;
  const std::size_t m = to_fine_.points();
  const auto fill = [&](const std::vector<double>& from, std::vector<double>& to, auto how) {
    to.resize(from.size() / curve_.n * m);
    (to_fine_.*how)(from, to);
  };
  fill(difference(coarse.x, x_0_), brought_.x, &CurveInterpolation::cubic);
  for (std::size_t k = 0; k < 2 * m; ++k) brought_.x[k] += x_0_fine_[k];
  fill(coarse.v, brought_.v, &CurveInterpolation::cubic);
  fill(coarse.a, brought_.a, &CurveInterpolation::cubic);
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
  std::uint8_t &first = brought_.fixed.front(), &last = brought_.fixed.back();
  if (coarse.fixed.front() == wire::Freedom::slides) (opposite_ ? last : first) = wire::Freedom::slides;
  if (coarse.fixed.back() == wire::Freedom::slides) (opposite_ ? first : last) = wire::Freedom::slides;
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

/// What the interpolated traction, brought back to the finer points, lacks of the force there, is made up for by n.c with
/// one vector c. A traction that the coarser side has shown itself lacks nothing: it comes back as it was, however often.
std::vector<double> InterfaceTransfer::solid_traction(std::span<const double> x,
                                                      const wire::ProjectedInterface& fine) const {
  const std::size_t m = to_fine_.points();
  std::vector<double> w_n = at_coarse(fine.w_n), back(m), n_back(2 * m), ds(m);
  const std::vector<double> n = at_coarse(fine.n);
  point_lengths(x, fine.n, ds);
  to_fine_.cubic(w_n, back);
  to_fine_.cubic(n, n_back);
  Vec2 missing = Vec2::Zero();
  Mat2 carried = Mat2::Zero();
  for (std::size_t k = 0; k < m; ++k) {
    const Vec2 n_ds = ds[k] * vector_at(fine.n, k);
    missing += (fine.w_n[k] - back[k]) * n_ds;
    carried += n_ds * vector_at(n_back, k).transpose();
  }
  const Vec2 c = Eigen::FullPivLU<Mat2>(carried).setThreshold(no_force).solve(missing);
  for (std::size_t k = 0; k < curve_.n; ++k) w_n[k] += vector_at(n, k).dot(c);
  return w_n;
}

/// What the projection changed of the gas's own traction p_e - p is carried over, so that what it did not change stays.
std::vector<double> InterfaceTransfer::gas_traction(std::span<const double> fine) const {
  std::vector<double> change(fine.begin(), fine.end());
  for (std::size_t k = 0; k < change.size(); ++k) change[k] -= brought_.p_e - brought_.p[k];
  std::vector<double> w_n = at_coarse(change);
  for (std::size_t k = 0; k < curve_.n; ++k) w_n[k] += brought_.p_e - p_[k];
  return w_n;
}

/// The coarser side keeps its own normals and its own normal velocity; only what the projection changed is
/// carried over, so that a uniform motion stays one.
void InterfaceTransfer::give(std::span<const double> x, wire::ProjectedInterface& answer) const {
  std::vector<double> change = answer.v_n;
  for (std::size_t k = 0; k < change.size(); ++k)
    change[k] -= vector_at(answer.n, k).dot(vector_at(brought_.v, k));
  answer.w_n = to_gas_ ? gas_traction(answer.w_n) : solid_traction(x, answer);
  answer.n.resize(2 * curve_.n);
  unit_normals(curve_, x_, answer.n);
  answer.v_n = at_coarse(change);
  for (std::size_t k = 0; k < curve_.n; ++k) answer.v_n[k] += vector_at(answer.n, k).dot(vector_at(v_, k));
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
