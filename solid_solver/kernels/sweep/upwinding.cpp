#include "solid_solver/kernels/sweep/upwinding.hpp"

namespace fsi::solid {

template <class Row, Limiter limiter>
void StressUpwinding<Row, limiter>::find_shares(RowRun run) const {
  const Row row(metrics_, run.j);
  const AcousticRows along1 = work_.acoustic1(), along2 = work_.acoustic2(run.j);
  const StiffnessRows stiff = work_.stiffness(run.j);
  double *share = work_.share(run.j), *rest1 = work_.rest1(), *rest2 = work_.rest2(run.j);
  const double limit = d_.coupling_limit, per_rho = 1.0 / d_.rho;
#pragma omp simd
  for (int i = run.begin; i < run.end; ++i) {
    const SymmetricTensor2 A1 = along1.at(i), A2 = along2.at(i);
    const double s = upwind_share(wave_coupling(A1, A2, row.acoustic12(i, stiff.at(i))), limit);
    share[i] = s;
    rest1[i] = (1.0 - s) * std::sqrt(per_rho * wave_eigenvalues(A1).x);
    rest2[i] = (1.0 - s) * std::sqrt(per_rho * wave_eigenvalues(A2).x);
  }
  const StencilRow v1(d_.q, plane::v1, run.j), v2(d_.q, plane::v2, run.j);
  const ConstStressRow P(d_.q, run.j);
  const StressRow centre = work_.centre_stress(run.j);
  const double dt = d_.dt;
#pragma omp simd
  for (int i = run.begin; i < run.end; ++i) {
    const Pair s1 = v1.template half_slopes<limiter>(i), s2 = v2.template half_slopes<limiter>(i);
    const Pair L1 = row.gradient(i, s1.x, s1.y), L2 = row.gradient(i, s2.x, s2.y);
    const Tensor2 dP = contract(stiff.at(i), {L1.x, L1.y, L2.x, L2.y});
    centre.P11[i] = P.P11[i] + dt * dP.a11;
    centre.P12[i] = P.P12[i] + dt * dP.a12;
    centre.P21[i] = P.P21[i] + dt * dP.a21;
    centre.P22[i] = P.P22[i] + dt * dP.a22;
  }
}

template <class Row, Limiter limiter>
void StressUpwinding<Row, limiter>::correct_faces1(RowRun run) const {
  const int j = run.j;
  const FaceRows left = work_.east(), right = work_.west(), face = work_.faces1();
  const ConstStressRow P(d_.q, j), centre = work_.centre_stress(j);
  const StressRow decay = work_.decay1();
  const double *share = work_.share(j), *rest = work_.rest1();
#pragma omp simd
  for (int i = run.begin; i <= run.end; ++i) {
    const double s = 0.5 * (share[i - 1] + share[i]), c = 0.5 * (rest[i - 1] + rest[i]);
    take_back(s, left.v1[i - 1], right.v1[i], face.v1[i]);
    take_back(s, left.v2[i - 1], right.v2[i], face.v2[i]);
    decay.P11[i] = c * along(i, P.P11, centre.P11);
    decay.P12[i] = c * along(i, P.P12, centre.P12);
    decay.P21[i] = c * along(i, P.P21, centre.P21);
    decay.P22[i] = c * along(i, P.P22, centre.P22);
  }
}

template <class Row, Limiter limiter>
void StressUpwinding<Row, limiter>::correct_faces2(RowRun run) const {
  const int j = run.j;
  const FaceRows left = work_.north(j - 1), right = work_.south(), face = work_.faces2(j);
  const ConstStressRow A(d_.q, j - 2), B(d_.q, j - 1), C(d_.q, j), D(d_.q, j + 1);
  const ConstStressRow centre = work_.centre_stress(j), below = work_.centre_stress(j - 1);
  const StressRow decay = work_.decay2(j);
  const double *share = work_.share(j), *share_below = work_.share(j - 1);
  const double *rest = work_.rest2(j), *rest_below = work_.rest2(j - 1);
#pragma omp simd
  for (int i = run.begin; i < run.end; ++i) {
    const double s = 0.5 * (share_below[i] + share[i]), c = 0.5 * (rest_below[i] + rest[i]);
    take_back(s, left.v1[i], right.v1[i], face.v1[i]);
    take_back(s, left.v2[i], right.v2[i], face.v2[i]);
    decay.P11[i] = c * jump(centre.P11[i] - below.P11[i], A.P11[i], B.P11[i], C.P11[i], D.P11[i]);
    decay.P12[i] = c * jump(centre.P12[i] - below.P12[i], A.P12[i], B.P12[i], C.P12[i], D.P12[i]);
    decay.P21[i] = c * jump(centre.P21[i] - below.P21[i], A.P21[i], B.P21[i], C.P21[i], D.P21[i]);
    decay.P22[i] = c * jump(centre.P22[i] - below.P22[i], A.P22[i], B.P22[i], C.P22[i], D.P22[i]);
  }
}

template <class Row, Limiter limiter>
void StressUpwinding<Row, limiter>::find_decay(RowRun run) const {
  const int j = run.j;
  const Row row(metrics_, j);
  const StressRow along1 = work_.decay1(), low = work_.decay2(j), high = work_.decay2(j + 1);
  const double half_dt = 0.5 * d_.dt;
#pragma omp simd
  for (int i = run.begin; i < run.end; ++i) {
    const double factor = half_dt * row.inverse_jacobian(i);
    low.P11[i] = factor * ((along1.P11[i + 1] - along1.P11[i]) + (high.P11[i] - low.P11[i]));
    low.P12[i] = factor * ((along1.P12[i + 1] - along1.P12[i]) + (high.P12[i] - low.P12[i]));
    low.P21[i] = factor * ((along1.P21[i + 1] - along1.P21[i]) + (high.P21[i] - low.P21[i]));
    low.P22[i] = factor * ((along1.P22[i + 1] - along1.P22[i]) + (high.P22[i] - low.P22[i]));
  }
}

/// A load is there whatever waves do: if its traction decayed along the side, the characteristics would push the side back in
/// every step, and under pressure the push grows what it comes from.
template <class Row, Limiter limiter>
void StressUpwinding<Row, limiter>::spare_tractions(RowRun run) const {
  const int j = run.j, last1 = d_.q.layout.n1 - 1, last2 = d_.q.layout.n2 - 1;
  const StressRow decay = work_.decay2(j);
  const auto loaded = [&](Side side) { return d_.loaded[static_cast<std::size_t>(side)]; };
  const bool row_loaded = (j == 0 && loaded(Side::bottom)) || (j == last2 && loaded(Side::top));
  const auto spare = [&](int i, const Vec2& across) {
    const Vec2 n0 = across.normalized();
    const Vec2 of_side = {n0.x() * decay.P11[i] + n0.y() * decay.P21[i],
                          n0.x() * decay.P12[i] + n0.y() * decay.P22[i]};
    decay.subtract(i, n0.x() * of_side.x(), n0.x() * of_side.y(), n0.y() * of_side.x(), n0.y() * of_side.y());
  };
  const auto spare_end = [&](int i) {
    if (row_loaded) {  // two tractions are all of P
      decay.subtract(i, decay.P11[i], decay.P12[i], decay.P21[i], decay.P22[i]);
    } else {
      spare(i, metrics_.at(i, j).r1);
    }
  };
  if (run.begin == 0 && loaded(Side::left)) spare_end(0);
  if (run.end == last1 + 1 && loaded(Side::right)) spare_end(last1);
  for (int i = run.begin; row_loaded && i < run.end; ++i) spare(i, metrics_.at(i, j).r2);
}

template <class Row, Limiter limiter>
void StressUpwinding<Row, limiter>::add_decay(RowRun run) const {
  const StressRow decay = work_.decay2(run.j), P(d_.next, run.j);
#pragma omp simd
  for (int i = run.begin; i < run.end; ++i) {
    P.P11[i] += decay.P11[i];
    P.P12[i] += decay.P12[i];
    P.P21[i] += decay.P21[i];
    P.P22[i] += decay.P22[i];
  }
}

template class StressUpwinding<MappedRow, Limiter::none>;
template class StressUpwinding<MappedRow, Limiter::mc>;
template class StressUpwinding<MappedRow, Limiter::minmod>;
template class StressUpwinding<CartesianRow, Limiter::none>;
template class StressUpwinding<CartesianRow, Limiter::mc>;
template class StressUpwinding<CartesianRow, Limiter::minmod>;

}  // namespace fsi::solid
