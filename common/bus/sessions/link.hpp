#pragma once
/// What every seat at the bus has: domain, waiting, aborts, telemetry, statistics.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/bus/dds.hpp"
#include "common/bus/options.hpp"
#include "common/bus/peers/watchers.hpp"
#include "common/core/failure.hpp"
#include "common/wire/messages.hpp"

namespace fsi::bus {

using Clock = std::chrono::steady_clock;

/// Seconds since a moment.
double since(Clock::time_point moment);

/// Topics everybody knows.
inline constexpr const char* hello_topic = "amp_fsi/hello";
inline constexpr const char* welcome_topic = "amp_fsi/welcome";
inline constexpr const char* abort_topic = "amp_fsi/abort";
inline constexpr const char* control_topic = "amp_fsi/control";
inline constexpr const char* telemetry_topic = "amp_fsi/telemetry";
inline constexpr const char* waiting_topic = "amp_fsi/waiting";

/// Times of the latest round trips.
class RoundTrips {
 public:
  void add(double seconds);
  /// Value below which `fraction` of the latest ones lie [us]; 0 without any.
  double quantile_us(double fraction) const;

 private:
  static constexpr std::size_t kept = 1024;
  std::vector<double> seconds_;
  std::size_t next_ = 0;
};

/// What has come in at one interface from one program.
struct Heard {
  std::uint64_t messages = 0, bytes = 0;  ///< taken
  std::uint64_t missing = 0;              ///< asked for, because they did not come
  std::uint64_t dropped = 0;              ///< repeated or late
  RoundTrips latency;                     ///< from writing to taking, of those that were waited for
  wire::Traffic report(const std::string& interface, const std::string& from) const;
};

/// How often another program said that it lacks a message which was sent to it. What it said while the
/// message was on its way, or twice in a row, counts little:
/// only who complains again and again has really lost it.
class Complaints {
 public:
  /// The message has just been sent, or has come.
  void forget();
  void add(double repetition_s);
  bool convincing(double timeout_s) const;
  int count() const { return count_; }

 private:
  static constexpr int convincing_count = 3;
  int count_ = 0;
  Clock::time_point since_{}, last_{};
};

/// One program's connection. Not for use by several threads at once.
class Link {
 public:
  /// Longest sleep without looking at signals, aborts and peers [s].
  static constexpr double slice_s = 0.1;
  /// Who waits for longer than this may do something else meanwhile [s].
  static constexpr double long_wait_s = 0.5;
  /// Longest wait for the last messages to arrive when leaving [s].
  static constexpr double leave_patience_s = 1;

  Link(BusOptions options, std::string role, std::string name);

  /// Sleeps until an attached reader has something or `slice_s` has passed, then throws what ends the run.
  /// Who watches is told now and then that this program lives and is in this `state`.
  void sleep() { sleep(slice_s); }
  void sleep(double seconds, const char* state = "waiting");
  /// Throws another program's Abort as a Failure with its code and reason.
  void check_aborts();
  /// True once per `slice_s`: time to look after the peers.
  bool time_to_check();

  /// Sends a message of the lock-step exchange or of the beginning.
  template <class T>
  void send(Writer<T>& writer, const std::string& topic, const T& sample) const {
    if (options_.loses && options_.loses(topic)) return;
    writer.write(sample);
  }

  /// Who waits says once per so many seconds what it lacks, and sends its last messages again [s].
  double repetition_s() const;
  void begin_wait() {
    wait_began_ = last_word_ = Clock::now();
    waiting_since_ = dds_time();
  }
  double waited_s() const { return since(wait_began_); }
  /// True once per `repetition_s` since the wait began.
  bool time_to_repeat();
  /// Tells everybody that the message of `step` on `topic` that comes from `to` is missing here.
  void say_waiting(const std::string& to, const std::string& topic, std::uint64_t step);
  /// What the others said of that kind since the last call.
  std::vector<wire::Waiting> others_waiting();

  bool telemetry_due() const { return since(last_telemetry_) > slice_s; }
  void publish(wire::Telemetry telemetry);
  void abort(const Failure& failure) noexcept;
  /// Waits until what the writers sent has arrived, but not
  /// for long, and not at all when the run was aborted.
  template <class... Writers>
  void wait_for_arrival(Clock::time_point start, const Writers&... writers) const {
    if (!aborted_) (writers.arrived(std::max(0.0, leave_patience_s - since(start))), ...);
  }

  /// Counts a message that was written at `sent`. One that was written while nobody waited for it here tells
  /// nothing about the transport.
  void count(Heard& heard, std::size_t bytes, dds_time_t sent);
  void count_dropped(Heard& heard);

  Watchers& watchers() { return watchers_; }
  const Watchers& watchers() const { return watchers_; }
  const Entity& participant() const { return participant_; }
  Waitset& waitset() { return waitset_; }
  const BusOptions& options() const { return options_; }
  const std::string& name() const { return name_; }
  Statistics& counters() { return statistics_; }
  RoundTrips& round_trips() { return round_trips_; }
  Statistics statistics() const;

 private:
  void repeat_telemetry(const char* state);

  BusOptions options_;
  std::string role_, name_, host_;
  std::shared_ptr<const Entity> domain_;
  Entity participant_;
  Waitset waitset_;
  Reader<amp_fsi_Abort> abort_reader_;
  Writer<amp_fsi_Abort> abort_writer_;
  Writer<amp_fsi_Telemetry> telemetry_writer_;
  Reader<amp_fsi_Waiting> waiting_reader_;
  Writer<amp_fsi_Waiting> waiting_writer_;
  Watchers watchers_;
  bool aborted_ = false;  ///< somebody's Abort was heard, or ours was sent
  Clock::time_point last_telemetry_{}, last_repetition_{}, last_check_{}, wait_began_{}, last_word_{};
  wire::Telemetry telemetry_;      ///< the latest
  double waited_before_it_s_ = 0;  ///< time waited until then [s]
  Statistics statistics_;
  RoundTrips round_trips_;
  dds_time_t waiting_since_ = 0;  ///< by the clock of DDS
};

/// A message that was sent and did not arrive, however often it was sent again.
struct LostMessage {
  std::string kind;  ///< PredictedInterface, ProjectedInterface
  std::string from, to, topic;
  std::uint64_t step = 0;
};
/// Ends the run: who -> whom, which topic, which step.
[[noreturn]] void end_by(const LostMessage& message, double waited_s, const std::string& how_known);

/// One sentence for a reader or writer of `topic` that met an incompatible counterpart.
/// @throws PeerLost when `policy` is not 0
void check_compatible(const std::string& topic, std::uint32_t policy);

}  // namespace fsi::bus
