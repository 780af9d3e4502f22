#include "solid_solver/rigid/port.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "common/core/component_major.hpp"
#include "common/core/failure.hpp"
#include "common/interface/modal.hpp"
#include "common/wire/sparse.hpp"

namespace fsi::rigid {

namespace {

constexpr std::array<const char*, 8> quantities{"u1", "u2", "v1", "v2", "P11", "P12", "P21", "P22"};

}  // namespace

RigidParticipant::RigidParticipant(const Setup& setup, const SolidSpec& spec)
    : bodies::BodyParticipant(setup, spec, quantities),
      from_case_(body_from_case(spec, setup.problem.time.end)),
      body_(from_case_.body),
      own_(own_load(0)) {
  if (!from_case_.meets_gas && spec.is_driven() && !setup.problem.time.dt) {
    throw UserMistake(fmt::format(
        "solid \"{}\" is rigid and without a gas: nothing limits the step with which it follows its "
        "`body_force` and what holds it; write `time.dt`",
        spec.name));
  }
  Shape shape{.outlines = {}, .points = body_.points(), .meets_gas = from_case_.meets_gas};
  for (std::size_t k = 0; k < body_.outlines(); ++k) shape.outlines.push_back(body_.outline(k));
  const bool is_grid = !from_case_.across.empty();
  const auto inside = [&](std::size_t l, std::size_t i) -> Vec2 {
    return is_grid ? vector_at(from_case_.across[l], i) : body_.reference_centre();
  };
  begin(std::move(shape), "body", inside, !is_grid);
}

ProposedTimeStep RigidParticipant::compute_time_step() const {
  return {.dt = std::numeric_limits<double>::infinity(), .reason = "a rigid body has no waves"};
}

void RigidParticipant::fill(std::size_t k, wire::PredictedInterface& predicted) const {
  predicted.x = body_.positions(k);
  predicted.v = body_.velocities(predicted.x);
  predicted.a.clear();
  if (predicted.step == 0 && body_.starts_unevenly()) predicted.a = body_.initial_accelerations(predicted.x);
  if (spec_.fixed) {  // one mode that moves no point
    predicted.modal = {
        .modes = 1, .S = {.row = {0}, .column = {0}, .value = {1}}, .g = {0}, .N = {}, .q_dot = {0}};
    return;
  }
  predicted.modal = {.modes = static_cast<std::int32_t>(body_.modes()),
                     .S = wire::lower_entries_of(body_.response().sparseView()),
                     .g = bodies::numbers(body_.history(own_)),
                     .N = wire::entries_of(body_.mode_vectors(k).sparseView()),
                     .q_dot = bodies::numbers(body_.modal_velocity())};
}

void RigidParticipant::apply_bcs(double /*t*/, ProjectedStates projected) {
  const bool alone = projected.empty();
  if (dt_ > 0 && !spec_.fixed) {
    const std::span<const double> q_dot = alone ? std::span<const double>{} : projected.front()->q_dot;
    body_.correct(alone ? solve_few_modes(body_.response(), body_.history(own_))
                        : Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(q_dot.data(), body_.modes())));
  }
  if (alone) return;
  std::vector<bodies::GasLoad> loads;
  for (std::size_t k = 0; k < projected.size(); ++k) {
    const wire::ProjectedInterface& gas = *projected[k];
    loads.push_back(bodies::load_of_gas(body_.positions(k), gas.n, gas.w_n, gas.v_n));
  }
  take(loads);
}

/// Any number of substeps is one: nothing happens inside a body during a step.
void RigidParticipant::advance(double t, double dt, int /*substeps*/, ProjectedStates /*projected*/) {
  dt_ = dt;
  own_ = own_load(t + dt);
  if (!spec_.fixed) body_.advance(t + dt, dt);
}

void RigidParticipant::values_at(const Vec2& x_bar, std::span<double> values) const {
  const Vec2 x = body_.position(x_bar), v = body_.velocity_at(x);
  std::ranges::copy(std::array<double, 8>{x[0] - x_bar[0], x[1] - x_bar[1], v[0], v[1], 0, 0, 0, 0},
                    values.begin());
}

void RigidParticipant::values_at(const bodies::DrawnPoint& point, std::span<double> values) const {
  values_at(point.x_bar, values);
}

void RigidParticipant::archive_motion(Archive& archive) {
  archive.inside("body", [&] { body_.archive(archive); });
  archive.values("own", {own_.data(), 3});
}

void RigidParticipant::write_tables(double t, double /*dt*/, ProjectedStates /*projected*/) {
  std::vector<double> probes(quantities.size() * probe_places_.size());
  for (std::size_t k = 0; k < probe_places_.size(); ++k)
    values_at(probe_places_[k], std::span(probes).subspan(k * quantities.size(), quantities.size()));
  const Pose& pose = body_.pose();
  const Vec3 v = body_.velocity();
  write_rows(t, {.centre = pose.centre, .velocity = {v[0], v[1]}, .angle = pose.angle}, probes);
}

bool RigidParticipant::is_surrounded() const {
  return !spec_.fixed && !spec_.body_force && !spec_.mounting.holds() && !spec_.body_fitted.empty() &&
         spec_.body_fitted.front().curve.closed();
}

bodies::BodyTotals RigidParticipant::totals() const {
  return {.momentum = body_.momentum(),
          .angular_momentum = body_.angular_momentum(),
          .energy = body_.kinetic_energy() + body_.spring_energy()};
}

/// The body force of the reference centre, on the whole area: no moment.
Vec3 RigidParticipant::own_load(double t) const {
  if (!spec_.body_force) return Vec3::Zero();
  const Vec2& centre = body_.reference_centre();
  return from_case_.area * Vec3(spec_.body_force->c1(centre[0], centre[1], t),
                                spec_.body_force->c2(centre[0], centre[1], t), 0);
}

}  // namespace fsi::rigid
