#include "coupler/time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/failure.hpp"

namespace fsi::coupler {

namespace {

constexpr double most_substeps = 10000;
constexpr double rounding = 1e-9;  // a step that exceeds a bid by rounding needs no further substep

/// Smallest bid of those that cannot substep; of all when nobody else sets a limit.
const Bid* smallest(std::span<const Bid> bids) {
  const Bid* smallest_bid = nullptr;
  for (const bool substepping : {false, true}) {
    for (const Bid& bid : bids) {
      if (bid.may_substep != substepping || std::isinf(bid.dt)) continue;
      if (smallest_bid == nullptr || bid.dt < smallest_bid->dt) smallest_bid = &bid;
    }
    if (smallest_bid != nullptr) break;
  }
  return smallest_bid;
}

std::int32_t substeps_of(const Bid& bid, double dt, double t) {
  if (!bid.may_substep) return 1;
  const double count = std::max(1.0, std::ceil(dt / bid.dt * (1 - rounding)));
  if (!(count <= most_substeps)) {
    throw NumbersBroke(fmt::format("the time step of \"{}\" has collapsed to {:.3g}, {:.0f} substeps ({})",
                                   bid.from, bid.dt, count, bid.reason),
                       {.t = t, .program = bid.from});
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

AgreedStep TimeStepAgreement::agree(std::span<const Bid> bids) {
  for (const Bid& bid : bids) {
    if (bid.dt > 0) continue;
    throw NumbersBroke(fmt::format("the time step of \"{}\" is {:.3g} ({})", bid.from, bid.dt, bid.reason),
                       {.t = t_, .program = bid.from});
  }
  const Bid unlimited{.from = {}, .dt = std::numeric_limits<double>::infinity(), .reason = {}};
  const Bid* found = smallest(bids);
  const Bid& first = found != nullptr ? *found : unlimited;
  AgreedStep step;
  step.plan = schedule_.plan(t_, first.dt, first.reason);
  step.limited_by = name_of(step.plan.limit, first.from);
  step.reason = words_for(step.plan.limit, first.reason);
  for (const Bid& bid : bids) step.substeps.push_back(substeps_of(bid, step.plan.dt, t_));
  t_ = step.plan.t_next;
  return step;
}

}  // namespace fsi::coupler
