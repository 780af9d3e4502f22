#include "common/bus/peers/newcomer.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "common/bus/peers/peer.hpp"
#include "common/core/failure.hpp"

namespace fsi::bus {

Newcomer::Newcomer(std::string label, int pid) : label_(std::move(label)), pid_(pid) {
  if (pid_ != 0) born_ = start_time(pid_);
}

void Newcomer::look() {
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - std::exchange(last_look_, now)).count();
  if (pid_ == 0) {
    idle_s_ += seconds;
    return;
  }
  const std::optional<Activity> activity = activity_of(pid_);
  if (born_ == 0 || !activity || start_time(pid_) != born_)
    throw PeerLost(fmt::format("{} (pid {}) ended before it joined the run", label_, pid_));
  const bool busy = activity->computing_or_reading || activity->computed != computed_;
  computed_ = activity->computed;
  if (!busy) idle_s_ += seconds;
}

void Newcomer::joined() {
  pid_ = 0;
  idle_s_ = 0;
}

}  // namespace fsi::bus
