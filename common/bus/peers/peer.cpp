#include "common/bus/peers/peer.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

#include "common/core/failure.hpp"

namespace fsi::bus {

namespace {

constexpr int between_state_and_user_time = 10;

/// Who waits wakes up ten times a second to look around; on a busy machine less often.
constexpr double wakes_per_s = 2;
/// And computes no more than this share of the time.
constexpr double looking_around = 0.2;

/// Of a process' first thread. Nothing where the system does not tell.
std::optional<Pulse> pulse_of(int pid) {
  std::ifstream stat(fmt::format("/proc/{0}/task/{0}/stat", pid)),
      status(fmt::format("/proc/{0}/task/{0}/status", pid));
  std::string line, state, word;
  if (!std::getline(stat, line) || line.rfind(')') == std::string::npos) return {};
  std::istringstream fields(line.substr(line.rfind(')') + 1));
  fields >> state;
  for (int k = 0; k < between_state_and_user_time; ++k) fields >> word;
  std::uint64_t user = 0, system = 0, waited = 0;
  fields >> user >> system;
  while (status >> word && word != "voluntary_ctxt_switches:") continue;
  if (!fields || !(status >> waited)) return {};
  return Pulse{.computed = user + system, .waited = waited, .sleeping = state == "S", .ready = state == "R"};
}

double work_between(const Pulse& begin, const Pulse& end) {
  return static_cast<double>(end.computed - begin.computed) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

/// What /proc/PID/stat says behind the name of the program; empty where there is no process.
std::istringstream stat_of(int pid) {
  std::ifstream file(fmt::format("/proc/{}/stat", pid));
  std::string line;
  std::getline(file, line);
  const auto name_end = line.rfind(')');  // the name may hold blanks and brackets
  return std::istringstream(name_end == std::string::npos ? "" : line.substr(name_end + 1));
}

}  // namespace

std::uint64_t start_time(int pid) {
  std::istringstream fields = stat_of(pid);
  std::string state;
  if (!(fields >> state) || state == "Z" || state == "X") return 0;
  constexpr int between_state_and_start = 18;
  std::string skipped;
  for (int k = 0; k < between_state_and_start; ++k) fields >> skipped;
  std::uint64_t ticks = 0;
  fields >> ticks;
  return ticks;
}

std::optional<Activity> activity_of(int pid) {
  std::istringstream fields = stat_of(pid);
  std::string state, skipped;
  fields >> state;
  for (int k = 0; k < between_state_and_user_time; ++k) fields >> skipped;
  std::uint64_t user = 0, system = 0;
  if (!(fields >> user >> system) || state == "Z" || state == "X") return {};
  return Activity{.computed = user + system, .computing_or_reading = state == "R" || state == "D"};
}

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

Peer::Peer(std::string label, const std::string& host, int pid)
    : label_(std::move(label)), called_(fmt::format("{} (pid {})", label_, pid)), pid_(pid) {
  if (host == host_name()) {
    born_ = start_time(pid);
  } else {
    host_ = host;
    called_ = fmt::format("{} (pid {} on {})", label_, pid, host);
  }
}

bool Peer::is_dead() const {
  return born_ != 0 && start_time(pid_) != born_;
}

void Peer::miss(const char* how) {
  const auto now = std::chrono::steady_clock::now();
  if (!gone_since_) gone_since_ = now;
  if (std::chrono::duration<double>(now - *gone_since_).count() >= last_word_s)
    throw PeerLost(fmt::format("{} {}", called_, how));
}

void Peer::check_process() {
  if (is_dead()) miss("has died");
}

void Peer::check(int matched, int alive, double timeout_s) {
  if (is_dead()) return miss("has died");
  if (matched == 0) return miss("has left the run without saying why");
  if (alive > 0) {
    silent_since_.reset();
    check_pulse(timeout_s);
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (!silent_since_ || goes_on()) silent_since_ = now;
  if (std::chrono::duration<double>(now - *silent_since_).count() > timeout_s) {
    throw PeerLost(fmt::format(
        "{} has been silent for {} s (time.peer_timeout); is it stopped{}?", called_, timeout_s,
        host_.empty() ? "" : fmt::format(", or {} switched off, or the network to it cut", host_)));
  }
}

void Peer::begin_step() {
  owes_since_ = std::chrono::steady_clock::now();
  step_began_.reset();
  work_s_ = 0;
}

void Peer::end_step() {
  longest_work_s_ = std::max(longest_work_s_, work_s_);
  owes_since_.reset();
}

void Peer::check_step(std::uint64_t step, double step_timeout_s) {
  if (!owes_since_) return;
  const double limit = std::max(step_timeout_s, slower_than_longest * longest_work_s_);
  const double waited =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - *owes_since_).count();
  const std::optional<Pulse> now = born_ != 0 ? pulse_of(pid_) : std::nullopt;
  if (now && !step_began_) step_began_ = now;
  if (now) work_s_ = work_between(*step_began_, *now);
  if (work_s_ <= limit && waited <= clock_over_work * limit) return;
  throw PeerLost(fmt::format("{} lives but has not finished step {} within {:.3g} s{} (time.step_timeout)",
                             called_, step, waited,
                             now ? fmt::format(", of which it computed for {:.3g} s", work_s_) : ""));
}

void Peer::check_endless(double step_timeout_s) {
  const std::optional<Pulse> now = born_ != 0 ? pulse_of(pid_) : std::nullopt;
  if (!now) return;
  if (!last_nap_ || now->waited != last_nap_->waited) last_nap_ = now;
  if (work_between(*last_nap_, *now) <= step_timeout_s) return;
  throw PeerLost(fmt::format("{} hangs: it computes without end, for {:g} s (time.step_timeout) by now",
                             called_, step_timeout_s));
}

bool Peer::rested(double seconds) {
  const std::optional<Pulse> now = born_ != 0 ? pulse_of(pid_) : std::nullopt;
  if (!now) return false;
  const auto time = std::chrono::steady_clock::now();
  const bool can_go_on = now->sleeping || now->ready;  // not stopped, not waiting for a disk
  if (!quiet_ || !can_go_on) {
    quiet_ = now;
    quiet_since_ = time;
    return false;
  }
  const double quiet_s = std::chrono::duration<double>(time - *quiet_since_).count();
  return quiet_s > seconds && static_cast<double>(now->waited - quiet_->waited) >= wakes_per_s * quiet_s &&
         work_between(*quiet_, *now) <= looking_around * quiet_s;
}

bool Peer::goes_on() {
  const std::optional<Pulse> now = born_ != 0 ? pulse_of(pid_) : std::nullopt;
  if (!now) return false;
  const bool moved = now->computed != pulse_.computed || now->waited != pulse_.waited;
  pulse_ = *now;
  return moved || pulse_.ready;
}

void Peer::check_pulse(double timeout_s) {
  if (born_ == 0) return;
  const std::optional<Pulse> now = pulse_of(pid_);
  const bool asleep =
      now && now->sleeping && now->computed == pulse_.computed && now->waited == pulse_.waited;
  if (now) pulse_ = *now;
  if (!asleep) {
    asleep_since_.reset();
    return;
  }
  const auto time = std::chrono::steady_clock::now();
  if (!asleep_since_) asleep_since_ = time;
  if (std::chrono::duration<double>(time - *asleep_since_).count() > timeout_s) {
    throw PeerLost(
        fmt::format("{} hangs: it lives, but for {} s (time.peer_timeout) it has neither "
                    "computed nor answered",
                    called_, timeout_s));
  }
}

}  // namespace fsi::bus
