#pragma once
/// What the one-dimensional references share: the solid and its law, steps in time,
/// values at masses from springs, differences of two runs.

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "common/core/failure.hpp"
#include "common/exact/table.hpp"
#include "solid_solver/laws/every_law.hpp"

namespace fsi::reference {

using AnyLaw = solid::EveryLaw;

/// What the solid is made of.
struct Material {
  std::string law = {};
  double rho_bar = 1, lambda = 1, mu = 1;  ///< [mass/volume], [pressure], [pressure]
  std::map<std::string, double> own = {};  ///< numbers of the law besides lambda and mu
};

/// @throws UserMistake for an unknown law
AnyLaw law_of(const Material& material);

/// Largest errors of the fields, or differences between two solutions.
struct Difference {
  double rho = 0, v = 0, p = 0;            ///< of the gas [density], [velocity], [pressure]
  double u_bar = 0, v_bar = 0, P_bar = 0;  ///< of the solid [length], [velocity], [pressure]
};

/// Their members, to go through all.
inline constexpr double Difference::*differences[] = {&Difference::rho,   &Difference::v,
                                                      &Difference::p,     &Difference::u_bar,
                                                      &Difference::v_bar, &Difference::P_bar};

/// A second-order scheme with half the points is four times
/// as wrong, so the difference of the two is three times the error.
Difference error_from(Difference difference);

/// A solution as far as it goes.
template <class Output>
struct Run {
  std::vector<Output> outputs;  ///< before a spring folded
  std::string broke;            ///< where and when one did; empty where none did
};

/// Runs a chain, made by `make()`, to each time; a spring that folds ends the solution only.
template <class Make>
auto run_while_sound(const std::vector<double>& times, const Make& make) {
  Run<decltype(make().output())> run;
  try {
    auto chain = make();
    for (const double t : times) {
      chain.run_to(t);
      run.outputs.push_back(chain.output());
    }
  } catch (const Diverged& broke) {
    run.broke = broke.what();
  }
  return run;
}

/// The same of `Chain` with the law that the problem names.
template <template <solid::Law> class Chain, class Problem>
auto run_with_law(const Problem& problem, int points) {
  return std::visit(
      [&]<class L>(const L& law) {
        return run_while_sound(problem.times, [&] { return Chain<L>(problem, law, points); });
      },
      law_of(problem.material));
}

/// Goes on from `t` to `end` by equal steps no longer than 0.9 of `stable_step()`, which is measured again
/// after some of them. `step(dt)` is one of leapfrog in its kick-drift-kick form, which may change its length at any time.
template <class StableStep, class Step>
void leapfrog(double& t, double end, const StableStep& stable_step, const Step& step) {
  constexpr double safety = 0.9;
  constexpr int block = 32;
  while (t < end) {
    const double left = end - t;
    const double steps = std::ceil(left / (safety * stable_step()));
    const int now = static_cast<int>(std::min<double>(block, steps));
    for (int k = 0; k < now; ++k) step(left / steps);
    if (now == static_cast<int>(steps)) t = end;
  }
}

/// All outputs of a run. @throws Diverged where one was not reached
template <class Output>
std::vector<Output> whole(Run<Output> run) {
  if (!run.broke.empty()) throw Diverged(run.broke);
  return std::move(run.outputs);
}

/// What the springs do before the first one.
enum class Start { end, mirror };

/// Values at the n + 1 ends of n >= 4 equal springs from those in their middles: cubic inside, quadratic at
/// the ends. `mirror`: the values are even about the first end.
std::vector<double> at_masses(std::span<const double> middle, Start start = Start::end);

/// `times`, t = 0 and t = `end`, increasing and each once.
std::vector<double> output_times(std::vector<double> times, double end);

/// Largest difference of the values `a` at the places `x` from a column of a finer run's table, read only
/// where the table reaches.
double largest_difference(std::span<const double> a, std::span<const double> x,
                          const exact::CubicTable& table, std::size_t column);

}  // namespace fsi::reference
