#include "monitor/web/guards.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

namespace fsi::monitor {

namespace {

/// Bytes in the body of a request; all that is asked stands in its address.
constexpr unsigned long long largest_body = 1024;

bool is_port(std::string_view text) {
  return text.empty() ||
         (text.front() == ':' && text.find_first_not_of("0123456789", 1) == std::string_view::npos);
}

}  // namespace

std::string host_of(const std::string& header) {
  const bool bracketed = header.starts_with("[");
  const std::size_t end = std::min(header.find(bracketed ? ']' : ':'), header.size());
  const std::size_t rest = std::min(end + (bracketed ? 1 : 0), header.size());
  const bool open = bracketed && end == header.size();
  if (open || !is_port(std::string_view(header).substr(rest))) return "";
  return bracketed ? header.substr(1, end - 1) : header.substr(0, end);
}

bool is_loopback(const std::string& host) {
  in_addr v4{};
  if (inet_pton(AF_INET, host.c_str(), &v4) == 1) return (ntohl(v4.s_addr) >> 24) == 127;
  in6_addr v6{};
  if (inet_pton(AF_INET6, host.c_str(), &v6) == 1) return std::memcmp(&v6, &in6addr_loopback, sizeof v6) == 0;
  return host == "localhost";
}

bool has_large_body(const httplib::Request& request) {
  if (request.has_header("Transfer-Encoding")) return true;  // of a size nobody knows
  if (!request.has_header("Content-Length")) return false;
  return std::strtoull(request.get_header_value("Content-Length").c_str(), nullptr, 10) > largest_body;
}

void ConnectionThreads::add(std::function<void()> connection) {
  {
    const std::scoped_lock lock(mutex_);
    waiting_.push_back(std::move(connection));
    if (waiting_.size() > idle_ && threads_.size() < most_threads_) threads_.emplace_back([this] { work(); });
  }
  changed_.notify_one();
}

void ConnectionThreads::work() {
  for (;;) {
    std::function<void()> connection;
    {
      std::unique_lock lock(mutex_);
      ++idle_;
      changed_.wait(lock, [this] { return !waiting_.empty() || ending_; });
      --idle_;
      if (waiting_.empty()) return;
      connection = std::move(waiting_.front());
      waiting_.pop_front();
    }
    connection();
  }
}

void ConnectionThreads::shutdown() {
  {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

}  // namespace fsi::monitor
