#pragma once
/// The latest pictures of a run, for the browsers that look at them, and what these wish to see.

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>
#include <vector>

#include "common/wire/messages.hpp"

namespace fsi::monitor {

/// Pictures one after the other, and how new the newest is. Each is the length of its header (4 bytes, little
/// endian), the header (JSON: from, role, quantity, step, t, low, high, grids: [{name, n1, n2, straight}]),
/// and for each grid its positions (32-bit floats), its levels
/// (16 bit); header and levels filled to whole 4 bytes.
struct Hanging {
  std::uint64_t version = 0;
  std::string bytes;
};

/// Used by the connections' threads and the one that listens to the run.
class Gallery {
 public:
  /// In place of the last one of the same program and quantity.
  void hang(const wire::Picture& picture);
  /// Beside all others: one of a moment that is past, from a file. Up to some hundred MB of them.
  void keep(const wire::Picture& picture);
  /// Notes the wishes; returns the pictures for them (and outlines) that are newer than `after`, as soon as
  /// there is one, nothing after `patience`.
  Hanging wait(std::uint64_t after, const std::vector<std::string>& wishes,
               std::chrono::milliseconds patience);
  /// What has been wished for lately.
  std::vector<std::string> wishes();
  /// Nobody needs to wait any more.
  void close();

 private:
  using Clock = std::chrono::steady_clock;
  struct Frame {
    std::uint64_t version = 0;
    std::string role;
    std::shared_ptr<const std::string> bytes;
  };

  /// By program and quantity; of a past moment by its step too, else the largest number.
  using Place = std::tuple<std::string, std::string, std::uint64_t>;

  void put(const Place& place, const wire::Picture& picture);
  Hanging newer(std::uint64_t after, const std::vector<std::string>& wishes) const;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<Place, Frame> frames_;
  std::size_t live_ = 0, kept_bytes_ = 0;  ///< frames that are replaced; size of the others [byte]
  std::map<std::string, Clock::time_point> wishes_;
  std::uint64_t version_ = 0;
  bool closed_ = false;
};

}  // namespace fsi::monitor
