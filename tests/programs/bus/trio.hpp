#pragma once
/// Gas, solid and coupler of one run that compute nothing, each a process.

#include <cstdint>
#include <string>
#include <vector>

#include "tests/programs/bus/processes.hpp"
#include "tests/unit/bus/seats.hpp"

namespace fsi::bus::test {

inline constexpr std::uint64_t endless = ~std::uint64_t{0};

/// Of a run that is protected as runs are by default.
inline BusOptions protected_options(const std::string& run) {
  BusOptions result = options(run);
  result.key = test_key;
  return result;
}

/// A solver that answers at once, until it is told to stop. Says "begun" after its first step.
inline void solve(const BusOptions& options, const wire::Hello& self, std::uint64_t steps, std::size_t points,
                  const Process::Say& say) {
  SolverSession session(options, self);
  wire::PredictedInterface state = predicted(0, points);
  for (std::uint64_t step = 0; step < steps; ++step) {
    state.step = step;
    state.v.front() = state.v.back() = static_cast<double>(step);
    session.publish(state);
    const auto& answer = session.receive("beam", step);
    EXPECT_EQ(answer.v_n.size(), points);
    EXPECT_EQ(answer.v_n.back(), -static_cast<double>(step));
    if (step == 0) say("begun");
    if (session.telemetry_due()) session.publish(wire::Telemetry{});
    if (answer.stop) break;
  }
}

/// `shared`: tells how far the run is, and may end it.
inline void couple(const BusOptions& options, const Shared& shared, std::uint64_t steps, std::size_t points,
                   const Process::Say& say) {
  CouplerSession session(options, gas_and_solid(), "one case");
  std::vector<wire::ProjectedInterface> answers = {projected("fluid", 0, points),
                                                   projected("beam", 0, points)};
  try {
    bool end = false;
    for (std::uint64_t step = 0; step < steps && !end; ++step) {
      for (const wire::PredictedInterface& state : session.gather(step)) {
        EXPECT_EQ(state.v.size(), 2 * points);
        EXPECT_EQ(state.v.back(), static_cast<double>(step));
      }
      end = shared.end();
      for (wire::ProjectedInterface& answer : answers) {
        answer.step = step;
        answer.stop = end;
        answer.v_n.back() = -static_cast<double>(step);
      }
      session.scatter(answers);
      shared.step() = step + 1;
      if (step == 0) say("begun");
    }
  } catch (const Failure& failure) {
    session.abort(failure);
    throw;
  }
}

/// Gas, solid and coupler of one run, each a process.
struct Trio {
  explicit Trio(const BusOptions& options, std::uint64_t steps = endless, std::size_t points = 3)
      : fluid([=](const auto& say) { solve(options, gas(points), steps, points, say); }),
        beam([=](const auto& say) { solve(options, solid(points), steps, points, say); }),
        coupler([=, this](const auto& say) { couple(options, shared, steps, points, say); }) {}

  void wait_until_begun() {
    for (Process* process : {&fluid, &beam, &coupler}) ASSERT_EQ(process->hear(), "begun");
  }

  /// Goes on for so many steps, then ends well.
  void end_after(std::uint64_t steps) {
    EXPECT_TRUE(shared.go_on_for(steps));
    shared.end() = true;
    for (Process* process : {&fluid, &beam, &coupler}) EXPECT_EQ(process->end(), 0) << process->hear();
  }

  Shared shared;
  Process fluid, beam, coupler;
};

}  // namespace fsi::bus::test
