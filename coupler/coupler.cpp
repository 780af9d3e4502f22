#include "coupler/coupler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/core/failure.hpp"

namespace fsi::coupler {

namespace {

constexpr std::size_t most_points_shown = 256;

/// The gas moves its grid and needs no Robin data; a solid moves by itself, and closes no substeps where it
/// takes none. An exchange of many points costs what its bytes cost.
void leave_out_what_the_other_needs(wire::ProjectedInterface& to_fluid, wire::ProjectedInterface& to_solid) {
  to_fluid.z_f.clear();
  to_solid.v.clear();
  to_solid.a.clear();
  to_solid.x_next.clear();
  if (to_solid.substeps_next > 1) return;
  to_solid.robin_t.clear();
  to_solid.robin_r.clear();
}

}  // namespace

Coupler::Coupler(const CouplerOptions& options, std::span<const wire::Hello> hellos)
    : options_(options), agreement_(options.time, options.start) {
  for (InterfacePair& pair : match_interfaces(hellos, options.periodic)) {
    if (std::ranges::find(participants_, pair.fluid) == participants_.end())
      participants_.push_back(pair.fluid);
    if (std::ranges::find(solids_, pair.solid, &Solid::name) == solids_.end())
      solids_.push_back({.name = pair.solid, .interfaces = {}, .modes = {}});
    std::ranges::find(solids_, pair.solid, &Solid::name)->interfaces.push_back(interfaces_.size());
    interfaces_.emplace_back(std::move(pair), options.combination,
                             options.multirate ? options.robin_order + 1 : 1, options.path);
  }
  gases_ = participants_.size();
  for (const Solid& solid : solids_) participants_.push_back(solid.name);
  proposals_.resize(participants_.size());
  answers_.resize(2 * interfaces_.size());
  moment_.t = options.start;
}

std::span<const wire::ProjectedInterface> Coupler::step(std::span<const wire::PredictedInterface> predicted) {
  if (begun_) {
    moment_ = {.step = moment_.step + 1, .t = next_.plan.t_next, .dt = next_.plan.dt};
    output_ = next_.plan.output;
    at_end_ = next_.plan.end;
  } else {
    output_ = agreement_.schedule().output_at_start();
  }
  begun_ = true;
  project_interface(predicted);
  finished_ = at_end_ || !stop_reason_.empty();
  if (finished_) {
    next_ = {.plan = {.dt = 0, .t_next = moment_.t, .output = false, .end = true},
             .limited_by = {},
             .reason = {},
             .substeps = {}};
  } else {
    agree_on_time_step(predicted);
  }
  const bool before_end = options_.checkpoint_at_end && next_.plan.end;
  checkpoint_asked_ = (std::exchange(checkpoint_, false) || before_end) && !finished_;
  answer();
  return answers_;
}

const wire::PredictedInterface& Coupler::find(std::span<const wire::PredictedInterface> predicted,
                                              const std::string& from, const std::string& interface) const {
  const auto state = std::ranges::find_if(predicted, [&](const wire::PredictedInterface& each) {
    return each.from == from && each.interface == interface && each.step == moment_.step;
  });
  if (state != predicted.end()) return *state;
  throw PeerLost(fmt::format("no predicted state of step {} from \"{}\" for interface \"{}\"", moment_.step,
                             from, interface));
}

void Coupler::project_interface(std::span<const wire::PredictedInterface> predicted) {
  for (Solid& solid : solids_) {
    for (const std::size_t k : solid.interfaces) {
      const InterfacePair& pair = interfaces_[k].pair();
      interfaces_[k].take(moment_, find(predicted, pair.fluid, pair.name),
                          find(predicted, pair.solid, pair.name));
    }
    const Eigen::VectorXd q_dot = project_modes(solid);
    for (const std::size_t k : solid.interfaces) interfaces_[k].project_interface(moment_, q_dot);
  }
}

/// Velocities of the degrees of freedom, which all interfaces of the solid move with; empty for a deformable
/// one. What it says of itself beside its mode vectors is the same at each of them.
Eigen::VectorXd Coupler::project_modes(Solid& solid) const {
  const InterfaceExchange& first = interfaces_[solid.interfaces.front()];
  std::vector<ModalSide> sides;
  for (const std::size_t k : solid.interfaces) {
    const InterfaceExchange& interface = interfaces_[k];
    if (interface.modal().modes != first.modal().modes) {
      throw PeerLost(
          fmt::format("\"{}\" sent modal.modes = {} for interface \"{}\" and {} for \"{}\"; a solid "
                      "has the same modes at all its interfaces",
                      solid.name, first.modal().modes, first.pair().name, interface.modal().modes,
                      interface.pair().name));
    }
    if (first.modal().modes > 0) sides.push_back(interface.modal_side());
  }
  const wire::ModalResponse& modal = first.modal();
  if (modal.modes == 0) return {};
  if (moment_.dt == 0) return Eigen::Map<const Eigen::VectorXd>(modal.q_dot.data(), modal.modes);
  Eigen::VectorXd q_dot = solid.modes.project(modal, sides, moment_.dt);
  if (q_dot.size() == 0) {
    throw Diverged(
        fmt::format("nothing resists one of its {} modes, no mass, no stiffness, no gas", modal.modes),
        {.step = moment_.step, .t = moment_.t, .program = solid.name, .interface = first.pair().name});
  }
  return q_dot;
}

void Coupler::agree_on_time_step(std::span<const wire::PredictedInterface> predicted) {
  for (std::size_t k = 0; k < participants_.size(); ++k) {
    const auto state = std::ranges::find(predicted, participants_[k], &wire::PredictedInterface::from);
    proposals_[k] = {.from = participants_[k],
                     .dt = state->proposed_dt,
                     .reason = state->dt_reason,
                     .may_substep = options_.multirate && k >= gases_};
  }
  if (moment_.dt == 0) shorten_first_step();
  next_ = agreement_.agree(proposals_);
}

/// A gas proposes its first step from waves alone: it does not know how its sides begin to move.
void Coupler::shorten_first_step() {
  for (std::size_t k = 0; k < gases_; ++k) {
    double share = 1;
    for (const InterfaceExchange& interface : interfaces_) {
      if (interface.pair().fluid == proposals_[k].from)
        share = std::min(share, interface.share_of_first_step());
    }
    if (share == 1) continue;
    proposals_[k].dt *= share;
    proposals_[k].reason = fmt::format("a side that begins to move {:.3g} times as fast as waves", 1 / share);
  }
}

std::int32_t Coupler::substeps_of(const std::string& participant) const {
  const auto k =
      static_cast<std::size_t>(std::ranges::find(participants_, participant) - participants_.begin());
  return k < next_.substeps.size() ? next_.substeps[k] : 1;
}

void Coupler::answer() {
  shown_ = show_ || (show_end_ && finished_);
  show_ = show_end_ = false;
  for (std::size_t k = 0; k < interfaces_.size(); ++k) {
    const InterfaceExchange& interface = interfaces_[k];
    wire::ProjectedInterface& to_fluid = answers_[2 * k];
    interface.fill_state(to_fluid);
    interface.fill_motion(next_.plan.dt, to_fluid);
    to_fluid.to = interface.pair().fluid;
    to_fluid.step = moment_.step;
    to_fluid.t = moment_.t;
    to_fluid.dt_next = next_.plan.dt;
    to_fluid.t_next = next_.plan.t_next;
    to_fluid.write_output = output_ || finished_;
    to_fluid.write_checkpoint = checkpoint_asked_;
    to_fluid.show = shown_;
    to_fluid.stop = finished_;
    to_fluid.stop_reason = stop_reason_;

    wire::ProjectedInterface& to_solid = answers_[2 * k + 1];
    to_solid = to_fluid;
    to_solid.to = interface.pair().solid;
    to_solid.q_dot.assign(interface.q_dot().begin(), interface.q_dot().end());
    to_solid.substeps_next = substeps_of(to_solid.to);
    interface.fill_robin(to_solid);
    interface.fit(to_fluid, to_solid);
    leave_out_what_the_other_needs(to_fluid, to_solid);
    if (moment_.dt == 0 && !options_.path) to_fluid.a.clear();  // not known: no step has shown it
  }
}

void Coupler::archive(Archive& archive) {
  archive.number("begun", begun_);
  archive.number("step", moment_.step);
  archive.number("t", moment_.t);
  archive.number("dt", moment_.dt);
  archive.number("next_dt", next_.plan.dt);
  archive.number("next_t", next_.plan.t_next);
  archive.inside("agreement", [&] { agreement_.archive(archive); });
  if (archive.loading()) {  // the run that goes on may have another end and other output times
    next_.plan.output = agreement_.schedule().is_output(next_.plan.t_next);
    next_.plan.end = agreement_.schedule().is_end(next_.plan.t_next);
  }
  for (std::size_t k = 0; k < interfaces_.size(); ++k) {
    archive.inside(fmt::format("interface{}", k), [&] { interfaces_[k].archive(archive); });
  }
}

std::vector<InterfaceReport> Coupler::reports() const {
  std::vector<InterfaceReport> reports;
  for (const InterfaceExchange& interface : interfaces_) reports.push_back(interface.report());
  return reports;
}

std::vector<wire::Telemetry::Interface> Coupler::profiles() const {
  std::vector<wire::Telemetry::Interface> profiles;
  for (const InterfaceExchange& interface : interfaces_)
    profiles.push_back(interface.profile(most_points_shown));
  return profiles;
}

std::size_t Coupler::points() const {
  std::size_t sum = 0;
  for (const InterfaceExchange& interface : interfaces_) sum += interface.points();
  return sum;
}

}  // namespace fsi::coupler
