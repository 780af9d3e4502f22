#pragma once
/// Several processes that compute one participant together: who they are, and what they tell each other.
///
///     rank 0   sits on the bus, writes the files, says what is done next
///     others   do it on their part
///
/// Everything is a list of doubles. Who sends what to whom both sides know beforehand, so nothing is
/// negotiated. With one rank, which is what a program is unless it is told otherwise, nothing is sent at all.
/// Several take Open MPI, which is in a module of its own: a program without it runs where there is no MPI.

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace fsi {

/// Values that go to another rank, or come from it; both sides know how many.
struct Parcel {
  int rank = 0;
  std::span<double> values;
};

/// Where a rank runs.
struct RankPlace {
  int pid = 0;
  std::string host;
};

class Ranks {
 public:
  Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  Ranks(Ranks&&) = delete;
  Ranks& operator=(Ranks&&) = delete;
  virtual ~Ranks() = default;

  virtual int rank() const = 0;
  virtual int size() const = 0;
  bool alone() const { return size() == 1; }
  bool first() const { return rank() == 0; }

  // Of these every rank calls the same ones in the same order.

  /// Sends and receives, at most one parcel to and from each other rank.
  virtual void exchange(std::span<const Parcel> sent, std::span<const Parcel> received) = 0;
  /// The values of rank 0, and how many there are, become everybody's.
  virtual void broadcast(std::vector<double>& values) = 0;
  /// The values of all ranks, one rank after the other.
  virtual std::vector<double> together(std::span<const double> mine) = 0;
  /// Each value becomes the largest that any rank has in its place.
  virtual void largest_of_each(std::span<double> values) = 0;
  /// The largest value of all.
  double largest(double mine) {
    largest_of_each({&mine, 1});
    return mine;
  }

  /// The last call: all ranks have come to the end.
  virtual void leave() = 0;

  /// What a rank does some hundred times a second while it waits for others, told whether the wait has only begun;
  /// may throw.
  void while_waiting(std::function<void(bool begins)> action) { waiting_ = std::move(action); }
  /// Messages and values this rank has sent so far.
  struct Sent {
    double messages = 0, values = 0;
  };
  const Sent& sent() const { return sent_; }

 protected:
  void look_around(bool begins) const {
    if (waiting_) waiting_(begins);
  }
  void count(std::size_t values) {
    sent_.messages += 1;
    sent_.values += static_cast<double>(values);
  }

 private:
  std::function<void(bool)> waiting_;
  Sent sent_;
};

/// One rank: itself.
std::shared_ptr<Ranks> one_rank();

/// As many ranks as were started together by mpirun. @throws UserMistake where the module is missing, or not
/// so many were started
std::shared_ptr<Ranks> open_ranks(int size);

/// A string as values, for a list.
std::vector<double> as_values(const std::string& text);
/// The other way round.
std::string as_text(std::span<const double> values);

}  // namespace fsi
