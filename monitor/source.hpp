#pragma once
/// Where a monitor's knowledge comes from: a living run, or a recording of one.

#include <string>
#include <vector>

#include "common/wire/request.hpp"
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
  /// Says that somebody looks at pictures of these quantities (ROLE.QUANTITY); to be said again every second.
  virtual void watch(const std::vector<std::string>& /*wishes*/) {}
  /// Pictures heard with the last `listen`.
  virtual std::vector<wire::Picture> pictures() { return {}; }
  /// The run's files may hold what is still to come here: a recording that is played.
  virtual bool files_lie_ahead() const { return false; }
  /// Sends a request. Returns what became of it, for people.
  virtual std::string request(Request request) = 0;
  /// The requests that `request` understands, with their keys, for people.
  virtual std::string controls() const = 0;
};

}  // namespace fsi::monitor
