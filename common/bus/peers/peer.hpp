#pragma once
/// Whether another program of the run is still there.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace fsi::bus {

/// Name of this machine.
std::string host_name();

/// Start time of a living process in clock ticks since boot: with the pid it identifies the process for good.
/// 0 when there is none or only a zombie is left.
std::uint64_t start_time(int pid);

/// What a whole process does, all its threads.
struct Activity {
  std::uint64_t computed = 0;  ///< so far [clock ticks]
  /// At this moment; also when it waits for a processor that others have.
  bool computing_or_reading = false;
};
/// Nothing where there is no such process.
std::optional<Activity> activity_of(int pid);

/// A step may need so many times the processor time of the longest one so far.
inline constexpr double slower_than_longest = 20;  ///< [-]
/// And so many times its limit of processor time on the clock: others compute too, disks are slow.
inline constexpr double clock_over_work = 10;  ///< [-]

/// How much a program's first thread has computed and how often it has waited.
struct Pulse {
  std::uint64_t computed = 0;  ///< clock ticks
  std::uint64_t waited = 0;
  bool sleeping = false;  ///< neither computing nor stopped nor waiting for a disk
  bool ready = false;     ///< computing, or waiting for a processor that others have
};

/// Who is found gone counts as lost only after so long [s]: the reason it gave when it left may just have arrived.
inline constexpr double last_word_s = 0.3;

/// Watches one program. Who died or left counts as lost after `last_word_s`; an expired liveliness lease only
/// starts a clock, because a Ctrl-Z recovers from it, and not even that as long as the system shows that the
/// program goes on or would if it had a processor: a busy machine is no failure. A program that lives but
/// sleeps without end (a deadlock) is lost too: ours wake up ten times a second whatever they wait for.
class Peer {
 public:
  /// `label` names it in messages: solid 'beam'.
  Peer(std::string label, const std::string& host, int pid);

  /// `matched` and `alive` are the writers of this program that can be heard, and those whose lease holds.
  /// For a program that owes an answer.
  /// @throws PeerLost it died, left, or has been silent or asleep for longer than `timeout_s`
  void check(int matched, int alive, double timeout_s);
  /// From now on it owes one step: what it computes counts for that.
  void begin_step();
  void end_step();
  /// @throws PeerLost it has computed for too long since `begin_step` (BusOptions::step_timeout_s)
  void check_step(std::uint64_t step, double step_timeout_s);
  /// For a program that waits for others most of the time: @throws PeerLost it has computed for as long as
  /// `step_timeout_s` without waiting once
  void check_endless(double step_timeout_s);
  /// Only whether its process lives, for a program whose writers are not known yet.
  void check_process();
  /// It has just been heard.
  void spoke() { quiet_.reset(); }
  /// True when it has only slept and woken up for so many seconds since it was heard: it waits for something.
  bool rested(double seconds);
  const std::string& label() const { return label_; }

 private:
  std::string label_;
  std::string called_;  ///< with its process
  std::string host_;    ///< where that is, if not here
  int pid_;
  std::uint64_t born_ = 0;  ///< start time of the process; 0: not visible from here, only liveliness tells
  std::optional<std::chrono::steady_clock::time_point> silent_since_, asleep_since_, quiet_since_,
      gone_since_;
  Pulse pulse_;
  std::optional<Pulse> step_began_, last_nap_, quiet_;
  std::optional<std::chrono::steady_clock::time_point> owes_since_;
  double work_s_ = 0, longest_work_s_ = 0;  ///< processor time of this step and of the longest one [s]

  bool is_dead() const;
  /// It is gone, in words: throws when that has been so for `last_word_s`.
  void miss(const char* how);
  /// The process has computed or woken up since the last call, or is ready to.
  bool goes_on();
  void check_pulse(double timeout_s);
};

}  // namespace fsi::bus
