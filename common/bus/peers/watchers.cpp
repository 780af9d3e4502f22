#include "common/bus/peers/watchers.hpp"

#include <algorithm>
#include <ctime>
#include <utility>
#include <vector>

#include "common/bus/convert.hpp"

namespace fsi::bus {

namespace {

/// Who watches says so every second; who has not for this time has left.
constexpr std::chrono::seconds patience{3};
/// After drawing, a program computes for so many times as long before it draws again.
constexpr double rest_per_work = 99;
/// More wishes than there are quantities, and longer names, are nobody's wish.
constexpr std::size_t most_wishes = 16, longest_wish = 32;

/// Processor time of this thread [s]: others on the machine change nothing.
double computed_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

Watchers::Watchers(const Entity& participant, std::string run)
    : run_(std::move(run)),
      reader_(participant, watch_topic, Delivery::asking),
      writer_(participant, picture_topic, Delivery::listening) {}

void Watchers::look() {
  const auto now = Clock::now();
  wire::Watch watch;
  reader_.take([&](const amp_fsi_Watch& sample) {
    if (!same(sample.run, run_)) return;
    copy(sample, watch);
    for (const std::string& wish : watch.wishes) {
      const bool known = wishes_.contains(wish);
      if (known || (wish.size() <= longest_wish && wishes_.size() < most_wishes)) wishes_[wish] = now;
    }
  });
  std::erase_if(wishes_, [now](const auto& wish) { return now - wish.second > patience; });
}

void Watchers::show(const Draw& draw, std::uint64_t step, bool always) {
  look();
  begin_pause();
  if (++shows_ % every_ != 0 && !always) return;
  if (!always && !has_rested()) return;
  shown_.clear();
  draw_all(draw, step);
}

/// All programs count alike, and each draws at multiples of a power of two: where they draw unequally often,
/// there are still steps of which all have a picture.
bool Watchers::has_rested() {
  constexpr std::uint64_t seldom = 64;
  constexpr double enough = 2.5;  // times the rest: twice as often is not too often either
  const double rested_s = computed_s() - drawn_at_s_;
  if (rested_s < rest_s_) every_ = std::min(2 * every_, seldom);
  if (rested_s > enough * rest_s_ && every_ > 1) every_ /= 2;
  return rested_s >= rest_s_;
}

void Watchers::show_missing(const Draw& draw, std::uint64_t step) {
  if (wishes_.empty()) return;
  if (step != shown_step_) shown_.clear();
  draw_all(draw, step);
}

void Watchers::draw_all(const Draw& draw, std::uint64_t step) {
  const double begun_s = computed_s();
  shown_step_ = step;
  for (const auto& [wish, wished_at] : wishes_) {
    if (!shown_.insert(wish).second) continue;
    if (auto picture = draw(wish)) publish(std::move(*picture));
  }
  const double now_s = computed_s();
  drawn_at_s_ = now_s;
  rest_s_ = rest_per_work * (now_s - begun_s);
}

void Watchers::publish(wire::Picture picture) {
  picture.run = run_;
  writer_.write(borrow(picture).sample);
}

}  // namespace fsi::bus
