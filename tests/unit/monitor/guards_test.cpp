/// What the page's server lets in.

#include "monitor/web/guards.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <string>

namespace fsi::monitor {
namespace {

TEST(Guards, OnlyAddressesOfThisMachineAreLoopback) {
  for (const char* host : {"localhost", "127.0.0.1", "127.1.2.3", "::1", "0:0:0:0:0:0:0:1"})
    EXPECT_TRUE(is_loopback(host)) << host;
  for (const char* host : {"127.evil.example", "127.0.0.1.evil.example", "127.", "127.0.0", "127.0.0.256",
                           "128.0.0.1", "::2", "localhost.evil.example", ""})
    EXPECT_FALSE(is_loopback(host)) << host;
}

TEST(Guards, HostIsTheNameBeforeThePort) {
  EXPECT_EQ(host_of("127.0.0.1:8080"), "127.0.0.1");
  EXPECT_EQ(host_of("localhost"), "localhost");
  EXPECT_EQ(host_of("[::1]:80"), "::1");
  EXPECT_EQ(host_of("[::1]"), "::1");
  for (const char* header : {"", "[::1].evil.example", "[::1", "127.0.0.1:80.evil.example", "a:b"})
    EXPECT_FALSE(is_loopback(host_of(header))) << header;
}

/// The first connections hold their threads until the last one was served.
TEST(Guards, SilentConnectionsKeepNobodyWaiting) {
  constexpr int silent = 200;
  ConnectionThreads threads(silent + 1);
  std::latch last_served(1);
  std::atomic<int> ended = 0;
  for (int k = 0; k < silent; ++k) {
    threads.enqueue([&] {
      last_served.wait();
      ++ended;
    });
  }
  threads.enqueue([&] { last_served.count_down(); });
  threads.shutdown();
  EXPECT_EQ(ended, silent);
}

TEST(Guards, AsFewThreadsAsSufficeServeAll) {
  ConnectionThreads threads(3);
  std::atomic<int> served = 0;
  for (int k = 0; k < 1000; ++k) threads.enqueue([&] { ++served; });
  threads.shutdown();
  EXPECT_EQ(served, 1000);
}

}  // namespace
}  // namespace fsi::monitor
