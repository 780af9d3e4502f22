/// Watches a run from outside; see README.md.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "common/bus/sessions/listener.hpp"
#include "common/core/command_line.hpp"
#include "common/core/failure.hpp"
#include "monitor/follow.hpp"
#include "monitor/json.hpp"
#include "monitor/live.hpp"
#include "monitor/recording/ended_run.hpp"
#include "monitor/recording/replay.hpp"
#include "monitor/registry.hpp"
#include "monitor/state.hpp"
#include "monitor/terminal/screen.hpp"

namespace {

using namespace fsi;
using namespace fsi::monitor;

/// `--once` listens for so much longer than it must, so that rates are known [s].
constexpr double time_for_rates_s = 0.4;

struct Wishes {
  std::string run, send, record, replay, host = "127.0.0.1";
  bool once = false, json = false, plain = false;
  int web = -1;       ///< port of the page; -1: none
  double wait_s = 5;  ///< how long `--once` waits for the first word
  double speed = 1;   ///< of a replay
};

bool at_terminal() {
  return isatty(STDIN_FILENO) != 0 && isatty(STDOUT_FILENO) != 0;
}

std::string list_of(const std::vector<RunEntry>& runs) {
  std::string text;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    text += fmt::format("\n  {}  {}  ({} in {})", k + 1, runs[k].run, runs[k].name, runs[k].dir);
  }
  return text;
}

/// A request to the only run that goes on, which nobody named: it may be somebody else's on this account.
/// None when the person says no.
std::optional<RunEntry> confirmed(const Wishes& wishes, const RunEntry& run) {
  if (wishes.send.empty() || !wishes.run.empty()) return run;
  if (!at_terminal())
    throw UserMistake(
        fmt::format("name the run that shall {}: {}  ({} in {})", wishes.send, run.run, run.name, run.dir));
  fmt::print("{} {} ({} in {})? [y/N] ", wishes.send, run.run, run.name, run.dir);
  std::fflush(stdout);
  std::string answer;
  std::getline(std::cin, answer);
  if (answer == "y" || answer == "Y" || answer == "yes") return run;
  fmt::print("nothing was asked\n");
  return std::nullopt;
}

/// The run that is meant; asks when several may be and a person is there to answer. None when they leave.
std::optional<RunEntry> choose_run(const Wishes& wishes) {
  const auto running = running_runs(registry_folder());
  const auto runs = matching(running, wishes.run);
  if (runs.size() == 1) return confirmed(wishes, runs.front());
  if (runs.empty()) {
    if (std::filesystem::is_directory(wishes.run))
      throw UserMistake(
          fmt::format("no run goes on in '{0}'; write --replay {0} to see one that is over", wishes.run));
    if (running.empty()) throw UserMistake("no run is going on; start one with ./launch/fsi run CASE");
    throw UserMistake(
        fmt::format("no running run is called '{}'; running now:{}", wishes.run, list_of(running)));
  }
  if (!at_terminal() || wishes.once || !wishes.send.empty()) {
    throw UserMistake("several runs are going on; name one:" + list_of(runs));
  }
  return choose_on_terminal(runs);
}

void print(const Wishes& wishes, const RunState& state, double now) {
  fmt::print("{}\n", wishes.json ? to_json(state, now) : plain_line(state));
}

void show_once(const Wishes& wishes, Live& live, RunState& state) {
  const double start = live.now();
  while (!interrupted() && !state.over() && !live.heard_everybody(state) &&
         live.now() - start < wishes.wait_s) {
    live.listen(state, 0.1);
  }
  if (state.programs().empty() && !state.abort()) {
    throw PeerLost(fmt::format("run '{}' said nothing for {} s", state.run().run, wishes.wait_s));
  }
  const double heard = live.now();
  while (!interrupted() && !state.over() && live.now() - heard < time_for_rates_s) live.listen(state, 0.1);
  print(wishes, state, live.now());
}

void follow(const Wishes& wishes, Source& source, RunState& state) {
  if (wishes.web >= 0) {
    follow_web(source, state,
               {.host = wishes.host, .port = wishes.web, .request = [&source](Request request) {
                  return source.request(request);
                }});
  } else if (wishes.plain || wishes.json || isatty(STDOUT_FILENO) == 0) {
    follow_plain(source, state, wishes.json);
  } else {
    follow_on_terminal(source, state);
  }
}

void show_again(const Wishes& wishes, Source& source, const RunEntry& run) {
  RunState state(run);
  if (!wishes.once) return follow(wishes, source, state);
  while (!interrupted() && !state.over()) source.listen(state, 1);
  print(wishes, state, source.now());
}

/// A recording, or the folder of a run that is over.
void replay(const Wishes& wishes) {
  if (std::filesystem::is_directory(wishes.replay)) {
    EndedRun source(wishes.replay);
    return show_again(wishes, source, source.run());
  }
  Replay source(wishes.replay, wishes.once ? 1e9 : wishes.speed);
  show_again(wishes, source, source.run());
}

/// On a busy machine it takes seconds until the run knows who asks.
void send(Request request, const RunEntry& run) {
  constexpr double patience_s = 30, silence_s = 3;
  const auto start = std::chrono::steady_clock::now();
  bool told = false;
  bus::send_control(run.run, run.key, request, patience_s, run.network, [&] {
    if (interrupted())
      throw Failure(ExitCode::interrupted, fmt::format("interrupted before {} answered", run.run));
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
    if (told || waited.count() < silence_s) return;
    told = true;
    fmt::print(stderr, "{} has not answered yet; this waits {} s\n", run.run, patience_s);
  });
  fmt::print("{} has heard: {}\n", run.run, name_of(request));
  if (request == Request::checkpoint || request == Request::stop)
    fmt::print("the checkpoint goes to {}/checkpoints\n", run.dir);
}

void act(const Wishes& wishes) {
  if (!wishes.replay.empty()) return replay(wishes);
  const auto run = choose_run(wishes);
  if (!run) return;
  if (const auto request = named<Request>(wishes.send)) return send(*request, *run);
  Live live(*run, wishes.record);
  RunState state(*run);
  if (wishes.once) return show_once(wishes, live, state);
  follow(wishes, live, state);
}

void add_options(CommandLine& line, Wishes& wishes) {
  const auto run = line.add_option(
      "RUN", wishes.run, "identity, folder or case of the run; may be left out when only one is going on");
  const auto once = line.add_flag("--once", wishes.once, "print the state once and exit");
  line.add_flag("--json", wishes.json, "print JSON, one object per line");
  line.add_flag("--plain", wishes.plain,
                "print a line per second, and when the status changes, instead of using the whole terminal");
  line.add_option("--wait", wishes.wait_s,
                  fmt::format("longest wait of --once for the first word [s] ({})", wishes.wait_s))
      .needs(once);
  const auto web =
      line.add_option("--web", wishes.web, "serve a page for browsers at this port; 0 finds a free one");
  line.add_option("--host", wishes.host,
                  "address of the page; other machines see it where this is not loopback")
      .needs(web);
  const auto record = line.add_option("--record", wishes.record, "write everything heard to this HDF5 file");
  const auto replay = line.add_option(
      "--replay", wishes.replay, "show a recording, or the folder of a run that is over, instead of a run");
  line.add_option("--speed", wishes.speed, "of the replay: 2 is twice as fast").needs(replay);
  const auto send =
      line.add_option("--send", wishes.send, "send a request to the run instead of watching it");
  for (const auto& other : {run, record, send}) replay.excludes(other);
  for (const auto& other : {record, web, once}) send.excludes(other);
  once.excludes(web);
}

/// @throws UserMistake
void check(const Wishes& wishes) {
  constexpr int no_page = -1, last_port = 65535;
  if (wishes.web < no_page || wishes.web > last_port)
    throw UserMistake(fmt::format("--web: {} is no port; write 0 to {}", wishes.web, last_port));
  if (!(wishes.speed > 0)) throw UserMistake("--speed must be positive");
  if (!wishes.send.empty() && !named<Request>(wishes.send)) {
    throw UserMistake(
        fmt::format("--send: '{}' is no request; write {}", wishes.send, fmt::join(words_of<Request>, ", ")));
  }
}

}  // namespace

int main(int argc, char** argv) {
  Wishes wishes;
  CommandLine line("Watches a run, without disturbing it, until it ends. Ctrl-C leaves; the run goes on.");
  add_options(line, wishes);
  try {
    if (!line.parse(argc, argv)) return 0;
    check(wishes);
  } catch (const UserMistake& mistake) {
    fmt::print(stderr, "monitor: {}\n", mistake.what());
    return static_cast<int>(mistake.code());
  }
  catch_signals();
  try {
    act(wishes);
    return 0;
  } catch (const Failure& failure) {
    fmt::print(stderr, "monitor: {}\n", failure.what());
    return static_cast<int>(failure.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "monitor: {}\n", error.what());
    return static_cast<int>(ExitCode::internal_error);
  }
}
