#pragma once
/// A gas or solid solver's seat at the bus: one sample out and one in, per step and interface (Procedure 1).

#include <cstdint>
#include <memory>
#include <string>

#include "common/bus/options.hpp"
#include "common/core/failure.hpp"
#include "common/wire/messages.hpp"

namespace fsi::bus {

/// Joins a run on construction and leaves it in order on destruction.
///
/// Every call that waits ends with a Failure, never with a hang: the code and reason of another program's
/// Abort, PeerLost with the name of who is gone or silent, or what `throw_if_interrupted` throws.
class SolverSession {
 public:
  /// Says hello and waits until the coupler has welcomed everybody.
  /// `run`, `host` and `pid` of `self` are filled in.
  /// @throws PeerLost the coupler is missing, or somebody does not fit (the reason is named)
  SolverSession(BusOptions options, wire::Hello self);
  SolverSession(SolverSession&&) noexcept;
  SolverSession& operator=(SolverSession&&) noexcept;
  ~SolverSession();

  /// Sends the predicted state of one interface without copying its arrays. `run` and `from` are filled in.
  void publish(const wire::PredictedInterface& predicted);
  /// Waits for the coupler's answer to `step` on one interface. The reference holds until the next `receive`
  /// of the same interface. Answers to other runs or older steps are dropped.
  const wire::ProjectedInterface& receive(const std::string& interface, std::uint64_t step);

  /// Tells the coupler that this solver was asked to end; never waits.
  void ask_to_end();

  /// True when the last telemetry is older than 100 ms: time to make a new one.
  bool telemetry_due() const;
  /// Sends telemetry to whoever listens; never waits. `run`,
  /// `from`, `role` and the bus statistics are filled in.
  void publish(wire::Telemetry telemetry);
  /// Draws what is wished and sends it to whoever watches: when the coupler says so. `always`: also where
  /// drawing has taken too large a part of the time.
  void show(const Draw& draw, std::uint64_t step, bool always);
  /// Somebody watches, and this program has waited for long: the run is paused.
  bool waits_watched() const;
  /// The same for wishes that came since the state was shown.
  void show_missing(const Draw& draw, std::uint64_t step);

  /// Tells everybody that the run is over and why, and makes sure they got it. Does nothing when the end came
  /// from somebody else's Abort.
  void abort(const Failure& failure) noexcept;
  /// Waits until all that was sent has arrived, then leaves. The destructor does the same.
  void leave() noexcept;

  Statistics statistics() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace fsi::bus
