#pragma once
/// What one program of a run does about checkpoints: its file of every set, and where a restart begins.

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/core/archive.hpp"
#include "common/io/checkpoint.hpp"
#include "common/program/program.hpp"

namespace fsi {

/// Names of all that may limit a step: the programs, and the settings of the case.
std::vector<std::string> names_of_limits(const Case& problem);

class Checkpoints {
 public:
  /// `state` saves or loads everything the next steps of the program depend on.
  Checkpoints(const Setup& setup, io::Part& part, std::function<void(Archive&)> state);

  /// Where the run begins: at its start, or where the checkpoint was written whose state is loaded now.
  /// @throws UserMistake, OutputFailed
  io::Standing begin();
  /// Writes this program's file. @throws OutputFailed, unless the case says to go on without
  void save(const io::Standing& at);
  /// Makes the set complete: every program has written its file. The same exceptions.
  /// @returns false where one did not: there is no checkpoint
  bool complete(const io::Standing& at);

 private:
  const Setup& setup_;
  io::Part& part_;
  std::function<void(Archive&)> state_;

  io::CheckpointOrigin origin() const;
  void archive(Archive& archive);
};

/// When the next checkpoint is due: after so many steps, or so much wall time.
class CheckpointClock {
 public:
  explicit CheckpointClock(const OutputSpec& output)
      : every_(static_cast<std::uint64_t>(output.checkpoint_every)), seconds_(output.checkpoint_seconds) {}
  /// Is one of `step` wanted?
  bool due(std::uint64_t step) const;
  /// One is asked for, or the run began there.
  void start(std::uint64_t step);

 private:
  std::uint64_t every_;
  double seconds_;  ///< [s]
  std::uint64_t last_ = 0;
  std::chrono::steady_clock::time_point last_time_ = std::chrono::steady_clock::now();
};

}  // namespace fsi
