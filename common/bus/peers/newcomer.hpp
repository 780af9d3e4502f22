#pragma once
/// A program that the coupler waits for at the beginning of a run.

#include <chrono>
#include <cstdint>
#include <string>

namespace fsi::bus {

/// Follows a process from outside until its program has joined. What it computes, reads from a disk or would
/// compute if it had a processor is initialising, however long that takes on this machine; only the rest of
/// the time counts.
class Newcomer {
 public:
  /// `pid` 0: not known; all time counts.
  Newcomer(std::string label, int pid);

  /// Looks at the process; call it several times a second. @throws PeerLost it has ended
  void look();
  /// It has said hello. All time counts from now on, until it is heard on its other topics.
  void joined();
  /// Time that counts [s], up to the last look.
  double idle_s() const { return idle_s_; }

 private:
  std::string label_;
  int pid_ = 0;
  std::uint64_t born_ = 0;      ///< start time of the process
  std::uint64_t computed_ = 0;  ///< by all its threads, up to the last look [clock ticks]
  double idle_s_ = 0;           ///< [s]
  std::chrono::steady_clock::time_point last_look_ = std::chrono::steady_clock::now();
};

}  // namespace fsi::bus
