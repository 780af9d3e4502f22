#include "coupler/exchange/interface_exchange.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "common/core/component_major.hpp"
#include "common/core/failure.hpp"
#include "common/core/types.hpp"
#include "common/interface/modal.hpp"
#include "common/interface/point_lengths.hpp"
#include "common/wire/sparse.hpp"
#include "coupler/exchange/checked_values.hpp"

namespace fsi::coupler {

namespace {

Curve curve_of(const InterfacePair& pair, const std::vector<double>& x, const std::vector<double>& n0) {
  try {
    return {x, n0, pair.periodic};
  } catch (const std::invalid_argument& problem) {
    throw PeerLost(fmt::format("interface \"{}\", solid \"{}\": {}", pair.name, pair.solid, problem.what()));
  }
}

/// At most `most` of n indices, the first and the last among them.
std::vector<std::size_t> evenly_spread(std::size_t n, std::size_t most) {
  const std::size_t count = std::min(n, most);
  std::vector<std::size_t> shown(count);
  for (std::size_t k = 0; k < count; ++k) shown[k] = count < 2 ? 0 : k * (n - 1) / (count - 1);
  return shown;
}

}  // namespace

InterfaceExchange::InterfaceExchange(InterfacePair pair, Combination combination, int robin_levels,
                                     const Path& path)
    : pair_(std::move(pair)),
      combination_(combination),
      curve_(curve_of(pair_, pair_.x, pair_.n0)),
      motion_(curve_.n),
      levels_(static_cast<std::size_t>(robin_levels)),
      n_(2 * curve_.n),
      ds_(curve_.n),
      v_(2 * curve_.n),
      a_(2 * curve_.n),
      gas_(curve_.n),
      solid_v_n_(curve_.n) {
  for (Level& level : levels_) {
    level.v_n.resize(curve_.n);
    level.w_n.resize(curve_.n);
  }
  if (const auto& coarser = pair_.coarser)
    transfer_.emplace(curve_of(pair_, coarser->x, coarser->n0), coarser->x, pair_.x, coarser->is_gas);
  if (path) prescribed_.emplace(path, pair_.x);
  report_.name = pair_.name;
}

void InterfaceExchange::check_gas(const Moment& moment, const wire::PredictedInterface& gas) const {
  const std::size_t n = transfer_ && pair_.coarser->is_gas ? transfer_->coarse_points() : curve_.n;
  check_values(moment, gas, "the position", gas.x, 2 * n, n);
  check_values(moment, gas, "the velocity", gas.v, 2 * n, n);
  check_values(moment, gas, "the pressure", gas.p, n, n);
  check_values(moment, gas, "the impedance", gas.z_f, n, n);
  for (std::size_t k = 0; k < n; ++k) {
    if (!(gas.z_f[k] > 0)) throw_broken(moment, gas, k, fmt::format("the impedance is {}", gas.z_f[k]));
  }
  if (gas.rho.empty() && gas.gamma.empty()) return;
  check_values(moment, gas, "the density", gas.rho, n, n);
  check_values(moment, gas, "the exponent gamma", gas.gamma, n, n);
  for (std::size_t k = 0; k < n; ++k) {
    if (!(gas.rho[k] > 0)) throw_broken(moment, gas, k, fmt::format("the density is {}", gas.rho[k]));
    if (!(gas.gamma[k] > 1) && gas.gamma[k] != 0)
      throw_broken(moment, gas, k, fmt::format("gamma is {}", gas.gamma[k]));
  }
}

void InterfaceExchange::check_solid(const Moment& moment, const wire::PredictedInterface& solid) const {
  const std::size_t n = transfer_ && !pair_.coarser->is_gas ? transfer_->coarse_points() : curve_.n;
  check_values(moment, solid, "the position", solid.x, 2 * n, n);
  check_values(moment, solid, "the velocity", solid.v, 2 * n, n);
  if (!solid.a.empty()) check_values(moment, solid, "the acceleration", solid.a, 2 * n, n);
  if (!solid.fixed.empty() && solid.fixed.size() != n) {
    throw PeerLost(fmt::format("\"{}\" sent {} marks of fixed points for interface \"{}\", not {}",
                               solid.from, solid.fixed.size(), pair_.name, n));
  }
  check_modes(solid);
  if (solid.modal.modes > 0) {
    if (combination_.projection == Projection::traditional) {
      throw UserMistake(fmt::format(
          "interface.projection: traditional is not there for solid \"{}\": a body with a few degrees of "
          "freedom is "
          "moved together with the gas's answer to it; write simplified or full, which are the same for it",
          solid.from));
    }
    const auto k = static_cast<std::size_t>(solid.modal.modes);
    check_entries(moment, solid, "the modal response S", solid.modal.S, {.rows = k, .columns = k});
    check_entries(moment, solid, "the mode vectors", solid.modal.N, {.rows = k, .columns = n});
    check_values(moment, solid, "the modal velocity", solid.modal.q_dot, k, k);
    check_values(moment, solid, "the modal response g", solid.modal.g, k, k);
    check_resistance(solid);
    return;
  }
  check_values(moment, solid, "the traction", solid.w, 2 * n, n, why_broken());
  check_values(moment, solid, "the impedance matrix", solid.Z, 3 * n, n, why_broken());
  if (!(solid.z_p > 0)) {
    throw PeerLost(fmt::format("\"{}\" sent the impedance z_p = {} for interface \"{}\"", solid.from,
                               solid.z_p, pair_.name));
  }
}

/// What it means where a solid's answer to the gas is lost, and what to do.
std::string InterfaceExchange::why_broken() const {
  return fmt::format(
      "the solid is no longer hyperbolic, which too large a strain does, or too large a step, or noise; "
      "try a smaller time.cfl, such as 0.3, or a stiffer solids.{}",
      pair_.solid);
}

/// The body has the degrees of freedom of its first message for ever.
void InterfaceExchange::check_modes(const wire::PredictedInterface& solid) const {
  if (known_ == 0) return;
  const auto before = q_dot_.size();
  if (solid.modal.modes == before) return;
  throw PeerLost(
      fmt::format("\"{}\" sent modal.modes = {} for interface \"{}\", {} before; a solid must keep the "
                  "number of its modes (0: a deformable one)",
                  solid.from, solid.modal.modes, pair_.name, before));
}

void InterfaceExchange::take(const Moment& moment, const wire::PredictedInterface& gas,
                             const wire::PredictedInterface& solid) {
  check_gas(moment, gas);
  check_solid(moment, solid);
  const bool gas_is_brought = transfer_ && pair_.coarser->is_gas;
  predicted_gas_ = gas_is_brought ? &transfer_->bring(gas) : &gas;
  solid_ = transfer_ && !gas_is_brought ? &transfer_->bring(solid) : &solid;
  const wire::ModalResponse& modes = solid_->modal;
  if (modes.modes > 0) wire::put_matrix(modes.N, modes.modes, static_cast<Eigen::Index>(curve_.n), N_);
  prepare(moment);
  check_sense(moment);
}

/// What a solid says fits to what else it says.
void InterfaceExchange::check_sense(const Moment& moment) const {
  const wire::PredictedInterface& solid = *solid_;
  const Eigen::Index modes = solid.modal.modes;
  if (modes > 0) {
    const Eigen::VectorXd of_modes =
        N_.transpose() * Eigen::Map<const Eigen::VectorXd>(solid.modal.q_dot.data(), modes);
    check_mode_vectors(solid, {.v_n = solid_v_n_, .of_modes = {of_modes.data(), curve_.n}, .ds = ds_},
                       gas_.front().curve.sound());
  }
  if (moment.step == 0) check_start(solid, pair_.x);
  if (moment.step == 0 && modes == 0) check_impedance(solid, n_);
}

void InterfaceExchange::prepare(const Moment& moment) {
  const wire::PredictedInterface &gas = *predicted_gas_, &solid = *solid_;
  x_gas_ = gas.x;
  x_solid_ = solid.x;
  z_f_ = gas.z_f;
  p_e_ = gas.p_e;
  const bool says = !solid.fixed.empty();
  curve_.first.slides = says && solid.fixed.front() == wire::Freedom::slides;
  curve_.last.slides = says && solid.fixed.back() == wire::Freedom::slides;
  if (transfer_) transfer_->let_ends_slide(curve_.first.slides, curve_.last.slides);
  unit_normals(curve_, x_gas_, n_);
  point_lengths(x_gas_, n_, ds_);
  for (std::size_t k = 0; k < curve_.n; ++k) {
    const GasPoint<2> point{.v = vector_at(gas.v, k), .p = gas.p[k], .p_e = gas.p_e, .z_f = gas.z_f[k]};
    gas_[k] = {.state = normal_side<2>(point, vector_at(n_, k)), .curve = {.z = gas.z_f[k]}};
    if (!gas.rho.empty()) gas_[k].curve.rho = gas.rho[k];
    if (combination_.wave_curve && !gas.gamma.empty()) gas_[k].curve.gamma = gas.gamma[k];
    solid_v_n_[k] = vector_at(n_, k).dot(vector_at(solid.v, k));
  }
  std::ranges::rotate(levels_, levels_.end() - 1);
  known_ = std::min(known_ + 1, levels_.size());
  levels_.front().t = moment.t;
}

void InterfaceExchange::project_interface(const Moment& moment, const Eigen::VectorXd& q_dot) {
  if (modal().modes > 0) {
    q_dot_ = q_dot;
    project_modal();
  } else {
    project_deformable(moment, *solid_);
  }
  remember(moment, *solid_);
  measure(*predicted_gas_, *solid_);
}

void InterfaceExchange::project_deformable(const Moment& moment, const wire::PredictedInterface& solid) {
  const std::size_t n = curve_.n;
  Level& now = levels_.front();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 normal = vector_at(n_, k);
    SolidPoint<2> point{
        .v = vector_at(solid.v, k), .w = vector_at(solid.w, k), .Z = Mat2::Zero(), .z_p = solid.z_p};
    point.Z << solid.Z[k], solid.Z[n + k], solid.Z[n + k], solid.Z[2 * n + k];
    if (!(point.Z(0, 0) > 0 && point.Z.determinant() > 0)) {
      throw_broken(moment, solid, k, "the impedance matrix is not positive: " + why_broken());
    }
    const bool fixed = !solid.fixed.empty() && solid.fixed[k] == wire::Freedom::fixed;
    NormalState state;
    if (fixed && combination_.projection != Projection::traditional) {
      state = at_wall(solid_v_n_[k], gas_[k]);
    } else {
      state = fsi::project<2>(point, gas_[k], normal, combination_.projection);
    }
    now.v_n[k] = state.v_n;
    now.w_n[k] = state.w_n;
  }
  const bool solid_is_coarser = transfer_ && !pair_.coarser->is_gas;
  if (solid_is_coarser && combination_.projection != Projection::traditional) follow_solid();
}

/// The gas on finer points than the solid's sees an interface that moves as those points can; its own
/// characteristic gives the traction.
void InterfaceExchange::follow_solid() {
  Level& now = levels_.front();
  std::vector<double> change = now.v_n;
  for (std::size_t k = 0; k < curve_.n; ++k) change[k] -= solid_v_n_[k];
  transfer_->resolve(change);
  for (std::size_t k = 0; k < curve_.n; ++k) {
    now.v_n[k] = solid_v_n_[k] + change[k];
    now.w_n[k] = at_wall(now.v_n[k], gas_[k]).w_n;
  }
}

void InterfaceExchange::project_modal() {
  const Eigen::VectorXd v_n = N_.transpose() * q_dot_;
  Level& now = levels_.front();
  for (std::size_t i = 0; i < curve_.n; ++i) {
    const NormalState state = at_wall(v_n(static_cast<Eigen::Index>(i)), gas_[i]);
    now.v_n[i] = state.v_n;
    now.w_n[i] = state.w_n;
  }
}

/// The solid keeps its own tangential velocity: a gas without viscosity cannot change it.
void InterfaceExchange::remember(const Moment& moment, const wire::PredictedInterface& solid) {
  const std::size_t n = curve_.n;
  const Level& now = levels_.front();
  for (std::size_t k = 0; k < n; ++k) {
    if (!std::isfinite(now.v_n[k]) || !std::isfinite(now.w_n[k])) {
      throw_broken(moment, solid, k, "the projected state is not finite");
    }
    z_f_[k] = gas_[k].tangent(now.v_n[k]).z;  // what the gas answers to further changes with
    const double correction = now.v_n[k] - solid_v_n_[k];
    v_[k] = solid.v[k] + correction * n_[k];
    v_[n + k] = solid.v[n + k] + correction * n_[n + k];
  }
  if (moment.dt > 0) {
    motion_.take(v_, moment.dt);
  } else {
    motion_.start(v_, solid.a);
  }
  std::ranges::copy(motion_.a(), a_.begin());
  if (!prescribed_) return;
  prescribed_->velocity(moment.t, v_);
  prescribed_->acceleration(moment.t, a_);
}

void InterfaceExchange::measure(const wire::PredictedInterface& gas, const wire::PredictedInterface& solid) {
  const Level& now = levels_.front();
  report_ = {.name = pair_.name, .p_max = p_e_ - std::ranges::min(now.w_n)};
  solid_w_n_.resize(solid.w.size() / 2);
  solid_w_t_.resize(solid_w_n_.size());
  for (std::size_t k = 0; k < curve_.n; ++k) {
    const Vec2 normal = vector_at(n_, k);
    const bool fixed = !solid.fixed.empty() && solid.fixed[k] == wire::Freedom::fixed;
    if (!fixed)
      report_.velocity_jump = std::max(report_.velocity_jump, std::abs(gas_[k].state.v_n - solid_v_n_[k]));
    if (!solid.w.empty()) {
      solid_w_n_[k] = normal.dot(vector_at(solid.w, k));
      solid_w_t_[k] = Vec2(-normal.y(), normal.x()).dot(vector_at(solid.w, k));
      report_.shear = std::max(report_.shear, std::abs(solid_w_t_[k]));
      const Vec2 jump = vector_at(solid.w, k) - gas_[k].state.w_n * normal;
      report_.traction_jump = std::max(report_.traction_jump, jump.norm());
    }
    report_.gap = std::max(report_.gap, std::abs(normal.dot(vector_at(gas.x, k) - vector_at(solid.x, k))));
    report_.velocity_scale =
        std::max({report_.velocity_scale, gas_[k].curve.sound(), std::abs(gas_[k].state.v_n)});
    report_.traction_scale = std::max(report_.traction_scale, gas.p[k]);
    report_.vacuum += gas_[k].curve.at(now.v_n[k] - gas_[k].state.v_n).vacuum ? 1 : 0;
    report_.power += ds_[k] * now.w_n[k] * now.v_n[k];
  }
}

void InterfaceExchange::fill_state(wire::ProjectedInterface& answer) const {
  const Level& now = levels_.front();
  answer.interface = pair_.name;
  answer.n = n_;
  answer.v_n = now.v_n;
  answer.w_n = now.w_n;
  answer.v = v_;
  answer.a = a_;
  answer.z_f = z_f_;
}

void InterfaceExchange::fill_robin(wire::ProjectedInterface& answer) const {
  const std::size_t n = curve_.n;
  answer.robin_t.resize(known_);
  answer.robin_r.resize(known_ * n);
  for (std::size_t level = 0; level < known_; ++level) {
    const Level& then = levels_[level];
    answer.robin_t[level] = then.t;
    // The newest z_f for every level: with the z_f of its own
    // time each r_k would belong to another condition.
    for (std::size_t k = 0; k < n; ++k) answer.robin_r[level * n + k] = then.w_n[k] + z_f_[k] * then.v_n[k];
  }
}

double InterfaceExchange::share_of_first_step() const {
  double share = 1;
  for (std::size_t k = 0; k < curve_.n; ++k) {
    if (gas_[k].curve.rho == 0) continue;  // says no speed of sound
    const double waves = gas_[k].curve.sound() + std::abs(gas_[k].state.v_n);
    share = std::min(share, waves / std::max(waves, std::abs(levels_.front().v_n[k])));
  }
  return share;
}

void InterfaceExchange::fill_motion(double dt, wire::ProjectedInterface& answer) const {
  answer.x_next.resize(2 * curve_.n);
  if (dt > 0 && prescribed_) {
    prescribed_->position(levels_.front().t + dt, answer.x_next);
  } else if (dt > 0) {
    motion_.command(x_solid_, dt, answer.x_next);
  } else {
    answer.x_next = x_gas_;
  }
}

void InterfaceExchange::fit(wire::ProjectedInterface& to_fluid, wire::ProjectedInterface& to_solid) const {
  if (transfer_) transfer_->give(x_gas_, pair_.coarser->is_gas ? to_fluid : to_solid);
}

void InterfaceExchange::archive(Archive& archive) {
  archive.inside("motion", [&] { motion_.archive(archive); });
  archive.number("levels", known_);
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    archive.inside(fmt::format("level{}", k), [&] {
      archive.number("t", levels_[k].t);
      archive.values("v_n", levels_[k].v_n);
      archive.values("w_n", levels_[k].w_n);
    });
  }
  auto modes = q_dot_.size();
  archive.number("modes", modes);
  if (archive.loading()) q_dot_ = Eigen::VectorXd::Zero(modes);
}

wire::Telemetry::Interface InterfaceExchange::profile(std::size_t most) const {
  wire::Telemetry::Interface profile;
  profile.name = report_.name;
  profile.velocity_jump = report_.velocity_jump;
  profile.traction_jump = report_.traction_jump;
  profile.gap = report_.gap;
  profile.power = report_.power;
  profile.shear = report_.shear;
  profile.velocity_scale = report_.velocity_scale;
  profile.traction_scale = report_.traction_scale;
  profile.closed = curve_.closed && !curve_.periodic;
  const std::size_t n = curve_.n;
  const Level& now = levels_.front();
  const auto [v_min, v_max] = std::ranges::minmax(now.v_n);
  profile.v_min = v_min;
  profile.v_max = v_max;
  profile.p_min = p_e_ - std::ranges::max(now.w_n);
  profile.p_max = report_.p_max;
  std::vector<double> s(n);
  arclength(x_gas_, s);
  const std::vector<std::size_t> shown = evenly_spread(n, most);
  for (const std::size_t k : shown) {
    profile.s.push_back(s[k]);
    profile.p_predicted.push_back(p_e_ - gas_[k].state.w_n);
    if (!solid_w_n_.empty()) profile.p_predicted_solid.push_back(p_e_ - solid_w_n_[k]);
    if (!solid_w_t_.empty()) profile.w_tangential.push_back(solid_w_t_[k]);
    profile.p_projected.push_back(p_e_ - now.w_n[k]);
    profile.v_predicted.push_back(solid_v_n_[k]);
    profile.v_predicted_gas.push_back(gas_[k].state.v_n);
    profile.v_projected.push_back(now.v_n[k]);
  }
  for (const std::size_t component : {std::size_t{0}, n}) {
    for (const std::size_t k : shown) {
      profile.x.push_back(x_gas_[component + k]);
      profile.x_start.push_back(pair_.x[component + k]);
    }
  }
  return profile;
}

}  // namespace fsi::coupler
