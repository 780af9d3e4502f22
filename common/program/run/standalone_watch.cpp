#include "common/program/run/standalone_watch.hpp"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <system_error>

#include "common/bus/peers/peer.hpp"

namespace fsi {

namespace {

/// The watcher looks at least this often [s]; a limit may be any number.
constexpr double longest_sleep_s = 60;

double seconds_of(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

StandaloneWatch::StandaloneWatch(const Setup& setup, const io::Part& part)
    : setup_(setup), part_(part), report_(part) {
  const int error = pthread_getcpuclockid(pthread_self(), &work_clock_);
  if (error != 0) throw std::system_error(error, std::generic_category(), "clock of the first thread");
  begin();
  watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

void StandaloneWatch::end_step() {
  const std::scoped_lock lock(mutex_);
  if (const double work = work_s(); work > limit_s()) end_program(setup_, report_, lost(work));
  longest_work_s_ = std::max(longest_work_s_, work_s());
  report_ = part_;
  begin();
}

void StandaloneWatch::begin_step() {
  const std::scoped_lock lock(mutex_);
  begin();
}

void StandaloneWatch::begin() {
  work_began_s_ = seconds_of(work_clock_);
  clock_began_s_ = seconds_of(CLOCK_MONOTONIC);
}

double StandaloneWatch::work_s() const {
  return seconds_of(work_clock_) - work_began_s_;
}

double StandaloneWatch::limit_s() const {
  return std::max(setup_.problem.time.step_timeout, bus::slower_than_longest * longest_work_s_);
}

PeerLost StandaloneWatch::lost(double work) const {
  return PeerLost(
      fmt::format("no step for {:.3g} s, of which it computed for {:.3g} s: step {} does not end "
                  "(time.step_timeout; raise it where steps take so long)",
                  seconds_of(CLOCK_MONOTONIC) - clock_began_s_, work, report_.steps + 1));
}

/// A thread computes no faster than the clock goes: until then there is nothing to see.
void StandaloneWatch::watch(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    const double work = work_s(), left = limit_s() - work;
    if (left <= 0) end_program(setup_, report_, lost(work));
    wake_.wait_for(lock, stop, std::chrono::duration<double>(std::min(left, longest_sleep_s)),
                   [] { return false; });
  }
}

}  // namespace fsi
