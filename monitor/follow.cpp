#include "monitor/follow.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <future>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "monitor/json.hpp"
#include "monitor/recording/field_files.hpp"
#include "monitor/terminal/screen.hpp"
#include "monitor/terminal/terminal.hpp"

namespace fsi::monitor {

namespace {

volatile std::sig_atomic_t caught = 0;

using Clock = std::chrono::steady_clock;

constexpr double listen_s = 0.05;         ///< a key is answered within this time
constexpr double refresh_s = 0.25;        ///< time between two pictures
constexpr double plain_refresh_s = 1;     ///< time between two lines of one status
constexpr double web_refresh_s = 0.2;     ///< time between two states for browsers
constexpr double ask_s = 1;               ///< time between two words that somebody watches
constexpr double files_s = 0.5;           ///< time between two looks for new output files
constexpr double message_s = 4;           ///< how long a message stays
constexpr double patience_at_end_s = 10;  ///< how long the end stays on the screen unless a key is pressed

double since(Clock::time_point moment) {
  return std::chrono::duration<double>(Clock::now() - moment).count();
}

/// The person at the terminal: what the keys do.
class Keys {
 public:
  explicit Keys(Source& source) : source_(source) { view_.controls = source.controls(); }

  const View& view() const { return view_; }
  bool leaving() const { return leaving_; }
  bool touched() const { return touched_; }

  /// Returns true when the picture must change.
  bool take(const KeyPress& press) {
    if (press.key == Key::none) return false;
    if (press.key != Key::resized) touched_ = true;
    if (std::exchange(view_.ask_stop, false)) {
      if (press.letter == 'y') request(Request::stop);
      return true;
    }
    if (std::exchange(view_.help, false)) return true;
    if (press.key == Key::tab || press.key == Key::down) ++view_.interface;
    if (press.key == Key::up && view_.interface > 0) --view_.interface;
    if (press.key == Key::other) letter(press.letter);
    return true;
  }

  /// What became of requests; true when there is news.
  bool look_after_requests() {
    bool news = false;
    if (answer_.valid() && answer_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
      say(answer_.get());
      news = true;
    }
    if (!view_.message.empty() && !answer_.valid() && since(said_at_) > message_s) {
      view_.message.clear();
      news = true;
    }
    return news;
  }

  void say(const std::string& message) {
    view_.message = message;
    said_at_ = Clock::now();
  }

 private:
  void letter(char letter) {
    switch (letter) {
      case 'q':
        leaving_ = true;
        break;
      case 'h':
      case '?':
        view_.help = true;
        break;
      case 'p':
        request(Request::pause);
        break;
      case 'r':
        request(Request::resume);
        break;
      case 'c':
        request(Request::checkpoint);
        break;
      case 's':
        view_.ask_stop = true;
        break;
      default:
        break;
    }
  }

  /// In the background: a run that does not answer must not freeze the picture.
  void request(Request request) {
    if (answer_.valid()) return;
    say(fmt::format("{} ...", name_of(request)));
    answer_ = std::async(std::launch::async, [this, request] { return source_.request(request); });
  }

  Source& source_;
  View view_;
  std::future<std::string> answer_;
  Clock::time_point said_at_ = Clock::now();
  bool leaving_ = false, touched_ = false;
};

void follow(Terminal& terminal, Source& source, RunState& state) {
  Keys keys(source);
  auto drawn_at = Clock::now() - std::chrono::seconds(1);
  std::optional<Clock::time_point> over_since;
  while (caught == 0 && !keys.leaving()) {
    if (state.over()) {
      if (!over_since) {
        over_since = Clock::now();
        keys.say(fmt::format("the run is over ({}); q leaves", state.status()));
      }
      if (!keys.touched() && since(*over_since) > patience_at_end_s) return;
      std::this_thread::sleep_for(std::chrono::duration<double>(listen_s));
    } else {
      source.listen(state, listen_s);
    }
    bool news = keys.look_after_requests();
    for (KeyPress press = terminal.key(); press.key != Key::none; press = terminal.key())
      news = keys.take(press);
    if (!news && since(drawn_at) < refresh_s) continue;
    drawn_at = Clock::now();
    View view = keys.view();
    view.braille = terminal.braille();
    terminal.show(screen(state, source.now(), view, terminal.extent()));
  }
}

}  // namespace

bool interrupted() {
  return caught != 0;
}

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = [](int signal) { caught = signal; };
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGHUP, &action, nullptr);
}

void follow_on_terminal(Source& source, RunState& state) {
  Extent extent;
  View view;
  {
    Terminal terminal;
    if (!terminal.usable()) return follow_plain(source, state, false);
    follow(terminal, source, state);
    extent = {.columns = terminal.extent().columns, .rows = 24};
    view.braille = terminal.braille();
  }
  view.message.assign(1, ' ');  // no keys any more
  for (const std::string& line : screen(state, source.now(), view, extent).lines()) fmt::print("{}\n", line);
  if (const auto& abort = state.abort()) fmt::print("{} ended the run: {}\n", abort->from, abort->reason());
}

void follow_plain(Source& source, RunState& state, bool json) {
  auto last = Clock::now() - std::chrono::seconds(2);
  std::string told;
  while (caught == 0 && !state.over()) {
    source.listen(state, refresh_s);
    if (since(last) < plain_refresh_s && state.status() == told && !state.over()) continue;
    last = Clock::now();
    told = state.status();
    fmt::print("{}\n", json ? to_json(state, source.now()) : plain_line(state));
    if (std::fflush(stdout) != 0) return;  // whoever read this is gone
  }
}

namespace {

/// The pictures that browsers wish for: of what the run's files hold, and while it goes on of what its programs
/// draw.
class PicturesForBrowsers {
 public:
  PicturesForBrowsers(Source& source, const RunState& state, WebServer& server)
      : source_(source), state_(state), server_(server), files_(state.run().dir) {}

  void show() {
    for (const wire::Picture& picture : source_.pictures()) server_.show(picture);
    const std::vector<std::string> wishes = server_.wishes();
    if (wishes.empty()) return;
    if (!state_.over() && (wishes != wished_ || since(asked_) > ask_s)) {
      source_.watch(wishes);
      asked_ = Clock::now();
    }
    show_past(wishes);
    wished_ = wishes;
  }

 private:
  void show_past(const std::vector<std::string>& wishes) {
    if (!more_ && wishes == wished_ && since(looked_) < files_s) return;
    looked_ = Clock::now();
    const wire::Telemetry* leader = state_.leader();
    const bool all = leader == nullptr || state_.over() || !source_.files_lie_ahead();
    const double until = all ? HUGE_VAL : leader->t;
    const std::vector<wire::Picture> past = files_.next(wishes, until);
    for (const wire::Picture& picture : past) server_.show_past(picture);
    more_ = !past.empty();
  }

  Source& source_;
  const RunState& state_;
  WebServer& server_;
  FieldFiles files_;
  std::vector<std::string> wished_;
  Clock::time_point asked_ = Clock::now() - std::chrono::seconds(2), looked_ = asked_;
  bool more_ = false;  ///< the files may hold more than was shown
};

}  // namespace

void follow_web(Source& source, RunState& state, const WebOptions& options) {
  WebServer server(options);
  source.listen(state, 0);  // a page asks for what was when it is opened, and never again
  server.publish(state, source.now());
  fmt::print("{}\n", server.url());
  std::fflush(stdout);
  PicturesForBrowsers pictures(source, state, server);
  auto last = Clock::now();
  while (caught == 0 && !state.over()) {
    source.listen(state, listen_s);
    pictures.show();
    if (since(last) < web_refresh_s && !state.over()) continue;
    last = Clock::now();
    server.publish(state, source.now());
  }
  if (caught != 0) return;
  fmt::print("the run is over ({}); the page stays until Ctrl-C\n", state.status());
  std::fflush(stdout);
  while (caught == 0) {
    pictures.show();
    std::this_thread::sleep_for(std::chrono::duration<double>(listen_s));
  }
}

std::optional<RunEntry> choose_on_terminal(const std::vector<RunEntry>& runs) {
  const Terminal terminal;
  if (!terminal.usable()) return std::nullopt;
  std::size_t selected = 0;
  while (caught == 0) {
    terminal.show(chooser(runs, selected, terminal.extent()));
    const KeyPress press = terminal.key();
    if (press.key == Key::down || press.key == Key::tab) selected = (selected + 1) % runs.size();
    if (press.key == Key::up) selected = (selected + runs.size() - 1) % runs.size();
    if (press.key == Key::enter) return runs[selected];
    if (press.letter == 'q') return std::nullopt;
    const auto digit = static_cast<std::size_t>(press.letter - '1');
    if (press.letter >= '1' && press.letter <= '9' && digit < runs.size()) return runs[digit];
    if (press.key == Key::none) std::this_thread::sleep_for(std::chrono::duration<double>(listen_s));
  }
  return std::nullopt;
}

}  // namespace fsi::monitor
