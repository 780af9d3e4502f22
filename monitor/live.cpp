#include "monitor/live.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <fstream>
#include <thread>
#include <utility>

#include "common/bus/peers/peer.hpp"
#include "common/core/failure.hpp"
#include "monitor/recording/ended_run.hpp"

namespace fsi::monitor {

namespace {

/// Time between two looks at the processes [s].
constexpr double look_s = 0.25;

/// The launcher writes its summary within this time after the last program has ended [s].
constexpr double summary_s = 3;

}  // namespace

Live::Live(RunEntry run, const std::string& record)
    : run_(std::move(run)), listener_(run_.run, run_.key, run_.network), host_(bus::host_name()) {
  if (!record.empty()) recorder_ = std::make_unique<Recorder>(record, run_, now());
}

double Live::now() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void Live::listen(RunState& state, double seconds) {
  if (!std::exchange(table_read_, true) && !run_.dir.empty()) state.read_table(run_.dir + "/interface.csv");
  for (const wire::Telemetry& telemetry : listener_.wait(seconds)) {
    state.hear(telemetry, now());
    if (recorder_) recorder_->add(telemetry, now());
  }
  const auto& aborted = listener_.aborted();
  if (aborted && !state.abort()) {
    state.hear(*aborted);
    if (recorder_) recorder_->add(*aborted, now());
  }
  state.count_programs(listener_.programs(), now());
  if (now() - looked_at_ > look_s) look_at_processes(state);
  if (state.over()) learn_the_end(state);
  if (state.over() && recorder_) {
    recorder_->close();
    recorder_.reset();
  }
}

bool Live::heard_everybody(const RunState& state) const {
  const auto heard = state.programs().size();
  const auto connected = static_cast<std::size_t>(listener_.programs());
  return heard > 0 && heard >= std::max(connected, run_.participants.size());
}

void Live::learn_the_end(RunState& state) {
  if (state.abort() || run_.dir.empty()) return;
  const double start = now();
  auto ending = ending_of(run_.dir);
  while (!ending && now() - start < summary_s) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ending = ending_of(run_.dir);
  }
  if (!ending || !ending->abort) return;
  ending->abort->run = run_.run;
  state.hear(*ending->abort);
  if (recorder_) recorder_->add(*ending->abort, now());
}

void Live::look_at_processes(RunState& state) {
  looked_at_ = now();
  for (const auto& [name, program] : state.programs()) {
    if (program.pid > 0 && program.host == host_) state.see_process(name, process_state(program.pid));
  }
  // A run may end before any of its programs said a word; the launcher is the last to leave.
  if (run_.pid > 0 && process_state(run_.pid) == Process::gone) state.end();
}

std::string Live::request(Request request) {
  try {
    listener_.request(request);
    return fmt::format("{}: sent", name_of(request));
  } catch (const Failure& failure) {
    return fmt::format("{}: {}", name_of(request), failure.what());
  }
}

Process process_state(int pid) {
  std::ifstream file(fmt::format("/proc/{}/stat", pid));
  std::string text;
  if (!std::getline(file, text)) return Process::gone;
  const std::size_t name_end = text.rfind(") ");  // the name itself may contain anything
  if (name_end == std::string::npos) return Process::unknown;
  const char letter = text[name_end + 2];
  if (letter == 'Z' || letter == 'X') return Process::gone;
  return letter == 'T' || letter == 't' ? Process::stopped : Process::lives;
}

}  // namespace fsi::monitor
