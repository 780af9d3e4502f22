#pragma once
/// Real processes for the tests that kill, stop and race them. The test itself never joins the bus.

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <functional>
#include <string>
#include <utility>

#include "common/core/failure.hpp"
#include "tests/waiting.hpp"

namespace fsi::bus::test {

using fsi::test::let_pass;
using fsi::test::until;
using fsi::test::watchdog_s;

/// What all processes of a test see: how far a run is, and whether it shall end.
class Shared {
 public:
  Shared()
      : place_(mmap(nullptr, sizeof(State), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)),
        state_(new(place_) State) {}
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;
  Shared(Shared&&) = delete;
  Shared& operator=(Shared&&) = delete;
  ~Shared() { munmap(place_, sizeof(State)); }

  std::atomic<std::uint64_t>& step() const { return state_->step; }
  std::atomic<bool>& end() const { return state_->end; }
  /// Waits until the run has taken so many more steps.
  bool go_on_for(std::uint64_t steps) const {
    return until([this, last = step() + steps] { return step() >= last; });
  }

 private:
  struct State {
    std::atomic<std::uint64_t> step = 0;
    std::atomic<bool> end = false;
  };
  void* place_;
  State* state_;
};

/// Computes for so many seconds of its own processor time.
inline void compute(double seconds) {
  const auto spent = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  for (const double end = spent() + seconds; spent() < end;) continue;
}

/// One forked program. Its body gets a function that sends a word to the test; a Failure ends it with its
/// code and sends the reason. Killed when it is still there at the end.
class Process {
 public:
  using Say = std::function<void(const std::string&)>;

  explicit Process(const std::function<void(const Say&)>& body) {
    std::array<int, 2> ends{};
    EXPECT_EQ(pipe(ends.data()), 0);
    pid_ = fork();
    if (pid_ == 0) {
      alarm(static_cast<unsigned>(2 * watchdog_s));  // nothing stays behind, whatever happens
      const Say say = [out = ends[1]](const std::string& word) {
        const std::string line = word + "\n";
        if (write(out, line.data(), line.size()) < 0) _exit(99);
      };
      _exit(run(body, say));
    }
    close(ends[1]);
    in_ = ends[0];
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  Process(Process&&) = delete;
  Process& operator=(Process&&) = delete;
  ~Process() {
    if (!ended_) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    close(in_);
  }

  int pid() const { return pid_; }
  void send(int signal) const { kill(pid_, signal); }

  /// Next word of the program; empty when it ended or never says one.
  std::string hear() {
    std::string word;
    char c = 0;
    pollfd ready{.fd = in_, .events = POLLIN, .revents = 0};
    while (poll(&ready, 1, static_cast<int>(1000 * watchdog_s)) > 0 && read(in_, &c, 1) == 1 && c != '\n')
      word += c;
    return word;
  }

  /// Exit code (128 + signal when killed by one), once it has ended; -1 when it never does.
  int end() {
    int status = 0;
    if (!until([&] { return waitpid(pid_, &status, WNOHANG) != 0; })) return -1;
    ended_ = true;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  static int run(const std::function<void(const Say&)>& body, const Say& say) {
    try {
      body(say);
      return testing::Test::HasFailure() ? 98 : 0;
    } catch (const Failure& failure) {
      say(failure.what());
      return static_cast<int>(failure.code());
    } catch (const std::exception& error) {
      say(error.what());
      return 97;
    }
  }

  pid_t pid_ = 0;
  int in_ = -1;
  bool ended_ = false;
};

}  // namespace fsi::bus::test
