/// Round trip of one coupled step over the bus: gas, solid
/// and coupler as three processes that compute nothing.
///
/// Reports per number of interface points: time from the gas's `publish` to its answer (mean; p50_us and
/// p99_us) and the sizes of the largest messages. The aim is 1.3 times what bare Cyclone DDS takes for
/// messages of that size.

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/bus/sessions/coupler_session.hpp"
#include "common/bus/sessions/solver_session.hpp"

namespace {

using namespace fsi;

struct Size {
  std::size_t points;
  std::int64_t steps;
};
constexpr std::array sizes = {Size{.points = 100, .steps = 3000}, Size{.points = 1000, .steps = 2000},
                              Size{.points = 10000, .steps = 500}};
/// How the bus is protected: one after the other for each size, so that they can be compared.
constexpr std::array protections = {"off", "sign", "encrypt"};

/// One measurement.
struct Trial {
  Size size;
  std::string protection;
};
Trial trial(std::size_t number) {
  return {.size = sizes.at(number / protections.size()),
          .protection = protections.at(number % protections.size())};
}
constexpr std::size_t trials = sizes.size() * protections.size();
constexpr int settling_steps = 20;  ///< memory grows, sockets warm up: not counted

/// `run` is PROTECTION.ANYTHING.
bus::BusOptions options(const std::string& run) {
  bus::BusOptions result;
  result.run = run;
  if (!run.starts_with("off")) result.key = run.substr(0, run.find('.')) + ":" + run;
  result.hello_timeout_s = 60;
  return result;
}

wire::Hello hello(const std::string& role, const std::string& name, std::size_t points) {
  wire::Hello result;
  result.role = role;
  result.name = name;
  result.interfaces = {{.name = "solid", .dimension = 2, .x = std::vector<double>(2 * points), .n = {}}};
  return result;
}

wire::PredictedInterface gas_state(std::size_t points) {
  wire::PredictedInterface state;
  state.interface = "solid";
  state.x = state.v = std::vector<double>(2 * points);
  state.p = state.z_f = state.rho = state.gamma = std::vector<double>(points);
  return state;
}

wire::PredictedInterface solid_state(std::size_t points) {
  wire::PredictedInterface state;
  state.interface = "solid";
  state.x = state.v = state.w = std::vector<double>(2 * points);
  state.Z = std::vector<double>(3 * points);
  return state;
}

wire::ProjectedInterface answer(const std::string& to, std::size_t points) {
  wire::ProjectedInterface state;
  state.to = to;
  state.interface = "solid";
  state.n = std::vector<double>(2 * points);
  state.v_n = state.w_n = std::vector<double>(points);
  return state;
}

wire::ProjectedInterface answer_to_gas(std::size_t points) {
  wire::ProjectedInterface state = answer("fluid", points);
  state.v = state.a = state.x_next = std::vector<double>(2 * points);
  return state;
}

wire::ProjectedInterface answer_to_solid(std::size_t points) {
  wire::ProjectedInterface state = answer("solid", points);
  state.z_f = std::vector<double>(points);
  return state;
}

void play_coupler(const std::string& run, std::size_t points) {
  bus::CouplerSession session(options(run),
                              {{.role = "fluid", .name = "fluid"}, {.role = "solid", .name = "solid"}}, "");
  std::vector<wire::ProjectedInterface> answers = {answer_to_gas(points), answer_to_solid(points)};
  for (std::uint64_t step = 0;; ++step) {
    const bool stop = session.gather(step)[0].p_e < 0;  // the gas says when it is the last step
    for (wire::ProjectedInterface& answer : answers) {
      answer.step = step;
      answer.stop = stop;
    }
    session.scatter(answers);
    if (stop) return;
  }
}

void play_solid(const std::string& run, std::size_t points) {
  bus::SolverSession session(options(run), hello("solid", "solid", points));
  wire::PredictedInterface state = solid_state(points);
  for (bool stop = false; !stop; ++state.step) {
    session.publish(state);
    stop = session.receive("solid", state.step).stop;
  }
}

/// A process that plays its part of every size once it is told to; forked before this process joins the bus.
class Player {
 public:
  explicit Player(const std::function<void(const Trial&)>& play) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
    pid_ = fork();
    if (pid_ == 0) {
      close(ends[1]);
      std::uint8_t number = 0;
      while (read(ends[0], &number, 1) == 1) play(trial(number));
      _exit(0);
    }
    close(ends[0]);
    go_ = ends[1];
  }
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;
  Player(Player&&) = delete;
  Player& operator=(Player&&) = delete;
  ~Player() {
    close(go_);
    waitpid(pid_, nullptr, 0);
  }
  void go(std::uint8_t number) const {
    if (write(go_, &number, 1) != 1) throw std::runtime_error("a player is gone");
  }

 private:
  pid_t pid_ = 0;
  int go_ = -1;
};

double quantile_us(std::vector<double>& seconds, double fraction) {
  const auto rank = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(seconds.size() - 1));
  std::nth_element(seconds.begin(), seconds.begin() + rank, seconds.end());
  return 1e6 * seconds[static_cast<std::size_t>(rank)];
}

double step(bus::SolverSession& session, wire::PredictedInterface& state) {
  const auto start = std::chrono::steady_clock::now();
  session.publish(state);
  session.receive("solid", state.step++);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void round_trip(benchmark::State& bench, const std::string& run, std::size_t points) {
  const auto start = std::chrono::steady_clock::now();
  bus::SolverSession session(options(run), hello("fluid", "fluid", points));
  const std::chrono::duration<double, std::milli> joining = std::chrono::steady_clock::now() - start;
  wire::PredictedInterface state = gas_state(points);
  for (int k = 0; k < settling_steps; ++k) step(session, state);
  std::vector<double> seconds;
  for ([[maybe_unused]] auto iteration : bench) {
    seconds.push_back(step(session, state));
    bench.SetIterationTime(seconds.back());
  }
  state.p_e = -1;
  step(session, state);
  bench.counters["joining_ms"] = joining.count();
  bench.counters["p50_us"] = quantile_us(seconds, 0.5);
  bench.counters["p99_us"] = quantile_us(seconds, 0.99);
  bench.counters["predicted_KB"] = 9.0 * 8.0 * static_cast<double>(points) / 1000;   // of the solid
  bench.counters["projected_KB"] = 10.0 * 8.0 * static_cast<double>(points) / 1000;  // to the gas
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const auto run_for = [owner = getpid()](const Trial& trial) {
    return fmt::format("{}.{}.{}", trial.protection, trial.size.points, owner);
  };
  const Player coupler([&](const Trial& trial) { play_coupler(run_for(trial), trial.size.points); });
  const Player solid([&](const Trial& trial) { play_solid(run_for(trial), trial.size.points); });
  for (std::size_t number = 0; number < trials; ++number) {
    const Trial one = trial(number);
    benchmark::RegisterBenchmark(
        fmt::format("bus_round_trip/points:{}/protection:{}", one.size.points, one.protection).c_str(),
        [&, number, one](benchmark::State& bench) {
          coupler.go(static_cast<std::uint8_t>(number));
          solid.go(static_cast<std::uint8_t>(number));
          round_trip(bench, run_for(one), one.size.points);
        })
        ->Iterations(one.size.steps)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
