#pragma once
/// One time step of paper eq. (32) at the discretised points of a grid, row by row.
///
/// Row j goes through four loops, each a pass over whole runs of points of structure-of-arrays rows that stay
/// in cache: `predict` (F, K, slopes, states at t + dt/2), `solve_faces2` (faces between rows j - 1 and j),
/// `update` (row j - 1, whose four faces are now known), what dissipation and relaxation add to it, and
/// `solve_faces1` (faces inside row j). One Riemann problem per face.

#include <algorithm>
#include <limits>
#include <utility>

#include "solid_solver/kernels/sweep_rows.hpp"
#include "solid_solver/solid_points.hpp"

namespace fsi::solid {

/// What a sweep looks for besides making its step.
enum class Look {
  soundness,  ///< whether det F > 0 and all waves are real
  all         ///< wave speeds as well, for the next time step
};

/// Extremes over the points of a sweep, for the next time step and the health of the numbers. Those of the waves
/// are there where the sweep looked for all.
struct SweepResult {
  double rate_squared = 0;  ///< largest (sum over directions of c_p |grad r|)^2 [1/time^2]
  /// Largest (difference of the two directions' c_p |grad r|)^2 + 4 |X|^2 (shared_upwinding) [1/time^2]; 0
  /// where it is not measured.
  double spread_squared = 0;  ///< [1/time^2]
  double min_det_F = std::numeric_limits<double>::infinity();
  double min_phi_s = std::numeric_limits<double>::infinity();  ///< smallest phi_s |grad r|^2
  double broken = 0;                                           ///< points with det F <= 0 or phi_s <= 0 [-]
  double settled = 0;  ///< ghost points that took the acoustic matrix of the body beside them [-]

  void add(const SweepResult& other) {
    rate_squared = std::max(rate_squared, other.rate_squared);
    spread_squared = std::max(spread_squared, other.spread_squared);
    min_det_F = std::min(min_det_F, other.min_det_F);
    min_phi_s = std::min(min_phi_s, other.min_phi_s);
    broken += other.broken;
    settled += other.settled;
  }
};

/// What moves u in paper eq. (37): this share of the mean of the old and the new velocity, and of the
/// predicted one at t + dt/2 what is left. The paper takes the latter alone; with the relaxation (41) long
/// waves then grow. At 2/3 the integral of v is of third order in time, from 3/4 on no wave grows
/// (docs/theory_solid.md, stability).
inline constexpr double mean_velocity_share = 0.8;

/// Rows of work space a sweep needs.
inline constexpr int sweep_work_rows = 68;

/// Fields and numbers of one sweep.
struct SweepData {
  const SolidPoints* points = nullptr;
  ConstFieldView q;      ///< unknowns at t, both ghost lines set
  FieldView next;        ///< unknowns at t + dt; ghosts are not set
  ConstFieldView force;  ///< body force at t + dt/2, two planes or none
  FieldView work;        ///< work rows: layout (n1, sweep_work_rows), one plane, zero at birth
  double rho = 1;        ///< [mass/volume]
  double dt = 0;         ///< [time]
  Look look = Look::all;
  bool measures_spread = true;  ///< SweepResult::spread_squared; only relaxation and (39) need it
  /// Those that are advanced; two rows beside them are read.
  grid::RowRange rows = {0, std::numeric_limits<int>::max()};
};

template <Law L, class Row, Limiter limiter>
class GodunovSweep {
 public:
  GodunovSweep(const SweepData& data, const ReferenceMetrics& metrics, const L& law)
      : d_(data), metrics_(metrics), law_(law) {}

  /// `after` is called for each run of points, RowRun, whose step was made; all of their row and the rows
  /// beside it keep the state at t.
  template <class AfterRow>
  SweepResult run(const AfterRow& after) const;
  SweepResult run() const {
    return run([](RowRun) {});
  }

 private:
  // Functions of their own: inlined into run() they would be too much for the compiler to inline what their
  // loops call, and no loop with a call in it vectorises.
  [[gnu::noinline]] void predict(RowRun run) const;
  [[gnu::noinline]] SweepResult waves(RowRun run) const;
  [[gnu::noinline]] double spread_squared(RowRun run) const;
  [[gnu::noinline]] double settle(RowRun run) const;
  [[gnu::noinline]] void solve_faces1(RowRun run) const;
  [[gnu::noinline]] void solve_faces2(RowRun run) const;
  [[gnu::noinline]] SweepResult update(RowRun run) const;
  void look_at_waves(RowRun run, SweepResult& result) const;

  // Work rows; those of a row number exist for the present and the last row.
  double* work(int row) const { return d_.work.row(0, row); }
  FaceRows face_rows(int first) const {
    return {work(first), work(first + 1), work(first + 2), work(first + 3)};
  }
  AcousticRows acoustic_rows(int first) const { return {work(first), work(first + 1), work(first + 2)}; }
  FaceRows east() const { return face_rows(0); }
  FaceRows west() const { return face_rows(4); }
  FaceRows south() const { return face_rows(8); }
  FaceRows north(int j) const { return face_rows(12 + 4 * (j & 1)); }
  FaceRows faces1() const { return face_rows(20); }
  FaceRows faces2(int j) const { return face_rows(24 + 4 * (j & 1)); }
  AcousticRows acoustic1() const { return acoustic_rows(32); }
  AcousticRows acoustic2(int j) const { return acoustic_rows(35 + 3 * (j & 1)); }
  StiffnessRows stiffness(int j) const {
    const int k = 41 + 10 * (j & 1);
    return {work(k),     work(k + 1), work(k + 2), work(k + 3), work(k + 4),
            work(k + 5), work(k + 6), work(k + 7), work(k + 8), work(k + 9)};
  }
  /// Velocity of the points at t + dt/2.
  double* centre(int c, int j) const { return work(62 + 2 * c + (j & 1)); }
  /// det F, but no number where waves are not real.
  double* soundness(int j) const { return work(66 + (j & 1)); }
  const double* force(int c, int j) const { return d_.force.planes > 0 ? d_.force.row(c, j) : work(61); }

  const SweepData& d_;
  const ReferenceMetrics& metrics_;
  const L& law_;
};

template <Law L, class Row, Limiter limiter>
template <class AfterRow>
SweepResult GodunovSweep<L, Row, limiter>::run(const AfterRow& after) const {
  const int n2 = d_.q.layout.n2;
  const grid::RowRange rows = {d_.rows.first, std::min(d_.rows.end, n2)};
  const SolidPoints& points = *d_.points;
  SweepResult result;
  if (rows.first >= rows.end) return result;
  for (int j = rows.first - 1; j <= rows.end; ++j) {
    for (const auto& [begin, end] : points.predicted(j)) predict({j, begin, end});
    for (const auto& [begin, end] : points.beside(j)) {
      const double settled = settle({j, begin, end});
      if (rows.contains(std::clamp(j, 0, n2 - 1))) result.settled += settled;
    }
    if (d_.look == Look::all && rows.contains(j)) {
      for (const auto& [begin, end] : points.discretised(j)) look_at_waves({j, begin, end}, result);
    }
    if (j >= rows.first) {
      for (const auto& [begin, end] : points.faces(j)) solve_faces2({j, begin, end});
    }
    if (j > rows.first) {
      for (const auto& [begin, end] : points.discretised(j - 1)) {
        const RowRun run = {j - 1, begin, end};
        result.add(update(run));
        after(run);
      }
    }
    if (rows.contains(j)) {
      for (const auto& [begin, end] : points.discretised(j)) solve_faces1({j, begin, end});
    }
  }
  return result;
}

template <Law L, class Row, Limiter limiter>
void GodunovSweep<L, Row, limiter>::look_at_waves(RowRun run, SweepResult& result) const {
  result.add(waves(run));
  if (d_.measures_spread) result.spread_squared = std::max(result.spread_squared, spread_squared(run));
}

/// K at t + dt/2 from F of u + dt/2 v; slopes of v and P; states of the four faces and of the centre at t +
/// dt/2, the last giving its share of u, paper eq. (37). Differs from the paper: the acoustic matrix of a
/// face is the mean of those of its two points, which the time step needs anyway, instead of one from an F
/// differenced about the face. It multiplies a jump of O(h^3) in smooth flow.
template <Law L, class Row, Limiter limiter>
void GodunovSweep<L, Row, limiter>::predict(RowRun run) const {
  const int j = run.j;
  const Row row(metrics_, j);
  const StateRows q(d_.q, j);
  const FaceRows to_east = east(), to_west = west(), to_north = north(j), to_south = south();
  const AcousticRows along1 = acoustic1(), along2 = acoustic2(j);
  const StiffnessRows stiff = stiffness(j);
  const double *b1 = force(0, j), *b2 = force(1, j);
  double *centre1 = centre(0, j), *centre2 = centre(1, j), *sound = soundness(j);
  const L law = law_;
  const double dt = d_.dt, dt_rho = dt / d_.rho;
#pragma omp simd
  for (int i = run.begin; i < run.end; ++i) {
    const Tensor2 F = deformation_gradient(row, q, i, 0.5 * dt);
    const Stiffness K = law.K(F);
    stiff.set(i, K);
    const SymmetricTensor2 A1 = row.acoustic1(i, K), A2 = row.acoustic2(i, K);
    along1.set(i, A1);
    along2.set(i, A2);

    const double J = determinant(F);
    sound[i] =
        J > 0.0 && !(bears_waves(A1) && bears_waves(A2)) ? std::numeric_limits<double>::quiet_NaN() : J;

    const Pair s1 = q.v1.template half_slopes<limiter>(i), s2 = q.v2.template half_slopes<limiter>(i);
    const Pair s11 = q.P11.template half_slopes<limiter>(i), s12 = q.P12.template half_slopes<limiter>(i);
    const Pair s21 = q.P21.template half_slopes<limiter>(i), s22 = q.P22.template half_slopes<limiter>(i);
    const Pair L1 = row.gradient(i, s1.x, s1.y), L2 = row.gradient(i, s2.x, s2.y);
    const Tensor2 dP = contract(K, {L1.x, L1.y, L2.x, L2.y});
    const double v1 =
        q.v1[i] + dt_rho * (row.gradient(i, s11.x, s11.y).x + row.gradient(i, s21.x, s21.y).y + 0.5 * b1[i]);
    const double v2 =
        q.v2[i] + dt_rho * (row.gradient(i, s12.x, s12.y).x + row.gradient(i, s22.x, s22.y).y + 0.5 * b2[i]);
    const Tensor2 P = {q.P11[i] + dt * dP.a11, q.P12[i] + dt * dP.a12, q.P21[i] + dt * dP.a21,
                       q.P22[i] + dt * dP.a22};
    centre1[i] = v1;
    centre2[i] = v2;
    to_east.set(i, v1 + s1.x, v2 + s2.x,
                row.force_east(i, {P.a11 + s11.x, P.a12 + s12.x, P.a21 + s21.x, P.a22 + s22.x}));
    to_west.set(i, v1 - s1.x, v2 - s2.x,
                row.force_west(i, {P.a11 - s11.x, P.a12 - s12.x, P.a21 - s21.x, P.a22 - s22.x}));
    to_north.set(i, v1 + s1.y, v2 + s2.y,
                 row.force_north(i, {P.a11 + s11.y, P.a12 + s12.y, P.a21 + s21.y, P.a22 + s22.y}));
    to_south.set(i, v1 - s1.y, v2 - s2.y,
                 row.force_south(i, {P.a11 - s11.y, P.a12 - s12.y, P.a21 - s21.y, P.a22 - s22.y}));
  }
}

/// What `predict` left in the rows of run.j; for SweepResult::rate_squared and min_phi_s.
template <Law L, class Row, Limiter limiter>
SweepResult GodunovSweep<L, Row, limiter>::waves(RowRun run) const {
  const Row row(metrics_, run.j);
  const AcousticRows along1 = acoustic1(), along2 = acoustic2(run.j);
  double rate = 0, min_phi = std::numeric_limits<double>::infinity();
#pragma omp simd reduction(max : rate) reduction(min : min_phi)
  for (int i = run.begin; i < run.end; ++i) {
    const double scale = row.inverse_jacobian(i) * row.inverse_jacobian(i);
    const Pair phi1 = wave_eigenvalues(along1.at(i)), phi2 = wave_eigenvalues(along2.at(i));
    const double fastest = scale * (phi1.x + phi2.x + 2.0 * std::sqrt(phi1.x * phi2.x));
    const double slowest = scale * (phi1.y < phi2.y ? phi1.y : phi2.y);
    rate = rate < fastest ? fastest : rate;
    min_phi = slowest < min_phi ? slowest : min_phi;
  }
  return {.rate_squared = rate / d_.rho, .min_phi_s = min_phi};
}

/// What `predict` left in the rows of run.j; for SweepResult::spread_squared.
template <Law L, class Row, Limiter limiter>
double GodunovSweep<L, Row, limiter>::spread_squared(RowRun run) const {
  const Row row(metrics_, run.j);
  const AcousticRows along1 = acoustic1(), along2 = acoustic2(run.j);
  const StiffnessRows stiff = stiffness(run.j);
  double spread = 0;
#pragma omp simd reduction(max : spread)
  for (int i = run.begin; i < run.end; ++i) {
    const SymmetricTensor2 A1 = along1.at(i), A2 = along2.at(i);
    const Pair phi1 = wave_eigenvalues(A1), phi2 = wave_eigenvalues(A2);
    const double shared = shared_upwinding(A1, A2, row.acoustic12(i, stiff.at(i)));
    const double scale = row.inverse_jacobian(i) * row.inverse_jacobian(i);
    const double apart = scale * (phi1.x + phi2.x - 2.0 * std::sqrt(phi1.x * phi2.x) + 4.0 * shared);
    spread = spread < apart ? apart : spread;
  }
  return spread / d_.rho;
}

/// Ghost points have a displacement that was extrapolated, and beside a corner with a singular stress it may
/// turn the material inside out or leave it no wave speed, though the body itself is far from that. What such
/// a point brings to its face is then its state at t, and the acoustic matrix of the point of the body beside
/// it. Returns the number of such points.
template <Law L, class Row, Limiter limiter>
double GodunovSweep<L, Row, limiter>::settle(RowRun run) const {
  const int j = run.j;
  double settled = 0;
  for (int i = run.begin; i < run.end; ++i) {
    const AcousticRows along1 = acoustic1(), along2 = acoustic2(j);
    if (bears_waves(along1.at(i)) && bears_waves(along2.at(i))) continue;
    for (const auto& [a, b] : {std::pair(i - 1, j), {i + 1, j}, {i, j - 1}, {i, j + 1}}) {
      if (b < 0 || b >= d_.q.layout.n2 || !d_.points->is_discretised(a, b)) continue;
      const Stiffness K = law_.K(deformation_gradient(Row(metrics_, b), StateRows(d_.q, b), a, 0.5 * d_.dt));
      const Row row(metrics_, j);
      along1.set(i, row.acoustic1(i, K));
      along2.set(i, row.acoustic2(i, K));
      const StateRows q(d_.q, j);
      const Tensor2 P = {q.P11[i], q.P12[i], q.P21[i], q.P22[i]};
      east().set(i, q.v1[i], q.v2[i], row.force_east(i, P));
      west().set(i, q.v1[i], q.v2[i], row.force_west(i, P));
      north(j).set(i, q.v1[i], q.v2[i], row.force_north(i, P));
      south().set(i, q.v1[i], q.v2[i], row.force_south(i, P));
      settled += 1;
      break;
    }
  }
  return settled;
}

/// Faces i - 1/2 on both sides of the points of a run of the present row.
template <Law L, class Row, Limiter limiter>
void GodunovSweep<L, Row, limiter>::solve_faces1(RowRun run) const {
  const FaceRows left = east(), right = west(), solution = faces1();
  const AcousticRows A = acoustic1();
  const double half_rho = 0.5 * d_.rho;
#pragma omp simd
  for (int i = run.begin; i <= run.end; ++i) {
    const SymmetricTensor2 rho_A = {.a11 = half_rho * (A.a11[i - 1] + A.a11[i]),
                                    .a12 = half_rho * (A.a12[i - 1] + A.a12[i]),
                                    .a22 = half_rho * (A.a22[i - 1] + A.a22[i])};
    solution.set(i, riemann_solution(rho_A, left.at(i - 1), right.at(i)));
  }
}

/// Faces j - 1/2 between the last row and row j.
template <Law L, class Row, Limiter limiter>
void GodunovSweep<L, Row, limiter>::solve_faces2(RowRun run) const {
  const int j = run.j;
  const FaceRows left = north(j - 1), right = south(), solution = faces2(j);
  const AcousticRows A = acoustic2(j - 1), B = acoustic2(j);
  const double half_rho = 0.5 * d_.rho;
#pragma omp simd
  for (int i = run.begin; i < run.end; ++i) {
    const SymmetricTensor2 rho_A = {.a11 = half_rho * (A.a11[i] + B.a11[i]),
                                    .a12 = half_rho * (A.a12[i] + B.a12[i]),
                                    .a22 = half_rho * (A.a22[i] + B.a22[i])};
    solution.set(i, riemann_solution(rho_A, left.at(i), right.at(i)));
  }
}

/// paper eq. (35): momentum from the forces on the four faces; paper eq. (36): stress from the face
/// velocities with the point's own K and grad r, exactly zero for a uniform velocity; paper eq. (37): what
/// the mean of the old and the new velocity brings to the displacement.
template <Law L, class Row, Limiter limiter>
SweepResult GodunovSweep<L, Row, limiter>::update(RowRun run) const {
  const int j = run.j;
  const Row row(metrics_, j);
  const FaceRows along1 = faces1(), low = faces2(j), high = faces2(j + 1);
  const StiffnessRows stiff = stiffness(j);
  const double *b1 = force(0, j), *b2 = force(1, j);
  const double *v1 = d_.q.row(plane::v1, j), *v2 = d_.q.row(plane::v2, j);
  const double *P11 = d_.q.row(plane::P11, j), *P12 = d_.q.row(plane::P12, j), *P21 = d_.q.row(plane::P21, j),
               *P22 = d_.q.row(plane::P22, j);
  double *next_u1 = d_.next.row(plane::u1, j), *next_u2 = d_.next.row(plane::u2, j);
  double *next_v1 = d_.next.row(plane::v1, j), *next_v2 = d_.next.row(plane::v2, j);
  double *next_P11 = d_.next.row(plane::P11, j), *next_P12 = d_.next.row(plane::P12, j),
         *next_P21 = d_.next.row(plane::P21, j), *next_P22 = d_.next.row(plane::P22, j);
  const double *u1 = d_.q.row(plane::u1, j), *u2 = d_.q.row(plane::u2, j);
  const double *centre1 = centre(0, j), *centre2 = centre(1, j), *sound = soundness(j);
  const double dt = d_.dt, dt_rho = dt / d_.rho, dt_mean = 0.5 * mean_velocity_share * dt,
               dt_centre = (1.0 - mean_velocity_share) * dt;
  double min_J = std::numeric_limits<double>::infinity(), broken = 0;
#pragma omp simd reduction(min : min_J) reduction(+ : broken)
  for (int i = run.begin; i < run.end; ++i) {
    const double per_area = row.inverse_area(i);
    const double f1 = (along1.f1[i + 1] - along1.f1[i]) + (high.f1[i] - low.f1[i]);
    const double f2 = (along1.f2[i + 1] - along1.f2[i]) + (high.f2[i] - low.f2[i]);
    const double w1 = v1[i] + dt_rho * (per_area * f1 + b1[i]);
    const double w2 = v2[i] + dt_rho * (per_area * f2 + b2[i]);
    next_v1[i] = w1;
    next_v2[i] = w2;
    next_u1[i] = (u1[i] + dt_centre * centre1[i]) + dt_mean * (v1[i] + w1);
    next_u2[i] = (u2[i] + dt_centre * centre2[i]) + dt_mean * (v2[i] + w2);
    const Pair L1 = row.gradient(i, along1.v1[i + 1] - along1.v1[i], high.v1[i] - low.v1[i]);
    const Pair L2 = row.gradient(i, along1.v2[i + 1] - along1.v2[i], high.v2[i] - low.v2[i]);
    const Tensor2 dP = contract(stiff.at(i), {L1.x, L1.y, L2.x, L2.y});
    next_P11[i] = P11[i] + dt * dP.a11;
    next_P12[i] = P12[i] + dt * dP.a12;
    next_P21[i] = P21[i] + dt * dP.a21;
    next_P22[i] = P22[i] + dt * dP.a22;
    min_J = sound[i] < min_J ? sound[i] : min_J;
    broken += sound[i] > 0.0 ? 0.0 : 1.0;
  }
  return {.min_det_F = min_J, .broken = broken};
}

}  // namespace fsi::solid
