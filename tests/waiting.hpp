#pragma once
/// The only clock of the tests. Who waits for something waits for it to happen (`until`); a time is only let
/// pass where nothing must happen in it. So a slower machine makes a test longer, never wrong.

#include <chrono>
#include <thread>

namespace fsi::test {

/// Nothing takes so long on any machine: who waits for it waits for ever [s].
inline constexpr double watchdog_s = 900;

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

inline void let_pass(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

/// Waits for a condition; false where it never holds.
template <class Condition>
bool until(const Condition& holds) {
  const Stopwatch watch;
  while (!holds()) {
    if (watch.seconds() > watchdog_s) return false;
    let_pass(0.005);
  }
  return true;
}

}  // namespace fsi::test
