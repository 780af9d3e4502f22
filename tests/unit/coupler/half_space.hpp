#pragma once
/// A half-space of linear material on a line: the solid or the gas of the one-dimensional model problem.

#include <array>
#include <cmath>
#include <vector>

namespace fsi::coupler::testing {

/// Density and wave speed.
struct Medium {
  double rho = 1;
  double c = 1;
  double z() const { return rho * c; }
};

/// Velocity v and stress s at the distances 0, h, 2h, ... from the interface; `side` is +1 for the gas (to
/// the right of the interface) and -1 for the solid. s + side z v travels to the interface, s - side z v away
/// from it. Second-order upwind scheme without limiter; at the
/// interface it predicts without any interface condition.
class HalfSpace {
 public:
  HalfSpace(Medium medium, int side, std::size_t points, double h)
      : medium_(medium), side_(side), h_(h), v_(points + 2 * ghosts), s_(points + 2 * ghosts) {}

  double& v(std::size_t i) { return v_[i + ghosts]; }
  double& s(std::size_t i) { return s_[i + ghosts]; }
  double u() const { return u_; }
  const Medium& medium() const { return medium_; }
  double largest_step() const { return 0.9 * h_ / medium_.c; }

  void advance(double dt) {
    extrapolate();
    const double z = side_ * medium_.z();
    const double slope = (s_[ghosts + 1] - s_[ghosts - 1]) / (2 * h_);
    u_ += dt * (v_[ghosts] + 0.5 * dt * side_ * slope / medium_.rho);
    const double courant = medium_.c * dt / h_;
    std::vector<double> to(s_.size());
    std::vector<double> away(s_.size());
    for (std::size_t i = 0; i < s_.size(); ++i) {
      to[i] = s_[i] + z * v_[i];
      away[i] = s_[i] - z * v_[i];
    }
    const auto step = [courant](double before, double up, double here, double down) {
      // Upwind with centred slopes; `up` lies upstream of `here`.
      const double out = here + 0.25 * (1 - courant) * (down - up);
      const double in = up + 0.25 * (1 - courant) * (here - before);
      return here - courant * (out - in);
    };
    for (std::size_t i = ghosts; i + ghosts < s_.size(); ++i) {
      const double new_to = step(to[i + 2], to[i + 1], to[i], to[i - 1]);
      const double new_away = step(away[i - 2], away[i - 1], away[i], away[i + 1]);
      s_[i] = 0.5 * (new_to + new_away);
      v_[i] = 0.5 * (new_to - new_away) / z;
    }
  }

  /// Interface condition: the projected state.
  void set(double v_n, double w_n) {
    v(0) = v_n;
    s(0) = w_n;
  }

 private:
  static constexpr std::size_t ghosts = 2;

  void extrapolate() {
    for (std::vector<double>* f : {&v_, &s_}) {
      std::vector<double>& g = *f;
      const std::size_t last = g.size() - 1 - ghosts;
      for (std::size_t k = 1; k <= ghosts; ++k) {
        g[ghosts - k] = 3 * g[ghosts - k + 1] - 3 * g[ghosts - k + 2] + g[ghosts - k + 3];
        g[last + k] = 3 * g[last + k - 1] - 3 * g[last + k - 2] + g[last + k - 3];
      }
    }
  }

  Medium medium_;
  double side_;
  double h_;
  std::vector<double> v_, s_;
  double u_ = 0;
};

}  // namespace fsi::coupler::testing
