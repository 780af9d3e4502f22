#pragma once
/// Where a monitor's knowledge comes from: a living run, or a recording of one.

#include <string>

#include "monitor/state.hpp"

namespace fsi::monitor {

class Source {
 public:
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  Source(Source&&) = delete;
  Source& operator=(Source&&) = delete;
  virtual ~Source() = default;

  /// Takes in what can be heard within `seconds`; returns early when there is something.
  virtual void listen(RunState& state, double seconds) = 0;
  /// The clock of `RunState` [s].
  virtual double now() const = 0;
  /// Sends a request ("pause", "resume", "checkpoint", "stop"). Returns what became of it, for people.
  virtual std::string request(const std::string& command) = 0;
  /// The requests that `request` understands, with their keys, for people.
  virtual std::string controls() const = 0;
};

}  // namespace fsi::monitor
