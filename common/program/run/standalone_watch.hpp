#pragma once
/// Finds a program that runs alone and computes without end. In a coupled run the others find it
/// (bus::Peer::check_step), by the same measure: processor time of its first thread since its last step.

#include <condition_variable>
#include <ctime>
#include <mutex>
#include <stop_token>
#include <thread>

#include "common/core/failure.hpp"
#include "common/io/part.hpp"
#include "common/program/program.hpp"

namespace fsi {

class StandaloneWatch {
 public:
  /// From now on the thread that calls owes a step. Where it computes for longer than `time.step_timeout`,
  /// and for longer than twenty times its longest step, the program ends as lost (exit 4).
  StandaloneWatch(const Setup& setup, const io::Part& part);
  StandaloneWatch(const StandaloneWatch&) = delete;
  StandaloneWatch& operator=(const StandaloneWatch&) = delete;
  StandaloneWatch(StandaloneWatch&&) = delete;
  StandaloneWatch& operator=(StandaloneWatch&&) = delete;
  ~StandaloneWatch() = default;

  /// The step that began before is done, and in the report; the next one begins.
  void end_step();
  /// The step begins only now: nothing before counts (the run was paused).
  void begin_step();

 private:
  const Setup& setup_;
  const io::Part& part_;
  clockid_t work_clock_ = 0;  ///< processor time of the thread that is watched

  std::mutex mutex_;                                                  ///< of all between here and the thread
  io::Part report_;                                                   ///< as it was after the last step
  double work_began_s_ = 0, clock_began_s_ = 0, longest_work_s_ = 0;  ///< [s]
  std::condition_variable_any wake_;
  std::jthread watcher_;  ///< last: it ends first

  void watch(const std::stop_token& stop);
  void begin();
  double work_s() const;
  double limit_s() const;
  PeerLost lost(double work) const;
};

}  // namespace fsi
