#pragma once
/// The seat of a solver that runs alone: nobody to wait for, but it can be watched and told to stop.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/bus/options.hpp"
#include "common/core/failure.hpp"
#include "common/wire/messages.hpp"

namespace fsi::bus {

class SoloSession {
 public:
  /// `role` is "fluid" or "solid", `name` as in the case file.
  SoloSession(BusOptions options, const std::string& role, const std::string& name);
  SoloSession(SoloSession&&) noexcept;
  SoloSession& operator=(SoloSession&&) noexcept;
  ~SoloSession();

  /// Requests that came in since the last call; never waits.
  std::vector<wire::Control> controls();
  /// Waits (paused run) until a request comes in or the time is over.
  void idle(double seconds);
  /// True when the last telemetry is older than 100 ms: time to make a new one.
  bool telemetry_due() const;
  /// Sends telemetry to whoever listens; never waits. `run`, `from` and `role` are filled in.
  void publish(const wire::Telemetry& telemetry);
  /// True at most five times a second, where somebody watches: time to `show`.
  bool picture_due() const;
  /// Draws what is wished and sends it to whoever watches. `always`: also where drawing has taken too large a
  /// part of the time.
  void show(const Draw& draw, std::uint64_t step, bool always);
  /// The same for wishes that came since, while the run is paused.
  void show_missing(const Draw& draw, std::uint64_t step);
  /// Tells whoever listens that the run is over and why.
  void abort(const Failure& failure) noexcept;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace fsi::bus
