#pragma once
/// Watching a run from outside without ever disturbing it, and asking it for something.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/wire/messages.hpp"
#include "common/wire/request.hpp"

namespace fsi::bus {

/// Best-effort reader of everybody's telemetry: a listener that freezes costs the run nothing.
class Listener {
 public:
  /// `key` is that of the run; without it a protected run cannot be heard. `network`: BusOptions.
  explicit Listener(const std::string& run, const std::string& key = {}, const std::string& network = {});
  Listener(Listener&&) noexcept;
  Listener& operator=(Listener&&) noexcept;
  ~Listener();

  /// What arrived, newest per program; waits up to `seconds` for the first.
  std::vector<wire::Telemetry> wait(double seconds);
  /// Says that somebody looks at these quantities (ROLE.QUANTITY); to be said again every second.
  void watch(const std::vector<std::string>& wishes);
  /// The pictures that came with the last `wait`, newest per program and quantity. Damaged ones are left out.
  std::vector<wire::Picture> pictures();
  /// The Abort that ended the run, once one was heard.
  const std::optional<wire::Abort>& aborted() const;
  /// Programs of the run that can be heard now.
  int programs() const;
  /// As `send_control`, by who listens already: with protection a second participant of one process would end
  /// what the first one hears. @throws PeerLost
  void request(Request request, double timeout_s = 10);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Sends a request to a run and returns when it has arrived. A
/// protected run hears only who knows its `key`.
/// `meanwhile` is called several times a second; what it throws ends the wait.
/// @throws PeerLost nobody takes requests for that run within `timeout_s`
void send_control(const std::string& run, const std::string& key, Request request, double timeout_s = 3,
                  const std::string& network = {}, const std::function<void()>& meanwhile = {});

}  // namespace fsi::bus
