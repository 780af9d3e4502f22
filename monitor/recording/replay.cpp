#include "monitor/recording/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

namespace fsi::monitor {

namespace {

/// Longest sleep between two looks at the clock [s].
constexpr double slice_s = 0.02;

}  // namespace

Replay::Replay(const std::string& path, double speed) : recording_(path), speed_(speed) {}

double Replay::now() const {
  const std::scoped_lock lock(clock_);
  return place();
}

double Replay::place() const {
  return held_ ? at_start_
               : at_start_ + speed_ * std::chrono::duration<double>(Clock::now() - start_).count();
}

void Replay::listen(RunState& state, double seconds) {
  const auto begun = Clock::now();
  bool heard = false;
  while (!heard && !finished_ && std::chrono::duration<double>(Clock::now() - begun).count() < seconds) {
    if (ahead_.empty()) {
      const auto next = recording_.next();
      ahead_.assign(next.begin(), next.end());
      finished_ = ahead_.empty();
    }
    for (; !ahead_.empty() && ahead_.front().at <= now(); ahead_.pop_front()) {
      if (const auto& telemetry = ahead_.front().telemetry) state.hear(*telemetry, ahead_.front().at);
      if (const auto& abort = ahead_.front().abort) state.hear(*abort);
      heard = true;
    }
    if (!heard) std::this_thread::sleep_for(std::chrono::duration<double>(std::min(slice_s, seconds)));
  }
  if (finished_) state.end();
}

std::string Replay::request(Request request) {
  const std::scoped_lock lock(clock_);
  at_start_ = place();
  start_ = Clock::now();
  switch (request) {
    case Request::pause:
      held_ = true;
      return "";
    case Request::resume:
      held_ = false;
      return "";
    case Request::checkpoint:
    case Request::stop:
      break;
  }
  return fmt::format("a replay cannot {}", name_of(request));
}

}  // namespace fsi::monitor
