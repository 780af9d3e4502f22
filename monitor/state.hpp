#pragma once
/// What a monitor knows about a run, gathered from telemetry. How it is shown is elsewhere.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/wire/messages.hpp"
#include "monitor/registry.hpp"

namespace fsi::monitor {

/// Latest state of a run. Times are seconds of the monitor's own clock.
class RunState {
 public:
  explicit RunState(RunEntry run) : run_(std::move(run)) {}

  void hear(const wire::Telemetry& telemetry, double now);
  void hear(const wire::Abort& abort) { abort_ = abort; }
  /// Programs the bus can hear now; none after there were some: the run is over.
  void count_programs(int programs, double now);

  const RunEntry& run() const { return run_; }
  /// Latest telemetry by participant.
  const std::map<std::string, wire::Telemetry>& programs() const { return programs_; }
  /// The program that speaks for the whole run: the coupler, or the only solver; null before anything was
  /// heard.
  const wire::Telemetry* leader() const;
  /// Seconds since a program was heard last.
  double silence(const std::string& program, double now) const;
  const std::optional<wire::Abort>& abort() const { return abort_; }
  /// "waiting" (nothing heard yet), "running", "aborted" or "ended".
  std::string status() const;
  bool over() const { return abort_.has_value() || ended_; }

  /// Part of the run that is done, 0 to 1.
  double progress() const;
  /// Coupled steps per second over the last seconds; 0 while unknown.
  double steps_per_s() const;
  /// Seconds until the end at the present pace; none while unknown.
  std::optional<double> remaining_s() const;

 private:
  struct Moment {
    double now = 0, t = 0;
    std::uint64_t step = 0;
  };

  RunEntry run_;
  std::map<std::string, wire::Telemetry> programs_;
  std::map<std::string, double> heard_at_;
  std::vector<Moment> pace_;  ///< the leader's steps over the last seconds
  std::string pace_of_;       ///< who that leader is: the coupler may be heard later than a solver
  std::optional<wire::Abort> abort_;
  std::optional<double> empty_since_;
  bool ended_ = false;
};

/// Share of its time a program computes instead of waiting; none before it did either.
std::optional<double> computing_share(const wire::Telemetry& program);

/// Everything as one JSON object (README.md lists the keys).
std::string to_json(const RunState& state, double now);

}  // namespace fsi::monitor
