#include "coupler/time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/failure.hpp"

namespace fsi::coupler {

namespace {

constexpr double rounding = 1e-9;  // a step that exceeds a proposal by rounding needs no further substep

/// Smallest proposal of those that cannot substep; of all when nobody else sets a limit.
const Proposal* smallest(std::span<const Proposal> proposals) {
  const Proposal* smallest_proposal = nullptr;
  for (const bool substepping : {false, true}) {
    for (const Proposal& proposal : proposals) {
      if (proposal.may_substep != substepping || std::isinf(proposal.dt)) continue;
      if (smallest_proposal == nullptr || proposal.dt < smallest_proposal->dt) smallest_proposal = &proposal;
    }
    if (smallest_proposal != nullptr) break;
  }
  return smallest_proposal;
}

std::int32_t substeps_of(const Proposal& proposal, double dt, double t) {
  if (!proposal.may_substep) return 1;
  const double count = std::max(1.0, std::ceil(dt / proposal.dt * (1 - rounding)));
  if (!(count <= most_substeps)) {
    throw Diverged(
        fmt::format(
            "the time step of \"{}\" has collapsed to {:.3g}, {:.0f} substeps ({}); let the "
            "run end before (time.end), or give a grid that follows an outline more `lines`, and look at "
            "last_state/ where its cells have become small",
            proposal.from, proposal.dt, count, proposal.reason),
        {.t = t, .program = proposal.from});
  }
  return static_cast<std::int32_t>(count);
}

}  // namespace

TimeStepAgreement::TimeStepAgreement(const TimeSchedule::Options& options, double start)
    : schedule_(options), t_(start) {}

void TimeStepAgreement::archive(Archive& archive) {
  archive.inside("schedule", [&] { schedule_.archive(archive); });
  archive.number("t", t_);
}

AgreedStep TimeStepAgreement::agree(std::span<const Proposal> proposals) {
  for (const Proposal& proposal : proposals) {
    if (proposal.dt > 0) continue;
    throw Diverged(
        fmt::format("the time step of \"{}\" is {:.3g} ({})", proposal.from, proposal.dt, proposal.reason),
        {.t = t_, .program = proposal.from});
  }
  const Proposal unlimited{.from = {}, .dt = std::numeric_limits<double>::infinity(), .reason = {}};
  const Proposal* found = smallest(proposals);
  const Proposal& first = found != nullptr ? *found : unlimited;
  AgreedStep step;
  step.plan = schedule_.plan(t_, first.dt, first.reason);
  step.limited_by = name_of(step.plan.limit, first.from);
  step.reason = words_for(step.plan.limit, first.reason);
  for (const Proposal& proposal : proposals) step.substeps.push_back(substeps_of(proposal, step.plan.dt, t_));
  t_ = step.plan.t_next;
  return step;
}

}  // namespace fsi::coupler
