#pragma once
/// What the page's server lets in: names of this machine only, requests without a body, and connections that
/// say nothing do not keep others waiting.

#include <httplib.h>

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace fsi::monitor {

/// The name in "name:port" or "[address]:port"; empty where it is neither.
std::string host_of(const std::string& header);

/// True for "localhost" and for addresses of the loopback interface: 127.0.0.0/8 and ::1. A name that only
/// begins like one is somebody else's.
bool is_loopback(const std::string& host);

/// True where a request carries more than any request to this server needs.
bool has_large_body(const httplib::Request& request);

/// One thread for each connection that is open, started when there is no idle one, so that connections that
/// are slow or silent keep only themselves waiting. Beyond `most_threads` they queue.
class ConnectionThreads final : public httplib::TaskQueue {
 public:
  explicit ConnectionThreads(std::size_t most_threads) : most_threads_(most_threads) {}
  ConnectionThreads(const ConnectionThreads&) = delete;
  ConnectionThreads& operator=(const ConnectionThreads&) = delete;
  ConnectionThreads(ConnectionThreads&&) = delete;
  ConnectionThreads& operator=(ConnectionThreads&&) = delete;
  ~ConnectionThreads() override = default;

  /// `void` in some releases of cpp-httplib, `bool` (taken) in later ones.
  using Taken = decltype(std::declval<httplib::TaskQueue&>().enqueue(std::function<void()>()));
  Taken enqueue(std::function<void()> connection) override {
    add(std::move(connection));
    return static_cast<Taken>(true);
  }
  /// Waits for those that are being served.
  void shutdown() override;

 private:
  void add(std::function<void()> connection);
  void work();

  std::size_t most_threads_, idle_ = 0;
  std::vector<std::thread> threads_;
  std::list<std::function<void()>> waiting_;
  bool ending_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace fsi::monitor
