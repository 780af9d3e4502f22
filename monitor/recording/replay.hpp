#pragma once
/// A recording played back like a living run.

#include <chrono>
#include <deque>
#include <mutex>
#include <string>

#include "monitor/recording/recording.hpp"
#include "monitor/source.hpp"

namespace fsi::monitor {

class Replay : public Source {
 public:
  /// @param speed seconds of the recording per second
  Replay(const std::string& path, double speed);

  const RunEntry& run() const { return recording_.run(); }

  void listen(RunState& state, double seconds) override;
  /// Seconds since the recording began.
  double now() const override;
  bool files_lie_ahead() const override { return true; }
  /// Pause and resume hold and continue the replay.
  std::string request(Request request) override;
  std::string controls() const override { return "replay: p pause  r resume  "; }

 private:
  using Clock = std::chrono::steady_clock;

  double place() const;

  Recording recording_;
  double speed_;  ///< [-]
  std::deque<Heard> ahead_;
  bool finished_ = false;
  mutable std::mutex clock_;  ///< requests come from other threads
  double at_start_ = 0;       ///< place in the recording at `start_` [s]
  Clock::time_point start_ = Clock::now();
  bool held_ = false;
};

}  // namespace fsi::monitor
