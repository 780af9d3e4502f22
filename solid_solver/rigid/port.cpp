#include "solid_solver/rigid/port.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "common/wire/sparse.hpp"

namespace fsi::rigid {

namespace {

constexpr std::array<const char*, 8> quantities{"u1", "u2", "v1", "v2", "P11", "P12", "P21", "P22"};

std::vector<double> numbers(const Eigen::VectorXd& values) {
  return {values.begin(), values.end()};
}

}  // namespace

RigidParticipant::RigidParticipant(const Setup& setup, const SolidSpec& spec)
    : setup_(setup),
      spec_(spec),
      from_case_(body_from_case(spec)),
      body_(from_case_.body),
      fields_(setup.run_dir, "solid_" + spec.name),
      own_(own_load(0)),
      initial_(totals()) {
  place_grids();
  open_tables();
}

wire::Hello RigidParticipant::hello() const {
  wire::Hello hello;
  hello.role = "solid";
  hello.name = spec_.name;
  hello.law = spec_.law;
  hello.config_digest = setup_.problem.digest;
  hello.points = body_.points();
  if (!from_case_.meets_gas) return hello;
  const std::vector<std::string> gases = gases_at(spec_);
  for (std::size_t k = 0; k < body_.outlines(); ++k) {
    const Outline& outline = body_.outline(k);
    hello.interfaces.push_back({.name = interface_name(spec_, gases[k]),
                                .dimension = 2,
                                .x = outline.x,
                                .n = grid::normals(outline.x, outline.ends, outline.orientation)});
  }
  return hello;
}

TimeStepBid RigidParticipant::compute_time_step() const {
  return {.dt = std::numeric_limits<double>::infinity(), .reason = "a rigid body has no waves"};
}

void RigidParticipant::fill(std::size_t k, wire::PredictedInterface& predicted) const {
  predicted.x = body_.positions(k);
  predicted.v = body_.velocities(predicted.x);
  if (spec_.fixed) {  // one mode that moves no point
    predicted.modal = {
        .modes = 1, .S = {.row = {0}, .column = {0}, .value = {1}}, .g = {0}, .N = {}, .q_dot = {0}};
    return;
  }
  predicted.modal = {.modes = static_cast<std::int32_t>(body_.modes()),
                     .S = wire::lower_entries_of(body_.response().sparseView()),
                     .g = numbers(body_.history(own_)),
                     .N = wire::entries_of(body_.mode_vectors(k).sparseView()),
                     .q_dot = numbers(body_.modal_velocity())};
}

void RigidParticipant::apply_bcs(double /*t*/, ProjectedStates projected) {
  const bool alone = projected.empty();
  if (dt_ > 0 && !spec_.fixed) {
    const std::span<const double> q_dot = alone ? std::span<const double>{} : projected.front()->q_dot;
    body_.correct(alone ? Eigen::VectorXd(body_.response().ldlt().solve(body_.history(own_)))
                        : Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(q_dot.data(), body_.modes())));
  }
  if (alone) return;
  for (std::size_t k = 0; k < projected.size(); ++k) {
    const wire::ProjectedInterface& gas = *projected[k];
    const GasLoad load = load_of_gas(body_.positions(k), gas.n, gas.w_n, gas.v_n);
    load_ = k == 0 ? load : load_ + load;
  }
  impulse_.add(load_, dt_);
}

/// Any number of substeps is one: nothing happens inside a body during a step.
void RigidParticipant::advance(double t, double dt, int /*substeps*/, ProjectedStates /*projected*/) {
  dt_ = dt;
  own_ = own_load(t + dt);
  if (!spec_.fixed) body_.advance(dt);
}

std::vector<io::GridOutput> RigidParticipant::fields() {
  std::vector<io::GridOutput> grids;
  for (Drawn& drawn : drawn_) {
    const int n = drawn.reference.layout().n1;
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < n; ++i) {
        const Vec2 x_bar(drawn.reference(0, i, j), drawn.reference(1, i, j));
        const Vec2 x = body_.position(x_bar), v = body_.velocity_at(x);
        for (int c = 0; c < 2; ++c) {
          drawn.state(c, i, j) = x[c] - x_bar[c];
          drawn.state(2 + c, i, j) = v[c];
        }
      }
    }
    std::vector<io::NamedPlane> planes;
    for (std::size_t k = 0; k < quantities.size(); ++k) {
      planes.push_back({quantities[k], drawn.state.view(), static_cast<int>(k)});
    }
    grids.push_back({.grid = drawn.grid,
                     .x = drawn.reference.view(),
                     .u = drawn.state.view(),
                     .fields = std::move(planes)});
  }
  return grids;
}

void RigidParticipant::write_fields(double t, std::uint64_t step) {
  fields_.write(t, step, fields());
}

/// The body as it is: predicted where the others broke.
void RigidParticipant::write_last_state(double t, std::uint64_t step) {
  fields_.write_apart("last_state", t, step, fields());
}

void RigidParticipant::archive(Archive& archive) {
  archive.inside("body", [&] { body_.archive(archive); });
  archive.values("own", {own_.data(), 3});
  archive.inside("load", [&] { load_.archive(archive); });
  archive.inside("impulse", [&] { impulse_.archive(archive); });
  archive.number("dt", dt_);
  archive.inside("fields", [&] { fields_.archive(archive); });
  archive.inside("forces", [&] { forces_->archive(archive); });
  if (probe_table_) archive.inside("probes", [&] { probe_table_->archive(archive); });
}

void RigidParticipant::write_tables(double t, double /*dt*/, ProjectedStates /*projected*/) {
  const Pose& pose = body_.pose();
  const Vec3 v = body_.velocity();
  forces_->row(t, load_, {.centre = pose.centre, .velocity = {v[0], v[1]}, .angle = pose.angle});
  if (!probe_table_) return;
  std::vector<double> row{t};
  for (const Vec2& x_bar : probes_) {
    const Vec2 x = body_.position(x_bar), velocity = body_.velocity_at(x);
    row.insert(row.end(), {x[0] - x_bar[0], x[1] - x_bar[1], velocity[0], velocity[1], 0, 0, 0, 0});
  }
  probe_table_->row(row);
}

void RigidParticipant::report(double /*t*/, io::Part& part) const {
  part.health["min_det_F"] = 1;
  part.conservation = conservation_of(
      totals(), initial_, impulse_.sum(),
      !spec_.body_force && !spec_.body_fitted.empty() && spec_.body_fitted.front().curve.closed());
}

BodyTotals RigidParticipant::totals() const {
  return {.momentum = body_.momentum(),
          .angular_momentum = body_.angular_momentum(),
          .energy = body_.kinetic_energy()};
}

/// The body force of the reference centre, on the whole area: no moment.
Vec3 RigidParticipant::own_load(double t) const {
  if (!spec_.body_force) return Vec3::Zero();
  const Vec2& centre = body_.reference_centre();
  return from_case_.area * Vec3(spec_.body_force->c1(centre[0], centre[1], t),
                                spec_.body_force->c2(centre[0], centre[1], t), 0);
}

void RigidParticipant::open_tables() {
  forces_.emplace(setup_, spec_.name);
  probes_ = probe_places(setup_, spec_.name);
  probe_table_ = probe_table(setup_, spec_.name, quantities);
}

void RigidParticipant::place_grids() {
  for (std::size_t k = 0; k < body_.outlines(); ++k) {
    const Outline& outline = body_.outline(k);
    const auto n = static_cast<int>(body_.points(k));
    Drawn& drawn = drawn_.emplace_back();
    drawn.grid = k == 0 ? "body" : "body_" + gases_at(spec_)[k];
    drawn.reference = Field(Layout(n, 2), 2);
    drawn.state = Field(Layout(n, 2), static_cast<int>(quantities.size()));
    for (int i = 0; i < n; ++i) {
      for (int c = 0; c < 2; ++c) {
        drawn.reference(c, i, 0) = outline.x[static_cast<std::size_t>(c * n + i)];
        drawn.reference(c, i, 1) = body_.reference_centre()[c];
      }
    }
  }
}

}  // namespace fsi::rigid
