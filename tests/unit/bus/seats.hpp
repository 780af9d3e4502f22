#pragma once
/// Little programs for the tests of the bus: a gas and a solid that meet at one interface, each in a thread.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <future>
#include <string>
#include <utility>

#include "common/bus/sessions/coupler_session.hpp"
#include "common/bus/sessions/solver_session.hpp"

namespace fsi::bus::test {

/// A run of its own for every test and process.
inline std::string own_run() {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  return fmt::format("{}.{}.{}", info->test_suite_name(), info->name(), getpid());
}

/// Of a run in the tests that is protected, as runs are by default.
/// Within one process there is nothing to protect.
inline constexpr const char* test_key = "sign:0123456789abcdef0123456789abcdef";

inline BusOptions options(const std::string& run) {
  return {.run = run, .peer_timeout_s = 4, .hello_timeout_s = 20, .step_timeout_s = 60};
}

/// A solver at the interface "beam" of `points` points in two dimensions.
inline wire::Hello hello(const std::string& role, const std::string& name, std::size_t points = 3) {
  wire::Hello result;
  result.role = role;
  result.name = name;
  result.config_digest = "one case";
  result.points = points;
  result.interfaces = {{.name = "beam", .dimension = 2, .x = std::vector<double>(2 * points, 0.5), .n = {}}};
  return result;
}
inline wire::Hello gas(std::size_t points = 3) {
  return hello("fluid", "fluid", points);
}
inline wire::Hello solid(std::size_t points = 3) {
  return hello("solid", "beam", points);
}
inline std::vector<Expected> gas_and_solid() {
  return {{.role = "fluid", .name = "fluid"}, {.role = "solid", .name = "beam"}};
}

inline wire::PredictedInterface predicted(std::uint64_t step, std::size_t points = 3) {
  wire::PredictedInterface state;
  state.interface = "beam";
  state.step = step;
  state.v.assign(2 * points, static_cast<double>(step));
  return state;
}
inline wire::ProjectedInterface projected(const std::string& to, std::uint64_t step, std::size_t points = 3) {
  wire::ProjectedInterface state;
  state.to = to;
  state.interface = "beam";
  state.step = step;
  state.v_n.assign(points, -static_cast<double>(step));
  return state;
}

/// How a program ended.
struct End {
  ExitCode code = ExitCode::done;
  std::string reason;
  Place place = {};
  std::string origin = {};
};

/// A program that runs in a thread.
class InThread {
 public:
  explicit InThread(std::future<End> end) : end_(std::move(end)) {}

  /// Waits as programs do, which wake up to look around: the others take the first thread of this process for it, and one
  /// that sleeps for `peer_timeout` for one that hangs.
  End get() {
    while (end_.wait_for(std::chrono::milliseconds(100)) != std::future_status::ready) continue;
    return end_.get();
  }

 private:
  std::future<End> end_;
};

/// Runs a program's body in a thread; a Failure becomes its end.
template <class Body>
InThread in_thread(Body body) {
  return InThread(std::async(std::launch::async, [body = std::move(body)]() -> End {
    try {
      body();
      return {};
    } catch (const Failure& failure) {
      return {failure.code(), failure.what(), failure.place(), failure.origin()};
    }
  }));
}

/// True when `text` holds `part`.
inline bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace fsi::bus::test
