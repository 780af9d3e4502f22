#pragma once
/// The coupler's seat at the bus: everybody's predicted state in, everybody's projected state out.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/bus/options.hpp"
#include "common/core/failure.hpp"
#include "common/wire/messages.hpp"

namespace fsi::bus {

/// One program the coupler waits for.
struct Expected {
  std::string role;  ///< "fluid" or "solid"
  std::string name;  ///< "fluid", or the name of the gas or the solid in the case file
};

/// Opens a run on construction and leaves it in order on destruction.
/// Calls that wait end as those of SolverSession.
class CouplerSession {
 public:
  /// Waits for the hello of everybody in `who`, checks protocol and `config_digest`, and welcomes them all.
  /// @throws PeerLost naming who is missing or does not fit; the others are told the same
  CouplerSession(BusOptions options, std::vector<Expected> who, const std::string& config_digest);
  CouplerSession(CouplerSession&&) noexcept;
  CouplerSession& operator=(CouplerSession&&) noexcept;
  ~CouplerSession();

  /// Hello of every program, in the order of `who`.
  const std::vector<wire::Hello>& hellos() const;
  /// Waits for the predicted state of `step` of every program and interface: programs in the order of `who`,
  /// interfaces in the order of their hello. The span holds until the next `gather`.
  std::span<const wire::PredictedInterface> gather(std::uint64_t step);
  /// Sends each projected state to the program `to`, for its interface. `run` is filled in.
  void scatter(std::span<const wire::ProjectedInterface> projected);

  /// Requests that came in since the last call; never waits.
  std::vector<wire::Control> controls();
  /// Waits (paused run) until a request comes in or the time is over, watching everybody meanwhile.
  void idle(double seconds);

  /// True when the last telemetry is older than 100 ms: time to make a new one.
  bool telemetry_due() const;
  /// Sends telemetry to whoever listens; never waits. `run`,
  /// `from`, `role` and the bus statistics are filled in.
  void publish(wire::Telemetry telemetry);
  /// True at most five times a second, where somebody watches: time to let everybody `show`.
  bool picture_due() const;
  /// Somebody watches.
  bool watched() const;
  /// Sends a picture to whoever watches; `run` is filled in.
  void show(wire::Picture picture);

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
