#pragma once
/// What every program says when it joins a run, and what the bus measured for it.

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/wire/messages.hpp"

namespace fsi::bus {

/// How a program takes part in a run.
struct BusOptions {
  /// Identity of the run; programs of different runs never see each other.
  std::string run;
  /// What the programs of the run know and nobody else does (credentials.hpp); empty: anybody on this machine
  /// can take part, and falsify it.
  std::string key = {};
  /// Where the programs of a run of several machines meet: "OWN,OTHER,..", the address of this machine and those of
  /// the others; empty: the loopback interface.
  std::string network = {};
  /// What the numbers of this program depend on besides the case; the coupler lets nobody in who says something else.
  /// Empty: not told.
  std::string build = {};
  /// A peer whose liveliness lease expired (stopped, starved) has this long to return [s].
  double peer_timeout_s = 4;
  /// Who has not joined is lost after this time, in which it neither computed nor read from a disk [s].
  double hello_timeout_s = 20;
  /// Coupler: processes on this machine of those that are to join. Of others it only sees that they are late.
  std::map<std::string, int> pids = {};
  /// A living program may compute this long for one step, or twenty times as long as for its longest one so
  /// far if that is more; then it counts as stuck [s]. What counts is the processor time of its first thread,
  /// so a busy machine changes nothing; time on the clock must be ten times as long.
  double step_timeout_s = 120;  ///< [s]
  /// Called at least every 100 ms while waiting; ends the wait by throwing (`fsi::throw_if_interrupted`
  /// fits). May be empty.
  std::function<void()> throw_if_interrupted = {};
  /// For tests: true when a message that is sent now on this topic is to be lost. May be empty.
  std::function<bool(const std::string& topic)> loses = {};
};

/// A picture of the present state for a wish of `wire::Watch`; nothing where the program does not have it.
using Draw = std::function<std::optional<wire::Picture>(const std::string& wish)>;

/// Exchange of one program with the others since it joined.
struct Statistics {
  std::uint64_t messages = 0;  ///< lock-step messages sent and received
  std::uint64_t bytes = 0;     ///< payload of their arrays [byte]
  std::uint64_t stale = 0;     ///< messages of another run or an older step, or repeated ones, ignored
  std::uint64_t repeated = 0;  ///< messages sent once more because their answer did not come
  double wait_s = 0;           ///< time spent waiting for the others [s]
  /// Solver: from `publish` to the answer; coupler: from `scatter` to the last answer; the others' work
  /// included. Median over the last 1024 steps [us].
  double round_trip_p50_us = 0;
  /// The same: 99 % are faster [us].
  double round_trip_p99_us = 0;
};

/// What on this machine makes the bus slow, one line with its remedy each. Empty: nothing.
std::vector<std::string> start_up_warnings();

/// DDS domain (1..100) that belongs to a run. Domains share participant indices but not data; the discovery
/// tag, which is the run itself, keeps two runs apart that meet in one domain.
std::uint32_t domain_of(const std::string& run);

}  // namespace fsi::bus
