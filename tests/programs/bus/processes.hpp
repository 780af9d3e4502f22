#pragma once
/// Real processes for the tests that kill, stop and race them. The test itself never joins the bus.

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <ctime>
#include <functional>
#include <string>
#include <utility>

#include "common/core/failure.hpp"

namespace fsi::bus::test {

using Clock = std::chrono::steady_clock;

inline double since(Clock::time_point moment) {
  return std::chrono::duration<double>(Clock::now() - moment).count();
}

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
      alarm(60);  // nothing stays behind, whatever happens
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

  /// Next word of the program; empty when it ended or 30 s have passed.
  std::string hear() {
    std::string word;
    char c = 0;
    pollfd ready{.fd = in_, .events = POLLIN, .revents = 0};
    while (poll(&ready, 1, 30000) > 0 && read(in_, &c, 1) == 1 && c != '\n') word += c;
    return word;
  }

  /// Exit code (128 + signal when killed by one); -1 when it is still there after `seconds`.
  int end(double seconds) {
    const auto start = Clock::now();
    int status = 0;
    while (waitpid(pid_, &status, WNOHANG) == 0) {
      if (since(start) > seconds) return -1;
      usleep(5000);
    }
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
