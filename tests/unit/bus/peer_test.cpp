/// What the system tells of a program that the bus does not hear.

#include "common/bus/peers/peer.hpp"

#include <gtest/gtest.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): kill
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "common/core/failure.hpp"
#include "tests/waiting.hpp"

namespace fsi::bus {
namespace {

constexpr double timeout = 0.3;

/// A child that computes until it is ended.
class BusyChild {
 public:
  BusyChild() : pid_(fork()) {
    if (pid_ == 0) {
      volatile double work = 0;
      while (true) work = std::sqrt(work + 1);
    }
  }
  BusyChild(const BusyChild&) = delete;
  BusyChild& operator=(const BusyChild&) = delete;
  ~BusyChild() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_;
};

/// Looks after a silent program for three times as long as it may be silent.
void watch_in_silence(Peer& peer) {
  const fsi::test::Stopwatch watch;
  while (watch.seconds() < 3 * timeout) {
    peer.check(1, 0, timeout);
    fsi::test::let_pass(0.02);
  }
}

TEST(SilentPeer, IsNotLostWhileItComputes) {
  const BusyChild child;
  Peer peer("solid 'beam'", host_name(), child.pid());
  EXPECT_NO_THROW(watch_in_silence(peer));
}

TEST(SilentPeer, IsLostWhenItIsStopped) {
  const BusyChild child;
  Peer peer("solid 'beam'", host_name(), child.pid());
  kill(child.pid(), SIGSTOP);
  EXPECT_THROW(watch_in_silence(peer), PeerLost);
}

TEST(SilentPeer, OfAnotherMachineIsLostWhateverRunsHereUnderItsNumber) {
  const BusyChild child;
  Peer peer("solid 'beam'", "another-machine", child.pid());
  EXPECT_THROW(watch_in_silence(peer), PeerLost);
}

/// Looks after a program until it counts as lost; how often it was looked after before that, and why.
std::pair<int, std::string> looks_until_lost(const std::function<void()>& look) {
  for (int looks = 0;; ++looks) {
    try {
      look();
    } catch (const PeerLost& lost) {
      return {looks, lost.what()};
    }
    fsi::test::let_pass(last_word_s / 4);
  }
}

/// Its reason may have arrived between two looks at the mail: it must be read before the peer counts as lost.
TEST(PeerThatIsGone, IsNotLostBeforeItsLastWordCouldBeRead) {
  const BusyChild child;
  Peer peer("solid 'beam'", host_name(), child.pid());
  const auto [looks, why] = looks_until_lost([&] { peer.check(0, 0, timeout); });
  EXPECT_GE(looks, 1);
  EXPECT_NE(why.find("has left the run without saying why"), std::string::npos) << why;
}

TEST(PeerThatIsGone, IsNotLostBeforeItsLastWordCouldBeReadWhenItDied) {
  auto child = std::make_unique<BusyChild>();
  Peer peer("solid 'beam'", host_name(), child->pid());
  child.reset();
  const auto [looks, why] = looks_until_lost([&] { peer.check_process(); });
  EXPECT_GE(looks, 1);
  EXPECT_NE(why.find("has died"), std::string::npos) << why;
}

}  // namespace
}  // namespace fsi::bus
