#pragma once
/// What a monitor knows about a run, gathered from telemetry. How it is shown is elsewhere.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/wire/messages.hpp"
#include "monitor/history.hpp"
#include "monitor/registry.hpp"

namespace fsi::monitor {

/// What the system says about the process of a program.
enum class Process { unknown, lives, stopped, gone };

/// What a program does now, over the last seconds.
struct Rates {
  double steps_per_s = 0, messages_per_s = 0, bytes_per_s = 0;  ///< [1/s], [1/s], [byte/s]
  std::optional<double> computing;  ///< share of the time it computes instead of waiting [-]
};

/// What comes in at one interface now.
struct TrafficRates {
  double messages_per_s = 0, bytes_per_s = 0;  ///< [1/s], [byte/s]
};

/// Latest state of a run. Times are seconds of the monitor's own clock.
class RunState {
 public:
  explicit RunState(RunEntry run) : run_(std::move(run)) {}

  void hear(const wire::Telemetry& telemetry, double now);
  void hear(const wire::Abort& abort) { abort_ = abort; }
  /// Programs the bus can hear now; none after there were some: the run is over, unless a process was seen
  /// that lives. (On a busy machine all of them may be silent for longer than their leases.)
  void count_programs(int programs, double now);
  void see_process(const std::string& program, Process process) { processes_[program] = process; }
  /// The run is over, known from elsewhere than the bus.
  void end() { ended_ = true; }
  void read_table(const std::string& path) { history_.read_table(path); }

  const RunEntry& run() const { return run_; }
  /// Latest telemetry by participant.
  const std::map<std::string, wire::Telemetry>& programs() const { return programs_; }
  /// The program that speaks for the whole run: the coupler,
  /// or the only solver; null before anything was heard.
  const wire::Telemetry* leader() const;
  /// Interfaces in the order the coupler has them.
  const std::vector<wire::Telemetry::Interface>& interfaces() const;
  /// Seconds since a program was heard last.
  double silence(const std::string& program, double now) const;
  /// "alive", "waiting", "paused", "stopped" (SIGSTOP), "silent", "lost" or "done".
  std::string standing(const std::string& program, double now) const;
  Rates rates(const std::string& program) const;
  /// Of entry `k` of the program's traffic.
  TrafficRates traffic_rates(const std::string& program, std::size_t k) const;
  const History& history() const { return history_; }
  /// Share of its time a program computed, over the monitor's clock; by participant.
  const std::map<std::string, std::deque<Series::Point>>& timeline() const { return timeline_; }
  const std::optional<wire::Abort>& abort() const { return abort_; }
  /// "waiting" (nothing heard yet), "running", "paused", "aborted" or "ended".
  std::string status() const;
  bool over() const { return abort_.has_value() || ended_; }
  /// What is not a finite number, in words; empty when all is well.
  std::vector<std::string> non_finite() const;

  /// Part of the run that is done, 0 to 1.
  double progress() const;
  /// Coupled steps per second over the last seconds; 0 while unknown.
  double steps_per_s() const;
  /// Seconds until the end at the present pace; none while unknown.
  std::optional<double> remaining_s() const;

 private:
  struct Moment {
    double now = 0, t = 0, compute_s = 0, wait_s = 0;  ///< [s], [time], [s], [s]
    std::uint64_t step = 0, messages = 0, bytes = 0;
    struct Count {
      std::uint64_t messages = 0, bytes = 0;
    };
    std::vector<Count> traffic = {};
  };
  /// First and last moment of the window; null while there are no two.
  struct Window {
    const Moment* first = nullptr;
    const Moment* last = nullptr;
  };
  Window window(const std::string& program) const;
  void note_timeline(const wire::Telemetry& telemetry, double now);

  RunEntry run_;
  std::map<std::string, wire::Telemetry> programs_;
  std::map<std::string, double> heard_at_;
  std::map<std::string, Process> processes_;
  std::map<std::string, std::deque<Moment>> pace_;  ///< over the last seconds
  std::map<std::string, std::deque<Series::Point>> timeline_;
  History history_;
  std::optional<wire::Abort> abort_;
  std::optional<double> empty_since_;  ///< [s]
  bool ended_ = false;
};

/// Share of its time a program computed instead of waiting since it began; none before it did either.
std::optional<double> computing_share(const wire::Telemetry& program);

}  // namespace fsi::monitor
