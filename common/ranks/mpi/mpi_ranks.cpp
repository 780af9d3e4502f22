/// Ranks on MPI. Only the thread that opened them calls it, and nothing of it waits inside MPI: a rank that waits
/// looks around, and soon sleeps between two looks, so that programs that share cores do not hinder each other.

#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <climits>
#include <csignal>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "common/ranks/module.hpp"

namespace fsi {

namespace {

void check(int code, const char* what) {
  if (code == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int length = 0;
  MPI_Error_string(code, text.data(), &length);
  throw std::runtime_error(std::string("MPI: ") + what + ": " + text.data());
}

int count_of(std::size_t values) {
  if (values > INT_MAX) throw std::runtime_error("MPI: more than 2^31 values in one message; use more ranks");
  return static_cast<int>(values);
}

/// Signals are the program's: what MPI installs at its start goes away again.
class SignalsKept {
 public:
  SignalsKept() {
    for (std::size_t k = 1; k < actions_.size(); ++k) sigaction(static_cast<int>(k), nullptr, &actions_[k]);
  }
  SignalsKept(const SignalsKept&) = delete;
  SignalsKept& operator=(const SignalsKept&) = delete;
  SignalsKept(SignalsKept&&) = delete;
  SignalsKept& operator=(SignalsKept&&) = delete;
  ~SignalsKept() {
    for (std::size_t k = 1; k < actions_.size(); ++k) sigaction(static_cast<int>(k), &actions_[k], nullptr);
  }

 private:
  std::array<struct sigaction, 32> actions_{};
};

class MpiRanks final : public Ranks {
 public:
  MpiRanks() {
    int provided = 0;
    {
      const SignalsKept kept;
      check(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided), "start");
    }
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void exchange(std::span<const Parcel> sent, std::span<const Parcel> received) override {
    requests_.clear();
    for (const Parcel& parcel : received) {
      if (parcel.values.empty()) continue;
      check(MPI_Irecv(parcel.values.data(), count_of(parcel.values.size()), MPI_DOUBLE, parcel.rank, tag,
                      MPI_COMM_WORLD, &requests_.emplace_back()),
            "receive");
    }
    for (const Parcel& parcel : sent) {
      if (parcel.values.empty()) continue;
      count(parcel.values.size());
      check(MPI_Isend(parcel.values.data(), count_of(parcel.values.size()), MPI_DOUBLE, parcel.rank, tag,
                      MPI_COMM_WORLD, &requests_.emplace_back()),
            "send");
    }
    wait();
  }

  /// How many there are goes before them, with the first few.
  void broadcast(std::vector<double>& values) override {
    constexpr std::size_t few = 15;
    std::array<double, few + 1> head{static_cast<double>(values.size())};
    std::copy_n(values.begin(), std::min(values.size(), few), head.begin() + 1);
    spread({head.data(), head.size()});
    values.resize(static_cast<std::size_t>(head[0]));
    std::copy_n(head.begin() + 1, std::min(values.size(), few), values.begin());
    if (values.size() > few) spread(std::span(values).subspan(few));
  }

  std::vector<double> together(std::span<const double> mine) override {
    const int here = count_of(mine.size());
    std::vector<int> counts(static_cast<std::size_t>(size_)), first;
    count(1);
    request([&](MPI_Request* request) {
      return MPI_Iallgather(&here, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD, request);
    });
    std::size_t total = 0;
    for (const int one : counts) {
      first.push_back(count_of(total));
      total += static_cast<std::size_t>(one);
    }
    std::vector<double> all(total);
    count(mine.size());
    request([&](MPI_Request* request) {
      return MPI_Iallgatherv(mine.data(), here, MPI_DOUBLE, all.data(), counts.data(), first.data(),
                             MPI_DOUBLE, MPI_COMM_WORLD, request);
    });
    return all;
  }

  void largest_of_each(std::span<double> values) override {
    count(values.size());
    request([&](MPI_Request* request) {
      return MPI_Iallreduce(MPI_IN_PLACE, values.data(), count_of(values.size()), MPI_DOUBLE, MPI_MAX,
                            MPI_COMM_WORLD, request);
    });
  }

  /// Those who have come to the barrier may be gone before this rank sees that all have.
  void leave() override {
    while_waiting({});
    request([](MPI_Request* request) { return MPI_Ibarrier(MPI_COMM_WORLD, request); });
    const SignalsKept kept;
    MPI_Finalize();
  }

 private:
  static constexpr int tag = 1;
  int rank_ = 0, size_ = 1;
  std::vector<MPI_Request> requests_;

  void spread(std::span<double> values) {
    if (rank_ == 0) count(values.size());
    request([&](MPI_Request* request) {
      return MPI_Ibcast(values.data(), count_of(values.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD, request);
    });
  }

  template <class Begin>
  void request(const Begin& begin) {
    requests_.assign(1, MPI_REQUEST_NULL);
    check(begin(requests_.data()), "collective");
    wait();
  }

  using Clock = std::chrono::steady_clock;

  /// An eighth of what one has waited: a nap makes no wait much longer, though messages longer than MPI's buffers take several
  /// rounds, in which both sides must be awake.
  static Clock::duration nap_after(Clock::duration waited) {
    constexpr std::chrono::microseconds shortest{50}, longest{1000}, of_a_pause{10000};
    constexpr std::chrono::seconds pause{1};  // whoever waits for longer need not be quick
    return std::clamp<Clock::duration>(waited / 8, shortest, waited < pause ? longest : of_a_pause);
  }

  /// Until all requests are done. First it only looks, then it lets others run, then it sleeps.
  void wait() {
    constexpr std::chrono::microseconds looking{50}, yielding{500};
    constexpr std::chrono::milliseconds between{10};  // of what one does while waiting
    Clock::time_point begin{}, next{};
    bool first = true;
    for (int look = 0;; ++look) {
      int done = 0;
      check(MPI_Testall(static_cast<int>(requests_.size()), requests_.data(), &done, MPI_STATUSES_IGNORE),
            "wait");
      if (done != 0) return;
      const auto now = Clock::now();
      if (look == 0) begin = now, next = now + between;
      if (now - begin < looking) continue;
      if (now - begin < yielding) {
        std::this_thread::yield();
        continue;
      }
      std::this_thread::sleep_for(nap_after(now - begin));
      if (now < next) continue;
      next = now + between;
      look_around(first);
      first = false;
    }
  }
};

}  // namespace

}  // namespace fsi

extern "C" fsi::Ranks* fsi_open_ranks() {
  return new fsi::MpiRanks;  // NOLINT(cppcoreguidelines-owning-memory): its caller owns it
}
