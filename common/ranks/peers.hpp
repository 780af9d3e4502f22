#pragma once
/// Looks after the other ranks of a participant while this one waits for them: MPI itself would wait for ever for
/// a rank that was stopped, and what it does about one that died depends on how it is set.

#include <chrono>
#include <string>
#include <vector>

#include "common/core/failure.hpp"
#include "common/ranks/ranks.hpp"

namespace fsi {

class RankPeers {
 public:
  struct Limits {
    double stopped_s = 4;  ///< a rank may be stopped for so long [s]
    double step_s = 60;    ///< and compute for so long, in processor time, while rank 0 waits for it [s]
  };
  /// All ranks make theirs together. `name`: of the participant.
  RankPeers(Ranks& ranks, std::string name, const Limits& limits);

  /// What a rank does that waits, or has just begun to. @throws PeerLost naming the rank that is to blame
  void look(bool begins);

 private:
  using Clock = std::chrono::steady_clock;
  struct Peer {
    int rank = 0, pid = 0;
    bool stopped = false;
    Clock::time_point stopped_since{};
    double work_s = 0;  ///< processor time when the wait began
  };
  std::string name_;
  Limits limits_;
  std::vector<Peer> peers_;  ///< the others on this machine
  int parent_ = 0;           ///< whoever started the ranks
  bool first_ = false;       ///< rank 0: the others wait for it as long as it likes, in a pause say

  void check_parent() const;
  void look_at(Peer& peer, bool begins) const;
  std::string called(const Peer& peer) const;
};

}  // namespace fsi
