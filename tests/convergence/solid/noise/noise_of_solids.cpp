// Growth of noise in a strained body over ten thousand steps, for all combinations of the three betas, cells
// of three shapes, three laws and states: `bin/noise_of_solids [steps]`. One line per law, state, shape
// and surroundings: the largest growth over all betas, and where it was.

#include <fmt/format.h>

#include <cstdlib>
#include <initializer_list>

#include "tests/convergence/solid/block_in_gas.hpp"
#include "tests/convergence/solid/noise_growth.hpp"

namespace {

using namespace fsi::solid;
using test::NoiseCase;

struct Worst {
  double growth = 0;
  NoiseCase at;
  int growing = 0, runs = 0;
};

/// @param growth_of of the noise of a case
template <class Growth>
Worst worst_of_betas(NoiseCase noise, std::initializer_list<double> relaxations, const Growth& growth_of) {
  Worst worst;
  for (const double P : {0.0, 0.1, 0.5, 1.0}) {
    for (const double u : {0.0, 0.1, 0.5, 1.0}) {
      for (const double r : relaxations) {
        noise.beta_P = P;
        noise.beta_u = u;
        noise.beta_r = r;
        const double growth = growth_of(noise);
        ++worst.runs;
        if (growth > 1.5) ++worst.growing;
        if (growth <= worst.growth) continue;
        worst.growth = growth;
        worst.at = noise;
      }
    }
  }
  return worst;
}

template <class L>
void print(const char* state, const NoiseCase& noise, const char* sides, const Worst& worst) {
  fmt::print("| {} | {} | 1:{:g} | {} | {} of {} | {:.2g} | {:g}, {:g}, {:g} |\n", L::name, state,
             noise.aspect, sides, worst.growing, worst.runs, worst.growth, worst.at.beta_P, worst.at.beta_u,
             worst.at.beta_r);
  std::fflush(stdout);
}

struct State {
  const char* name;
  Tensor2 F;
  double lambda = 1;
};

/// With relaxation, without which noise grows there. Dead loads are not for bodies under pressure: these would buckle.
template <class L, class Growth>
void campaign_under_pressure(const char* sides, std::initializer_list<State> states,
                             const Growth& growth_of) {
  for (const State& state : states) {
    for (const double aspect : {1.0, 4.0, 8.0}) {
      const NoiseCase noise = {.F = state.F, .lambda = state.lambda, .aspect = aspect};
      print<L>(state.name, noise, sides, worst_of_betas(noise, {0.2, 0.5, 0.9}, growth_of));
    }
  }
}

template <class L>
void campaign(int steps) {
  for (const State& state : {State{"at rest", {1, 0, 0, 1}}, State{"stretched by 1.3", {1.3, 0, 0, 1}},
                             State{"sheared by 0.4", {1, 0.4, 0, 1}}}) {
    for (const double aspect : {1.0, 4.0, 8.0}) {
      for (const bool free : {false, true}) {
        const NoiseCase noise = {.F = state.F, .aspect = aspect, .loaded = {false, free, free, free}};
        print<L>(state.name, noise, free ? "one held" : "held",
                 worst_of_betas(noise, {0.0, 0.2, 0.5, 0.9}, [steps](const NoiseCase& at) {
                   return test::growth_of_noise<L>(at, steps);
                 }));
      }
    }
  }
}

}  // namespace

int main(int count, char** words) {
  const int steps = count > 1 ? std::atoi(words[1]) : 10000;
  fmt::print(
      "| law | state | cells | sides | growing | largest growth | at beta_P, beta_u, beta_r "
      "|\n|---|---|---|---|---|---|---|\n");
  campaign<LinearElastic>(steps);
  campaign<SaintVenantKirchhoff>(steps);
  campaign<NeoHookean>(steps);
  const auto neo_hookean = [steps](const NoiseCase& at) {
    return test::growth_of_noise<NeoHookean>(at, steps);
  };
  campaign_under_pressure<SaintVenantKirchhoff>(
      "held", {{"pressed to 0.85", {0.85, 0, 0, 0.85}}},
      [steps](const NoiseCase& at) { return test::growth_of_noise<SaintVenantKirchhoff>(at, steps); });
  campaign_under_pressure<NeoHookean>("held",
                                      {{"pressed to 0.85", {0.85, 0, 0, 0.85}},
                                       {"pressed to 0.7", {0.7, 0, 0, 0.7}},
                                       {"pressed to 0.6 along x", {0.6, 0, 0, 1}},
                                       {"pressed to 0.85, lambda = 4 mu", {0.85, 0, 0, 0.85}, 4},
                                       {"pressed to 0.75, lambda = 4 mu", {0.75, 0, 0, 0.75}, 4},
                                       {"pressed to 0.95, lambda = 49 mu", {0.95, 0, 0, 0.95}, 49}},
                                      neo_hookean);
  campaign_under_pressure<NeoHookean>("in a gas",
                                      {{"at rest", {1, 0, 0, 1}},
                                       {"pressed to 0.85", {0.85, 0, 0, 0.85}},
                                       {"pressed to 0.75", {0.75, 0, 0, 0.75}},
                                       {"pressed to 0.9, lambda = 4 mu", {0.9, 0, 0, 0.9}, 4},
                                       {"pressed to 0.95, lambda = 9 mu", {0.95, 0, 0, 0.95}, 9}},
                                      [steps](const NoiseCase& at) {
                                        return test::growth_of_noise_in_gas<NeoHookean>(
                                            at, {.limiter = Limiter::mc}, steps);
                                      });
  return 0;
}
