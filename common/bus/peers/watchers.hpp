#pragma once
/// Who looks at pictures of the run, and at which quantities. A program that nobody watches pays one test.

#include <chrono>
#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "common/bus/dds.hpp"
#include "common/bus/options.hpp"
#include "common/wire/messages.hpp"

namespace fsi::bus {

inline constexpr const char* watch_topic = "amp_fsi/watch";
inline constexpr const char* picture_topic = "amp_fsi/picture";

class Watchers {
 public:
  Watchers(const Entity& participant, std::string run);

  /// Takes in who watches. Ten times a second is enough; `due` does not ask anew.
  void look();
  /// Somebody watches, and the last pictures are older than a fifth of a second.
  bool due() const { return !wishes_.empty() && Clock::now() >= next_; }
  bool any() const { return !wishes_.empty(); }
  /// The pictures asked for are on their way.
  void begin_pause() { next_ = Clock::now() + pause; }
  /// Draws and sends what is wished of the state of a step, unless drawing has lately taken more than a
  /// hundredth of the program's time. `always`: even then.
  void show(const Draw& draw, std::uint64_t step, bool always = false);
  /// Only what has been wished for since that state was shown: while the run is paused.
  void show_missing(const Draw& draw, std::uint64_t step);

  /// Sends one picture; `run` is filled in.
  void publish(wire::Picture picture);

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds pause{200};

  std::string run_;
  Reader<amp_fsi_Watch> reader_;
  Writer<amp_fsi_Picture> writer_;
  std::map<std::string, Clock::time_point> wishes_;  ///< ROLE.QUANTITY, when it was wished for last
  Clock::time_point next_{};
  double drawn_at_s_ = 0,
         rest_s_ = 0;  ///< of this thread's processor time: the last drawing, and the rest after it
  std::uint64_t shows_ = 0,
                every_ = 1;      ///< how often it was to show; of so many it draws one, a power of two
  std::set<std::string> shown_;  ///< of the state of `shown_step_`
  std::uint64_t shown_step_ = 0;

  bool has_rested();
  void draw_all(const Draw& draw, std::uint64_t step);
};

}  // namespace fsi::bus
