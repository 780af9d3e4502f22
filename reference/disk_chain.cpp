#include "reference/disk_chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "common/core/failure.hpp"
#include "reference/chain.hpp"

namespace fsi::reference {

namespace {

using Row = std::vector<double>;

/// The ring at the interface: a solid ring that turns and half a shell of gas that slips along it, so that
/// its mass along the radius differs from the one across it.
/// Its free flight is therefore in polar coordinates.
struct Rim {
  double a = 1, phi = 0;    // radius and angle, paper's 1 + u_r and u_theta at r_bar = 1
  double v_a = 0, l = 0;    // radial velocity; angular momentum per mass of solid
  double m_s = 0, m_g = 0;  // mass of solid and of gas, per radian

  /// The motion that angular momentum makes: the angle goes on, the radius is pushed outward.
  void turn(double dt) {
    phi += dt * l / (a * a);
    v_a += dt * l * l / (a * a * a) * m_s / (m_s + m_g);
  }
  /// Force (f1, f2) of the solid and radial force of the gas, per radian.
  void kick(double dt, double f1, double f2, double f_gas) {
    const double c = std::cos(phi), s = std::sin(phi);
    v_a += dt * (f1 * c + f2 * s + f_gas) / (m_s + m_g);
    l += dt * a * (f2 * c - f1 * s) / m_s;
  }
};

template <solid::Law L>
class Rings {
 public:
  Rings(const DiskProblem& problem, const L& law, int points);

  void run_to(double t);
  DiskOutput output() const;

 private:
  const DiskProblem& problem_;
  L law_;
  double t_ = 0;
  std::size_t n_solid_, n_gas_;          // springs and shells
  double h_solid_, h_gas_;               // their lengths at rest
  Row r_bar_, q1_, q2_, v1_, v2_, m_;    // solid rings; the last one repeats the rim
  Row along1_, along2_, hoop1_, hoop2_;  // forces of a spring: on its ends opposite, and the same
  Row r_, v_, m_gas_, area_;             // gas rings, the first one is the rim; area of a shell at rest
  Row p_;                                // p - p_e of a shell
  Rim rim_;

  void place_solid();
  void place_gas();
  solid::Tensor2 F(std::size_t spring) const;
  void compute_stress();
  void compute_pressure();
  double stable_step() const;
  double fastest_solid_wave() const;
  double fastest_gas_wave() const;
  double J(std::size_t shell) const;
  void kick(double dt);
  void drift(double dt);
  void show_rim();
  DiskTotals totals() const;
  void report_solid(DiskOutput& result) const;
  void report_gas(DiskOutput& result) const;
};

template <solid::Law L>
Rings<L>::Rings(const DiskProblem& problem, const L& law, int points) : problem_(problem), law_(law) {
  const auto count = [&](double l) {
    return static_cast<std::size_t>(std::max(8.0, std::round(l * points)));
  };
  const double a = std::sqrt(problem.gamma * problem.p_0 / problem.rho_0);
  const double end = problem.b > 0 ? problem.b : 1 + 1.5 * a * problem.times.back();  // no wave comes back
  n_solid_ = count(1);
  h_solid_ = 1 / static_cast<double>(n_solid_);
  n_gas_ = count(end - 1);
  h_gas_ = (end - 1) / static_cast<double>(n_gas_);
  place_solid();
  place_gas();
  compute_stress();
  compute_pressure();
}

/// Half of every spring's mass goes to each of its ends.
template <solid::Law L>
void Rings<L>::place_solid() {
  const std::size_t rings = n_solid_ + 1;
  for (Row* row : {&r_bar_, &q1_, &q2_, &v1_, &v2_, &m_}) row->assign(rings, 0.0);
  for (Row* row : {&along1_, &along2_, &hoop1_, &hoop2_}) row->assign(n_solid_, 0.0);
  for (std::size_t k = 0; k < rings; ++k) {
    r_bar_[k] = h_solid_ * static_cast<double>(k);
    q1_[k] = r_bar_[k];
    if (k > 0) {
      v1_[k] = problem_.v_r(r_bar_[k]);
      v2_[k] = problem_.v_theta(r_bar_[k]);
    }
  }
  for (std::size_t k = 0; k < n_solid_; ++k) {
    const double half = 0.25 * problem_.material.rho_bar * h_solid_ * (r_bar_[k] + r_bar_[k + 1]);
    m_[k] += half;
    m_[k + 1] += half;
  }
  rim_.m_s = m_.back();
  rim_.v_a = v1_.back();
  rim_.l = v2_.back();
}

template <solid::Law L>
void Rings<L>::place_gas() {
  const std::size_t rings = n_gas_ + 1;
  for (Row* row : {&r_, &v_, &m_gas_}) row->assign(rings, 0.0);
  for (Row* row : {&area_, &p_}) row->assign(n_gas_, 0.0);
  for (std::size_t k = 0; k < rings; ++k) r_[k] = 1 + h_gas_ * static_cast<double>(k);
  for (std::size_t k = 0; k < n_gas_; ++k) {
    area_[k] = 0.5 * h_gas_ * (r_[k] + r_[k + 1]);
    m_gas_[k] += 0.5 * problem_.rho_0 * area_[k];
    m_gas_[k + 1] += 0.5 * problem_.rho_0 * area_[k];
  }
  rim_.m_g = m_gas_.front();
  v_.front() = rim_.v_a;
}

/// Deformation gradient of a spring along and across the reference ray, Rbar F Rbar^T: the columns are dq/dr
/// and the quarter turn of q over r_bar, for the ring's points at other angles are rotations of q.
template <solid::Law L>
solid::Tensor2 Rings<L>::F(std::size_t k) const {
  const double twice_r = r_bar_[k] + r_bar_[k + 1];
  return {.a11 = (q1_[k + 1] - q1_[k]) / h_solid_,
          .a12 = -(q2_[k] + q2_[k + 1]) / twice_r,
          .a21 = (q2_[k + 1] - q2_[k]) / h_solid_,
          .a22 = (q1_[k] + q1_[k + 1]) / twice_r};
}

/// paper eq. (49) in the axes of the reference ray, where it is rho q1'' = (1/r) [(r P11)' - P22] and
/// rho q2'' = (1/r) [(r P12)' + P21]; the paper eq. (50) is the same in polar coordinates of q, its last term
/// with the opposite sign. Here as the derivative of the springs' energy, sum of r h psi(F), so that energy
/// and (for an objective law) angular momentum are kept.
template <solid::Law L>
void Rings<L>::compute_stress() {
  for (std::size_t k = 0; k < n_solid_; ++k) {
    const solid::Tensor2 P = law_.P(F(k));
    const double r = 0.5 * (r_bar_[k] + r_bar_[k + 1]);
    along1_[k] = r * P.a11;
    along2_[k] = r * P.a12;
    hoop1_[k] = -0.5 * h_solid_ * P.a22;
    hoop2_[k] = 0.5 * h_solid_ * P.a21;
  }
}

/// Area of a shell over its area at rest.
template <solid::Law L>
double Rings<L>::J(std::size_t k) const {
  return 0.5 * (r_[k + 1] - r_[k]) * (r_[k + 1] + r_[k]) / area_[k];
}

/// paper eq. (48) along the paths of the gas: shells keep their mass (first row) and, in smooth flow, their
/// entropy (third row); the second row is the force -r dp/dr on a ring.
template <solid::Law L>
void Rings<L>::compute_pressure() {
  for (std::size_t k = 0; k < n_gas_; ++k) {
    p_[k] = problem_.p_0 * std::pow(J(k), -problem_.gamma) - problem_.p_e;
  }
}

/// Largest square of a spring's own frequency, with half its mass at each end.
template <solid::Law L>
double Rings<L>::fastest_solid_wave() const {
  double fastest = 0;
  for (std::size_t k = 0; k < n_solid_; ++k) {
    const solid::Tensor2 F_k = F(k);
    const double det = F_k.a11 * F_k.a22 - F_k.a12 * F_k.a21;
    if (!(det > 0)) {
      throw Diverged(
          fmt::format("rotating disk reference: t = {}, r_bar = {}: det F = {}", t_, r_bar_[k], det));
    }
    const solid::Stiffness K = law_.K(F_k);  // acoustic tensor across the rings: K1111, K1121, K1221
    const double mean = 0.5 * (K.k1111 + K.k1221);
    const double largest = mean + std::hypot(0.5 * (K.k1111 - K.k1221), K.k1121);
    fastest = std::max(fastest, 4 * largest / (problem_.material.rho_bar * h_solid_ * h_solid_));
  }
  return fastest;
}

template <solid::Law L>
double Rings<L>::fastest_gas_wave() const {
  double fastest = 0;
  for (std::size_t k = 0; k < n_gas_; ++k) {
    if (!(J(k) > 0)) {
      throw Diverged(fmt::format("rotating disk reference: t = {}, gas at r = {} is folded", t_, r_[k]));
    }
    const double squares = r_[k] * r_[k] + r_[k + 1] * r_[k + 1];
    const double p = p_[k] + problem_.p_e;
    fastest =
        std::max(fastest, 2 * problem_.gamma * p * squares / (J(k) * area_[k] * area_[k] * problem_.rho_0));
  }
  return fastest;
}

template <solid::Law L>
double Rings<L>::stable_step() const {
  return 2 / std::sqrt(std::max(fastest_solid_wave(), fastest_gas_wave()));
}

template <solid::Law L>
void Rings<L>::kick(double dt) {
  for (std::size_t k = 1; k < n_solid_; ++k) {
    v1_[k] += dt / m_[k] * (along1_[k] - along1_[k - 1] + hoop1_[k] + hoop1_[k - 1]);
    v2_[k] += dt / m_[k] * (along2_[k] - along2_[k - 1] + hoop2_[k] + hoop2_[k - 1]);
  }
  // The last spring pulls the rim and the first shell presses on it: p_e - p per area, paper eq. (12).
  const double f1 = hoop1_.back() - along1_.back(), f2 = hoop2_.back() - along2_.back();
  if (problem_.load_on_reference) {
    rim_.kick(dt, f1 - p_.front(), f2, 0);
  } else {
    rim_.kick(dt, f1, f2, -rim_.a * p_.front());
  }
  for (std::size_t k = 1; k < n_gas_; ++k) v_[k] += dt / m_gas_[k] * r_[k] * (p_[k - 1] - p_[k]);
}

template <solid::Law L>
void Rings<L>::drift(double dt) {
  t_ += dt;
  for (std::size_t k = 1; k < n_solid_; ++k) {
    q1_[k] += dt * v1_[k];
    q2_[k] += dt * v2_[k];
  }
  rim_.turn(0.5 * dt);
  rim_.a += dt * rim_.v_a;
  rim_.turn(0.5 * dt);
  for (std::size_t k = 1; k < n_gas_; ++k) r_[k] += dt * v_[k];
  show_rim();
}

/// The rim as the last solid ring and as the first gas ring.
template <solid::Law L>
void Rings<L>::show_rim() {
  const double c = std::cos(rim_.phi), s = std::sin(rim_.phi);
  q1_.back() = rim_.a * c;
  q2_.back() = rim_.a * s;
  r_.front() = rim_.a;
}

template <solid::Law L>
void Rings<L>::run_to(double t) {
  leapfrog(
      t_, t, [this] { return stable_step(); },
      [this](double dt) {
        kick(0.5 * dt);
        drift(dt);
        compute_stress();
        compute_pressure();
        kick(0.5 * dt);
      });
}

template <solid::Law L>
DiskTotals Rings<L>::totals() const {
  const double v_phi = rim_.l / rim_.a;
  DiskTotals sum;
  sum.angular_momentum = rim_.m_s * rim_.l;
  sum.kinetic_solid = 0.5 * rim_.m_s * (rim_.v_a * rim_.v_a + v_phi * v_phi);
  sum.kinetic_gas = 0.5 * rim_.m_g * rim_.v_a * rim_.v_a;
  for (std::size_t k = 1; k < n_solid_; ++k) {
    sum.kinetic_solid += 0.5 * m_[k] * (v1_[k] * v1_[k] + v2_[k] * v2_[k]);
    sum.angular_momentum += m_[k] * (q1_[k] * v2_[k] - q2_[k] * v1_[k]);
  }
  for (std::size_t k = 0; k < n_solid_; ++k) {
    sum.strain += 0.5 * h_solid_ * (r_bar_[k] + r_bar_[k + 1]) * law_.psi(F(k));
  }
  const double exponent = 1 - problem_.gamma;
  for (std::size_t k = 1; k < n_gas_; ++k) sum.kinetic_gas += 0.5 * m_gas_[k] * v_[k] * v_[k];
  for (std::size_t k = 0; k < n_gas_; ++k) {
    const double heat = -problem_.p_0 / exponent * std::expm1(exponent * std::log(J(k)));
    sum.gas += area_[k] * (heat + problem_.p_e * (J(k) - 1));
  }
  for (double* value : {&sum.kinetic_solid, &sum.kinetic_gas, &sum.strain, &sum.gas, &sum.angular_momentum}) {
    *value *= 2 * std::numbers::pi;
  }
  return sum;
}

template <solid::Law L>
void Rings<L>::report_solid(DiskOutput& result) const {
  const std::size_t rings = n_solid_ + 1;
  Row slope1(n_solid_), slope2(n_solid_);
  for (std::size_t k = 0; k < n_solid_; ++k) {
    slope1[k] = F(k).a11;
    slope2[k] = F(k).a21;
  }
  const Row F11 = at_masses(slope1, Start::mirror), F21 = at_masses(slope2, Start::mirror);
  result.r_bar = r_bar_;
  result.u2 = q2_;
  result.v1 = v1_;
  result.v2 = v2_;
  const double c = std::cos(rim_.phi), s = std::sin(rim_.phi), v_phi = rim_.l / rim_.a;
  result.v1.back() = rim_.v_a * c - v_phi * s;
  result.v2.back() = rim_.v_a * s + v_phi * c;
  for (std::size_t k = 0; k < rings; ++k) {
    const double F12 = k == 0 ? -F21[0] : -q2_[k] / r_bar_[k];
    const double F22 = k == 0 ? F11[0] : q1_[k] / r_bar_[k];
    const solid::Tensor2 P = law_.P({.a11 = F11[k], .a12 = F12, .a21 = F21[k], .a22 = F22});
    result.u1.push_back(q1_[k] - r_bar_[k]);
    result.P11.push_back(P.a11);
    result.P12.push_back(P.a12);
    result.P21.push_back(P.a21);
    result.P22.push_back(P.a22);
  }
}

template <solid::Law L>
void Rings<L>::report_gas(DiskOutput& result) const {
  Row in_shells(n_gas_);
  for (std::size_t k = 0; k < n_gas_; ++k) in_shells[k] = J(k);
  result.r = r_;
  result.v = v_;
  result.v.front() = rim_.v_a;
  for (const double J : at_masses(in_shells)) {
    result.rho.push_back(problem_.rho_0 / J);
    result.p.push_back(problem_.p_0 * std::pow(J, -problem_.gamma));
  }
}

template <solid::Law L>
DiskOutput Rings<L>::output() const {
  DiskOutput result;
  result.t = t_;
  report_solid(result);
  report_gas(result);
  result.totals = totals();
  return result;
}

}  // namespace

DiskRun solve_disk_while_sound(const DiskProblem& problem, int points) {
  return run_with_law<Rings>(problem, points);
}

std::vector<DiskOutput> solve_disk(const DiskProblem& problem, int points) {
  return whole(solve_disk_while_sound(problem, points));
}

Difference compare(const DiskOutput& fine, const DiskOutput& coarse) {
  const exact::CubicTable gas(fine.r, {fine.rho, fine.v, fine.p});
  const exact::CubicTable solid(fine.r_bar,
                                {fine.u1, fine.u2, fine.v1, fine.v2, fine.P11, fine.P12, fine.P21, fine.P22});
  const auto in_gas = [&](const Row& a, std::size_t column) {
    return largest_difference(a, coarse.r, gas, column);
  };
  const auto in_solid = [&](const Row& a, std::size_t column) {
    return largest_difference(a, coarse.r_bar, solid, column);
  };
  return {.rho = in_gas(coarse.rho, 0),
          .v = in_gas(coarse.v, 1),
          .p = in_gas(coarse.p, 2),
          .u_bar = std::max(in_solid(coarse.u1, 0), in_solid(coarse.u2, 1)),
          .v_bar = std::max(in_solid(coarse.v1, 2), in_solid(coarse.v2, 3)),
          .P_bar = std::max({in_solid(coarse.P11, 4), in_solid(coarse.P12, 5), in_solid(coarse.P21, 6),
                             in_solid(coarse.P22, 7)})};
}

}  // namespace fsi::reference
