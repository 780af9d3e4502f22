#include "reference/piston_chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "common/core/failure.hpp"
#include "common/exact/table.hpp"
#include "reference/chain.hpp"

namespace fsi::reference {

namespace {

using Row = std::vector<double>;

solid::Tensor2 uniaxial(double stretch) {
  return {.a11 = stretch, .a12 = 0, .a21 = 0, .a22 = 1};
}

/// Derivative of the drive by a fourth-order difference.
double rate(const std::function<double(double)>& f, double t) {
  constexpr double h = 1e-3;
  return (8 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12 * h);
}

template <solid::Law L>
class Chain {
 public:
  Chain(const PistonProblem& problem, const L& law, int points);

  void run_to(double t);
  PistonOutput output() const;

 private:
  const PistonProblem& problem_;
  L law_;
  double t_ = 0;
  std::size_t n_solid_, n_gas_;  // springs
  double h_solid_, h_gas_;       // their lengths at rest
  double x_wall_, v_wall_;       // where the last mass is at t = 0 and how fast it moves
  Row label_;                    // reference position (solid) or initial position (gas) of each mass
  Row x_, v_, inverse_mass_;
  Row p_0_;     // initial pressure in the gas springs
  Row stress_;  // P11 of a solid spring, p_e - p of a gas spring

  void place();
  void weigh();
  void compute_stress();
  double stable_step() const;
  void kick(double dt);
  void drift(double dt);
  Row stretches(std::size_t first, std::size_t count, double h) const;
};

template <solid::Law L>
Chain<L>::Chain(const PistonProblem& problem, const L& law, int points) : problem_(problem), law_(law) {
  const double length = problem.x_b - problem.x_a;
  const auto springs = [&](double l) {
    return static_cast<std::size_t>(std::max(8.0, std::round(l * points)));
  };
  n_solid_ = springs(length);
  h_solid_ = length / static_cast<double>(n_solid_);
  const double start = problem.x_b + problem.u_0(problem.x_b);
  const exact::TubeState last = problem.gas_0(problem.x_end);
  const double a = std::sqrt(problem.gamma * last.p / last.rho);
  const double quiet = problem.wall ? 0 : 1.5 * a * problem.times.back();  // no wave comes back from there
  n_gas_ = springs(problem.x_end + quiet - start);
  h_gas_ = (problem.x_end + quiet - start) / static_cast<double>(n_gas_);
  x_wall_ = problem.x_end + quiet;
  v_wall_ = problem.wall ? 0 : last.v;
  place();
  weigh();
  compute_stress();
}

/// Positions, labels and velocities at t = 0.
template <solid::Law L>
void Chain<L>::place() {
  const std::size_t masses = n_solid_ + n_gas_ + 1;
  label_.resize(masses);
  x_.resize(masses);
  v_.resize(masses);
  for (std::size_t k = 0; k <= n_solid_; ++k) {
    label_[k] = problem_.x_b - h_solid_ * static_cast<double>(n_solid_ - k);
    x_[k] = label_[k] + problem_.u_0(label_[k]);
    v_[k] = problem_.v_0(label_[k]);
  }
  for (std::size_t k = n_solid_ + 1; k < masses; ++k) {
    label_[k] = x_wall_ - h_gas_ * static_cast<double>(n_solid_ + n_gas_ - k);
    x_[k] = label_[k];
    v_[k] = problem_.gas_0(std::min(label_[k], problem_.x_end)).v;
  }
}

/// Half of every spring's mass goes to each of its ends.
template <solid::Law L>
void Chain<L>::weigh() {
  Row mass(x_.size(), 0.0);
  for (std::size_t k = 0; k < n_solid_; ++k) {
    mass[k] += 0.5 * problem_.material.rho_bar * h_solid_;
    mass[k + 1] += 0.5 * problem_.material.rho_bar * h_solid_;
  }
  p_0_.resize(n_gas_);
  for (std::size_t k = 0; k < n_gas_; ++k) {
    const double middle = x_wall_ - h_gas_ * (static_cast<double>(n_gas_ - k) - 0.5);
    const exact::TubeState state = problem_.gas_0(std::min(middle, problem_.x_end));
    p_0_[k] = state.p;
    mass[n_solid_ + k] += 0.5 * state.rho * h_gas_;
    mass[n_solid_ + k + 1] += 0.5 * state.rho * h_gas_;
  }
  inverse_mass_.resize(mass.size());
  std::ranges::transform(mass, inverse_mass_.begin(), [](double m) { return 1 / m; });
}

template <solid::Law L>
void Chain<L>::compute_stress() {
  stress_.resize(n_solid_ + n_gas_);
  for (std::size_t k = 0; k < n_solid_; ++k) {
    stress_[k] = law_.P(uniaxial((x_[k + 1] - x_[k]) / h_solid_)).a11;
  }
  for (std::size_t k = 0; k < n_gas_; ++k) {
    const double J = (x_[n_solid_ + k + 1] - x_[n_solid_ + k]) / h_gas_;
    stress_[n_solid_ + k] = problem_.p_e - p_0_[k] * std::pow(J, -problem_.gamma);
  }
}

template <solid::Law L>
double Chain<L>::stable_step() const {
  double fastest = 0;  // waves, in springs per unit time, squared
  for (std::size_t k = 0; k < n_solid_; ++k) {
    const double J = (x_[k + 1] - x_[k]) / h_solid_;
    fastest =
        std::max(fastest, law_.K(uniaxial(J)).k1111 / (problem_.material.rho_bar * h_solid_ * h_solid_));
    if (!(J > 0)) {
      throw Diverged(
          fmt::format("one-dimensional reference: t = {}, x_bar = {}: F11 = {}", t_, label_[k], J));
    }
  }
  for (std::size_t k = 0; k < n_gas_; ++k) {
    const std::size_t i = n_solid_ + k;
    const double J = (x_[i + 1] - x_[i]) / h_gas_;
    const double stiffness = problem_.gamma * p_0_[k] * std::pow(J, -problem_.gamma - 1);
    fastest = std::max(fastest, stiffness * std::max(inverse_mass_[i], inverse_mass_[i + 1]) / h_gas_);
    if (!(J > 0)) {
      throw Diverged(fmt::format("one-dimensional reference: t = {}, gas at x = {} is folded", t_, x_[i]));
    }
  }
  return 1 / std::sqrt(fastest);
}

template <solid::Law L>
void Chain<L>::kick(double dt) {
  for (std::size_t k = 1; k + 1 < x_.size(); ++k)
    v_[k] += dt * inverse_mass_[k] * (stress_[k] - stress_[k - 1]);
}

template <solid::Law L>
void Chain<L>::drift(double dt) {
  t_ += dt;
  for (std::size_t k = 1; k + 1 < x_.size(); ++k) x_[k] += dt * v_[k];
  x_.front() = label_.front() + problem_.drive(t_);
  x_.back() = x_wall_ + v_wall_ * t_;
}

template <solid::Law L>
void Chain<L>::run_to(double t) {
  leapfrog(
      t_, t, [this] { return stable_step(); },
      [this](double dt) {
        kick(0.5 * dt);
        drift(dt);
        compute_stress();
        kick(0.5 * dt);
      });
}

template <solid::Law L>
Row Chain<L>::stretches(std::size_t first, std::size_t count, double h) const {
  Row J(count);
  for (std::size_t k = 0; k < count; ++k) J[k] = (x_[first + k + 1] - x_[first + k]) / h;
  return at_masses(J);
}

template <solid::Law L>
PistonOutput Chain<L>::output() const {
  PistonOutput result;
  result.t = t_;
  const Row F11 = stretches(0, n_solid_, h_solid_);
  for (std::size_t k = 0; k <= n_solid_; ++k) {
    const solid::Tensor2 P = law_.P(uniaxial(F11[k]));
    result.x_bar.push_back(label_[k]);
    result.u.push_back(x_[k] - label_[k]);
    result.v_bar.push_back(k == 0 ? rate(problem_.drive, t_) : v_[k]);
    result.P11.push_back(P.a11);
    result.P22.push_back(P.a22);
  }
  const Row J = stretches(n_solid_, n_gas_, h_gas_);
  const double gas_start = x_wall_ - h_gas_ * static_cast<double>(n_gas_);
  for (std::size_t k = 0; k <= n_gas_; ++k) {
    const double label = k == 0 ? gas_start : label_[n_solid_ + k];
    const exact::TubeState initial = problem_.gas_0(std::min(label, problem_.x_end));
    result.x.push_back(x_[n_solid_ + k]);
    result.rho.push_back(initial.rho / J[k]);
    result.v.push_back(k == n_gas_ ? v_wall_ : v_[n_solid_ + k]);
    result.p.push_back(initial.p * std::pow(J[k], -problem_.gamma));
  }
  return result;
}

}  // namespace

PistonRun solve_piston_while_sound(const PistonProblem& problem, int points) {
  return run_with_law<Chain>(problem, points);
}

std::vector<PistonOutput> solve_piston(const PistonProblem& problem, int points) {
  return whole(solve_piston_while_sound(problem, points));
}

Difference compare(const std::vector<PistonOutput>& fine, const std::vector<PistonOutput>& coarse) {
  Difference d;
  for (std::size_t k = 0; k < std::min(fine.size(), coarse.size()); ++k) {
    const exact::CubicTable gas(fine[k].x, {fine[k].rho, fine[k].v, fine[k].p});
    const exact::CubicTable solid(fine[k].x_bar, {fine[k].u, fine[k].v_bar, fine[k].P11, fine[k].P22});
    const PistonOutput& c = coarse[k];
    d.rho = std::max(d.rho, largest_difference(c.rho, c.x, gas, 0));
    d.v = std::max(d.v, largest_difference(c.v, c.x, gas, 1));
    d.p = std::max(d.p, largest_difference(c.p, c.x, gas, 2));
    d.u_bar = std::max(d.u_bar, largest_difference(c.u, c.x_bar, solid, 0));
    d.v_bar = std::max(d.v_bar, largest_difference(c.v_bar, c.x_bar, solid, 1));
    d.P_bar = std::max({d.P_bar, largest_difference(c.P11, c.x_bar, solid, 2),
                        largest_difference(c.P22, c.x_bar, solid, 3)});
  }
  return d;
}

}  // namespace fsi::reference
