/// Watches a run from outside; see README.md.

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <string>

#include "common/bus/listener.hpp"
#include "common/core/failure.hpp"
#include "monitor/registry.hpp"
#include "monitor/state.hpp"
#include "monitor/table.hpp"

namespace {

using namespace fsi;
using namespace fsi::monitor;

volatile std::sig_atomic_t caught = 0;

constexpr double refresh_s = 0.25;
constexpr double plain_refresh_s = 1;

struct Wishes {
  std::string run, send;
  bool once = false, json = false, plain = false;
  double wait_s = 5;  ///< how long `--once` waits for the first word
};

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Extent terminal_extent() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return {};
  return {.columns = size.ws_col, .rows = size.ws_row - 1};
}

std::string list_of(const std::vector<RunEntry>& runs) {
  std::string text;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    text += fmt::format("\n  {}  {}  ({} in {})", k + 1, runs[k].run, runs[k].name, runs[k].dir);
  }
  return text;
}

/// The run that is meant; asks when several may be and a person is there to answer.
RunEntry choose_run(const std::string& wanted) {
  const auto running = running_runs(registry_folders());
  const auto runs = matching(running, wanted);
  if (runs.size() == 1) return runs.front();
  if (runs.empty()) {
    if (running.empty()) throw UserMistake("no run is going on; start one with ./launch/fsi run CASE");
    throw UserMistake(fmt::format("no running run is called '{}'; running now:{}", wanted, list_of(running)));
  }
  if (isatty(STDIN_FILENO) == 0 || isatty(STDOUT_FILENO) == 0) {
    throw UserMistake("several runs are going on; name one:" + list_of(runs));
  }
  fmt::print("several runs are going on:{}\nwhich one? ", list_of(runs));
  std::fflush(stdout);
  std::size_t number = 0;
  std::cin >> number;
  if (!std::cin || number < 1 || number > runs.size()) throw UserMistake("no such run");
  return runs[number - 1];
}

/// Takes in what can be heard within `seconds`.
void listen(bus::Listener& listener, RunState& state, double seconds) {
  for (const wire::Telemetry& telemetry : listener.wait(seconds)) state.hear(telemetry, now());
  const auto& aborted = listener.aborted();
  if (aborted && !state.abort()) state.hear(*aborted);
  state.count_programs(listener.programs(), now());
}

void show_once(const Wishes& wishes, bus::Listener& listener, RunState& state) {
  const double start = now();
  const auto complete = [&] {
    const int heard = static_cast<int>(state.programs().size());
    return state.over() || (heard > 0 && heard >= listener.programs());
  };
  while (caught == 0 && !complete() && now() - start < wishes.wait_s) listen(listener, state, 0.1);
  if (state.programs().empty() && !state.abort()) {
    throw PeerLost(fmt::format("run '{}' said nothing for {} s", state.run().run, wishes.wait_s));
  }
  if (wishes.json) {
    fmt::print("{}\n", to_json(state, now()));
  } else {
    fmt::print("{}\n", plain_line(state));
  }
}

void follow_plain(const Wishes& wishes, bus::Listener& listener, RunState& state) {
  double last = 0;
  while (caught == 0 && !state.over()) {
    listen(listener, state, refresh_s);
    if (now() - last < plain_refresh_s && !state.over()) continue;
    last = now();
    fmt::print("{}\n", wishes.json ? to_json(state, last) : plain_line(state));
    if (std::fflush(stdout) != 0) return;  // whoever read this is gone
  }
}

/// The alternate screen for as long as it lives: what was on the terminal comes back.
class Screen {
 public:
  Screen() { fmt::print("\x1b[?1049h\x1b[?25l"); }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;
  Screen(Screen&&) = delete;
  Screen& operator=(Screen&&) = delete;
  ~Screen() {
    std::fputs("\x1b[?25h\x1b[?1049l", stdout);
    std::fflush(stdout);
  }
  static void show(const std::vector<std::string>& lines) {
    std::string text = "\x1b[H";
    for (const std::string& line : lines) text += line + "\x1b[K\r\n";
    fmt::print("{}\x1b[J", text);
    std::fflush(stdout);
  }
};

void follow_on_screen(bus::Listener& listener, RunState& state) {
  {
    const Screen screen;
    double last = 0;
    while (caught == 0 && !state.over()) {
      listen(listener, state, refresh_s);
      if (now() - last < refresh_s) continue;
      last = now();
      Screen::show(table(state, last, terminal_extent()));
    }
  }
  for (const std::string& line : table(state, now(), terminal_extent())) fmt::print("{}\n", line);
}

void act(const Wishes& wishes) {
  const RunEntry run = choose_run(wishes.run);
  if (!wishes.send.empty()) {
    bus::send_control(run.run, wishes.send);
    return;
  }
  bus::Listener listener(run.run);
  RunState state(run);
  if (wishes.once) {
    show_once(wishes, listener, state);
  } else if (wishes.plain || wishes.json || isatty(STDOUT_FILENO) == 0) {
    follow_plain(wishes, listener, state);
  } else {
    follow_on_screen(listener, state);
  }
}

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = [](int signal) { caught = signal; };
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  Wishes wishes;
  CLI::App app("Watches a run, without disturbing it, until it ends. Ctrl-C leaves; the run goes on.");
  app.add_option("RUN", wishes.run,
                 "identity, folder or case of the run; may be left out when only one is going on");
  app.add_flag("--once", wishes.once, "print the state once and exit");
  app.add_flag("--json", wishes.json, "print JSON, one object per line");
  app.add_flag("--plain", wishes.plain, "print one line per second instead of a table");
  app.add_option("--wait", wishes.wait_s, "longest wait of --once for the first word [s]")
      ->capture_default_str();
  app.add_option("--send", wishes.send, "send a request to the run instead of watching it")
      ->check(CLI::IsMember({"pause", "resume", "checkpoint", "stop"}));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::user_mistake);
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
    return static_cast<int>(ExitCode::expectation_missed);
  }
}
