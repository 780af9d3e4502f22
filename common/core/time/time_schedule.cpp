#include "common/core/time/time_schedule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/failure.hpp"

namespace fsi {

namespace {

constexpr double smallest_part = 1e-11;  ///< of the run's length: below, the step counts as vanished
/// Of the run's length: over a step so short, the round-off of positions is a velocity of grids and walls
/// that lowers the following proposals.
constexpr double same_time = 1e-8;

}  // namespace

std::vector<double> distinct_times(std::vector<double> times, double end) {
  const double apart = same_time * end;
  std::ranges::sort(times);
  std::vector<double> distinct;
  for (const double t : times) {
    if (t > end + apart) break;
    const double time = end - t <= apart ? end : (t <= apart ? 0 : t);
    if (distinct.empty() || time - distinct.back() > apart) distinct.push_back(time);
  }
  return distinct;
}

TimeSchedule::TimeSchedule(Options options) : options_(std::move(options)) {
  options_.output_times.push_back(options_.end);
  options_.output_times = distinct_times(std::move(options_.output_times), options_.end);
}

std::string name_of(StepLimit limit, const std::string& proposer) {
  switch (limit) {
    case StepLimit::growth:
      return "time.growth";
    case StepLimit::largest:
      return "time.dt";
    case StepLimit::output:
      return "output.times";
    default:
      return proposer;
  }
}

std::string words_for(StepLimit limit, const std::string& reason) {
  switch (limit) {
    case StepLimit::growth:
      return "growth from one step to the next";
    case StepLimit::largest:
      return "largest step of the case";
    case StepLimit::output:
      return "output time";
    default:
      return reason;
  }
}

bool TimeSchedule::output_at_start() const {
  return options_.output_times.front() <= 0;
}

bool TimeSchedule::is_output(double t) const {
  return std::ranges::any_of(options_.output_times,
                             [&](double wanted) { return std::abs(t - wanted) <= same_time * options_.end; });
}

bool TimeSchedule::is_end(double t) const {
  return t >= options_.end * (1 - same_time);
}

PlannedStep TimeSchedule::plan(double t, double proposal, const std::string& reason) {
  StepLimit limit = StepLimit::proposal;
  if (std::isinf(proposal) && proposal > 0) {
    proposal = options_.end;
    limit = StepLimit::output;
  }
  if (!(proposal > smallest_part * options_.end) || std::isnan(proposal)) {
    if (proposal > 0 && previous_ == 0 && t == 0)
      throw UserMistake(fmt::format(
          "time.end = {:g} is {:.2g} steps of {:.3g} ({}) away, more than any run can take (1e11): write "
          "a smaller time.end, or find out what makes the steps so small",
          options_.end, options_.end / proposal, proposal, reason));
    throw Diverged(
        fmt::format("the time step has collapsed to {:.3g} ({}): a cell there has become small, or a wave "
                    "fast; let the run end before (time.end), or give a grid that follows an outline more "
                    "`lines`, and look "
                    "at last_state/ where it is the wave",
                    proposal, reason),
        {.t = t});
  }
  double dt = proposal;
  const auto lower = [&](double most, StepLimit by) {
    if (most < dt) limit = by;
    dt = std::min(dt, most);
  };
  if (previous_ > 0) lower(options_.growth * previous_, StepLimit::growth);
  if (options_.dt_max > 0) lower(options_.dt_max, StepLimit::largest);
  previous_ = dt;

  const double tiny = smallest_part * options_.end;
  const auto target =
      std::ranges::find_if(options_.output_times, [=](double wanted) { return wanted > t + tiny; });
  if (target == options_.output_times.end()) return {.dt = 0, .t_next = t, .output = false, .end = true};
  const double steps = std::ceil((*target - t) / dt * (1 - 1e-12));
  if (steps <= 1) {
    const double rest = *target - t;
    return {.dt = rest,
            .t_next = *target,
            .output = true,
            .end = *target == options_.output_times.back(),
            .limit = rest < 0.5 * dt ? StepLimit::output : limit};
  }
  dt = (*target - t) / steps;
  return {.dt = dt, .t_next = t + dt, .limit = limit};
}

}  // namespace fsi
