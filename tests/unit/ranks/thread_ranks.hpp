#pragma once
/// Ranks that are threads of one process: what several ranks do, tested without MPI.

#include <algorithm>
#include <barrier>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "common/ranks/ranks.hpp"

namespace fsi::test {

/// What the threads share.
struct Meeting {
  explicit Meeting(int ranks) : size(ranks), all(ranks), slots(static_cast<std::size_t>(ranks)) {}
  int size;
  std::barrier<> all;
  std::vector<std::vector<double>> slots;
  std::mutex mutex;
  std::condition_variable arrived;
  std::map<std::pair<int, int>, std::deque<std::vector<double>>> mail;  ///< by sender and receiver
};

class ThreadRanks final : public Ranks {
 public:
  ThreadRanks(std::shared_ptr<Meeting> meeting, int rank) : meeting_(std::move(meeting)), rank_(rank) {}

  int rank() const override { return rank_; }
  int size() const override { return meeting_->size; }
  void exchange(std::span<const Parcel> sent, std::span<const Parcel> received) override {
    std::unique_lock lock(meeting_->mutex);
    for (const Parcel& parcel : sent)
      meeting_->mail[{rank_, parcel.rank}].emplace_back(parcel.values.begin(), parcel.values.end());
    meeting_->arrived.notify_all();
    for (const Parcel& parcel : received) {
      std::deque<std::vector<double>>& box = meeting_->mail[{parcel.rank, rank_}];
      meeting_->arrived.wait(lock, [&box] { return !box.empty(); });
      if (box.front().size() != parcel.values.size()) throw std::logic_error("a parcel of another size");
      std::ranges::copy(box.front(), parcel.values.begin());
      box.pop_front();
    }
  }
  void broadcast(std::vector<double>& values) override {
    meeting_->slots[static_cast<std::size_t>(rank_)] = values;
    meeting_->all.arrive_and_wait();
    values = meeting_->slots.front();
    meeting_->all.arrive_and_wait();
  }
  std::vector<double> together(std::span<const double> mine) override {
    meeting_->slots[static_cast<std::size_t>(rank_)].assign(mine.begin(), mine.end());
    meeting_->all.arrive_and_wait();
    std::vector<double> all;
    for (const std::vector<double>& one : meeting_->slots) all.insert(all.end(), one.begin(), one.end());
    meeting_->all.arrive_and_wait();
    return all;
  }
  void largest_of_each(std::span<double> values) override {
    const std::vector<double> all = together(values);
    for (std::size_t k = 0; k < all.size(); ++k) {
      double& value = values[k % values.size()];
      value = std::max(value, all[k]);
    }
  }
  void leave() override {}

 private:
  std::shared_ptr<Meeting> meeting_;
  int rank_;
};

/// Runs `body` on so many ranks; a failure of rank 0 goes on here.
inline void on_ranks(int size, const std::function<void(std::shared_ptr<Ranks>)>& body) {
  const auto meeting = std::make_shared<Meeting>(size);
  std::exception_ptr failure;
  {
    std::vector<std::jthread> threads;
    for (int rank = 0; rank < size; ++rank) {
      threads.emplace_back([&, rank] {
        try {
          body(std::make_shared<ThreadRanks>(meeting, rank));
        } catch (...) {
          if (rank == 0) failure = std::current_exception();
        }
      });
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace fsi::test
