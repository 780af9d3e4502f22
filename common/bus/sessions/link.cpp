#include "common/bus/sessions/link.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "common/bus/convert.hpp"
#include "common/bus/peers/peer.hpp"

namespace fsi::bus {

namespace {

/// An Abort must not be lost, but a dead peer must not hold up the end either [s].
constexpr double abort_patience_s = 1;
/// Cyclone forgets a silent participant after this time [s]; it must outlive `peer_timeout`.
constexpr double shortest_participant_lease_s = 10;
/// Who waits for long repeats its telemetry this often [s].
constexpr double telemetry_repetition_s = 0.2;
/// And says this often what it lacks [s], more often where `peer_timeout`
/// is so short that it would come to nothing.
constexpr double longest_repetition_s = 1;
constexpr double repetitions_per_timeout = 4;

ExitCode exit_code_of(std::int32_t number) {
  constexpr std::array known = {ExitCode::user_mistake,  ExitCode::diverged,    ExitCode::peer_lost,
                                ExitCode::output_failed, ExitCode::interrupted, ExitCode::terminated};
  const auto* found = std::ranges::find(known, static_cast<ExitCode>(number));
  return found == known.end() ? ExitCode::internal_error : *found;
}

}  // namespace

double since(Clock::time_point moment) {
  return std::chrono::duration<double>(Clock::now() - moment).count();
}

void RoundTrips::add(double seconds) {
  if (seconds_.size() < kept) {
    seconds_.reserve(kept);
    seconds_.push_back(seconds);
  } else {
    seconds_[next_] = seconds;
    next_ = (next_ + 1) % kept;
  }
}

double RoundTrips::quantile_us(double fraction) const {
  if (seconds_.empty()) return 0;
  std::vector<double> sorted = seconds_;
  const auto rank = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end());
  return 1e6 * sorted[static_cast<std::size_t>(rank)];
}

wire::Traffic Heard::report(const std::string& interface, const std::string& from) const {
  return {.interface = interface,
          .from = from,
          .messages = messages,
          .bytes = bytes,
          .missing = missing,
          .dropped = dropped,
          .latency_p50_us = latency.quantile_us(0.5),
          .latency_p99_us = latency.quantile_us(0.99)};
}

void Complaints::forget() {
  count_ = 0;
  since_ = last_ = Clock::now();
}

void Complaints::add(double repetition_s) {
  if (since(last_) < repetition_s / 2) return;
  last_ = Clock::now();
  ++count_;
}

bool Complaints::convincing(double timeout_s) const {
  return count_ >= convincing_count && since(since_) > timeout_s;
}

Link::Link(BusOptions options, std::string role, std::string name)
    : options_(std::move(options)),
      role_(std::move(role)),
      name_(std::move(name)),
      host_(host_name()),
      domain_(join_domain(options_.run, std::max(shortest_participant_lease_s, 2 * options_.peer_timeout_s),
                          options_.network)),
      participant_(create_participant(options_.run, parse_key(options_.key), role_)),
      waitset_(participant_),
      abort_reader_(participant_, abort_topic, Delivery::lasting),
      abort_writer_(participant_, abort_topic, Delivery::lasting),
      telemetry_writer_(participant_, telemetry_topic, Delivery::listening),
      waiting_reader_(participant_, waiting_topic, Delivery::passing),
      waiting_writer_(participant_, waiting_topic, Delivery::passing),
      watchers_(participant_, options_.run) {
  waitset_.attach(abort_reader_.condition());
}

void Link::sleep(double seconds, const char* state) {
  const auto start = Clock::now();
  waitset_.wait(std::min(seconds, slice_s));
  statistics_.wait_s += since(start);
  repeat_telemetry(state);
  check_aborts();
  if (options_.throw_if_interrupted) options_.throw_if_interrupted();
}

void Link::check_aborts() {
  wire::Abort heard;
  abort_reader_.take([&](const amp_fsi_Abort& sample) {
    if (aborted_ || !same(sample.run, options_.run)) return;
    copy(sample, heard);
    aborted_ = true;
  });
  if (!heard.from.empty()) throw Failure(exit_code_of(heard.exit_code), heard.what, heard.place, heard.from);
}

bool Link::time_to_check() {
  if (since(last_check_) < slice_s) return false;
  last_check_ = Clock::now();
  return true;
}

double Link::repetition_s() const {
  return std::min(longest_repetition_s, options_.peer_timeout_s / repetitions_per_timeout);
}

bool Link::time_to_repeat() {
  if (since(last_word_) < repetition_s()) return false;
  last_word_ = Clock::now();
  return true;
}

void Link::say_waiting(const std::string& to, const std::string& topic, std::uint64_t step) {
  const wire::Waiting word{.run = options_.run, .from = name_, .to = to, .topic = topic, .step = step};
  send(waiting_writer_, waiting_topic, borrow(word));
}

std::vector<wire::Waiting> Link::others_waiting() {
  std::vector<wire::Waiting> heard;
  waiting_reader_.take([&](const amp_fsi_Waiting& sample) {
    if (same(sample.run, options_.run)) copy(sample, heard.emplace_back());
  });
  return heard;
}

void Link::publish(wire::Telemetry telemetry) {
  last_telemetry_ = Clock::now();
  const Statistics now = statistics();
  telemetry.run = options_.run;
  telemetry.from = name_;
  telemetry.role = role_;
  telemetry.host = host_;
  telemetry.pid = getpid();
  telemetry.messages = now.messages;
  telemetry.bytes = now.bytes;
  telemetry.round_trip_p50_us = now.round_trip_p50_us;
  telemetry.round_trip_p99_us = now.round_trip_p99_us;
  telemetry_writer_.write(borrow(telemetry).sample);
  telemetry_ = std::move(telemetry);
  waited_before_it_s_ = statistics_.wait_s;
  last_repetition_ = last_telemetry_;
  watchers_.look();
}

/// The latest telemetry once more, so that a program that waits is not taken for one that is gone. It does
/// not count as new: `telemetry_due` holds as before.
void Link::repeat_telemetry(const char* state) {
  if (telemetry_.run.empty() || since(last_repetition_) < telemetry_repetition_s) return;
  last_repetition_ = Clock::now();
  telemetry_.state = state;
  telemetry_.wait_s += statistics_.wait_s - waited_before_it_s_;
  waited_before_it_s_ = statistics_.wait_s;
  telemetry_writer_.write(borrow(telemetry_).sample);
  watchers_.look();
}

void Link::count(Heard& heard, std::size_t bytes, dds_time_t sent) {
  ++heard.messages;
  heard.bytes += bytes;
  ++statistics_.messages;
  statistics_.bytes += bytes;
  const auto now = dds_time();
  constexpr double nanoseconds = 1e-9;
  if (sent >= waiting_since_ && now >= sent) heard.latency.add(nanoseconds * static_cast<double>(now - sent));
}

void Link::count_dropped(Heard& heard) {
  ++heard.dropped;
  ++statistics_.stale;
}

void Link::abort(const Failure& failure) noexcept {
  if (aborted_) return;
  aborted_ = true;
  try {
    const wire::Abort message{.run = options_.run,
                              .from = name_,
                              .exit_code = static_cast<std::int32_t>(failure.code()),
                              .place = failure.place(),
                              .what = failure.cause()};
    send(abort_writer_, abort_topic, borrow(message));
    abort_writer_.arrived(abort_patience_s);
  } catch (const std::exception&) {  // the program ends anyway; its own failure is the one to report
    return;
  }
}

Statistics Link::statistics() const {
  Statistics result = statistics_;
  result.round_trip_p50_us = round_trips_.quantile_us(0.5);
  result.round_trip_p99_us = round_trips_.quantile_us(0.99);
  return result;
}

void end_by(const LostMessage& message, double waited_s, const std::string& how_known) {
  throw PeerLost(
      fmt::format("a message was lost: {} of step {} from {} to {} (topic '{}') did not arrive within "
                  "{:.3g} s (time.peer_timeout), though it was sent again and again: {}",
                  message.kind, message.step, message.from, message.to, message.topic, waited_s, how_known));
}

void check_compatible(const std::string& topic, std::uint32_t policy) {
  if (policy == 0) return;
  throw PeerLost(
      fmt::format("another program speaks '{}' differently: {} does not fit; build all programs of a run "
                  "from one version",
                  topic, policy_name(policy)));
}

}  // namespace fsi::bus
