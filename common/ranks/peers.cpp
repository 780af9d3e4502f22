#include "common/ranks/peers.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/core/log.hpp"

namespace fsi {

namespace {

/// A process as the system shows it.
struct Process {
  char state = 'X';   ///< R, S, D, T (stopped), Z (ended), X (there is none)
  bool ends = false;  ///< it is on its way out, though it may still look alive and have its children
  double work_s = 0;  ///< processor time so far [s]
};

Process process_of(int pid) {
  std::ifstream file(fmt::format("/proc/{}/stat", pid));
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return {};
  std::istringstream words(text.substr(name_end + 1));
  Process process;
  words >> process.state;
  const auto skip = [&words](int fields) {
    std::string skipped;
    for (int k = 0; k < fields; ++k) words >> skipped;
  };
  constexpr int before_flags = 5, before_times = 4;
  // PF_EXITING of the kernel, set before the files and connections of a process are closed.
  constexpr unsigned long exiting = 4;
  unsigned long flags = 0;
  skip(before_flags);
  words >> flags;
  process.ends = (flags & exiting) != 0;
  skip(before_times);
  double user = 0, system = 0;
  words >> user >> system;
  process.work_s = (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  return process;
}

/// The same on all ranks of one machine; exact as a double.
double number_of_host() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  constexpr std::size_t exact = 1ULL << 52U;
  return static_cast<double>(std::hash<std::string_view>{}(name.data()) % exact);
}

}  // namespace

RankPeers::RankPeers(Ranks& ranks, std::string name, const Limits& limits)
    : name_(std::move(name)), limits_(limits), parent_(getppid()), first_(ranks.first()) {
  const double host = number_of_host();
  const std::vector<double> all = ranks.together(std::array{static_cast<double>(getpid()), host});
  for (std::size_t rank = 0; rank < all.size() / 2; ++rank) {
    const bool other = static_cast<int>(rank) != ranks.rank();
    if (other && all[2 * rank + 1] == host)
      peers_.push_back({.rank = static_cast<int>(rank), .pid = static_cast<int>(all[2 * rank])});
    if (ranks.first()) log_info(fmt::format("rank {} is process {}", rank, static_cast<int>(all[2 * rank])));
  }
}

void RankPeers::look(bool begins) {
  check_parent();
  for (Peer& peer : peers_) look_at(peer, begins);
}

/// A rank may end with its mpirun before the others have another parent.
void RankPeers::check_parent() const {
  if (getppid() != parent_ || process_of(parent_).ends)
    throw PeerLost(fmt::format("lost mpirun (process {}), which started the ranks of {}", parent_, name_));
}

void RankPeers::look_at(Peer& peer, bool begins) const {
  const Process now = process_of(peer.pid);
  if (begins) peer.work_s = now.work_s;
  if (now.state == 'X' || now.state == 'Z') {
    check_parent();
    throw PeerLost(fmt::format("lost {}: it has ended", called(peer)));
  }
  const bool stopped = now.state == 'T' || now.state == 't';
  if (stopped && (!peer.stopped || begins)) peer.stopped_since = Clock::now();
  peer.stopped = stopped;
  const double for_s = std::chrono::duration<double>(Clock::now() - peer.stopped_since).count();
  if (stopped && for_s > limits_.stopped_s)
    throw PeerLost(
        fmt::format("lost {}: it has been stopped for {:.3g} s (time.peer_timeout)", called(peer), for_s));
  if (first_ && now.work_s - peer.work_s > limits_.step_s)
    throw PeerLost(
        fmt::format("lost {}: it has computed for {:.3g} s while rank 0 waited (time.step_timeout; "
                    "raise it where steps take so long)",
                    called(peer), now.work_s - peer.work_s));
}

std::string RankPeers::called(const Peer& peer) const {
  return fmt::format("rank {} of {} (process {})", peer.rank, name_, peer.pid);
}

}  // namespace fsi
