#pragma once
/// What a case gives as functions of place and time, by formulas or by its reference solution.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/case/case.hpp"
#include "common/case/check/given/sample.hpp"
#include "common/core/input/config.hpp"
#include "common/core/types.hpp"
#include "common/exact/solution.hpp"

namespace fsi {

/// A vector at a place and a time.
using GivenVector = std::function<Vec2(const Vec2& x, double t)>;
/// The same of a state of the gas.
using GivenGas = std::function<exact::GasState(const Vec2& x, double t)>;

/// At so many times from the start to the end a case's data are looked at, after the start a little before round ones: a
/// step does not come upon those by chance, where sin(t - 1) / (t - 1) has no value.
inline constexpr int looked_at_times = 17;
/// The k-th of them.
inline double looked_at_time(const Case& problem, int k) {
  return problem.time.end * k / (looked_at_times - 1) * (1 - 1e-6);
}

/// At how many of them the places of a gas's side are known: where a solid moves its ends, at the start alone.
int times_of_known_places(const FluidSpec& fluid, Side side);

/// At how many of them what is given there can be looked at: everywhere the same, it needs no places.
int times_of_known_values(const FluidSpec& fluid, Side side, const GasExpressions& given);

/// What holds on a curve fitted to a gas, with the place where the case speaks of it.
struct GivenOnCurve {
  const BoundarySpec& spec;
  const config::Node& node;
  std::string path;          ///< "fluid.body_fitted[0].boundary"
  std::vector<Vec2> points;  ///< of the curve, which lies still; those behind other curves left out
};

/// Of all curves of a gas that have data. @param node the section of the gas
std::vector<GivenOnCurve> given_on_curves(const FluidSpec& fluid, const config::Node& node);

/// Of formulas.
GivenVector given_by(const VectorExpressions& formulas);

/// The solution that the kind of `reference` and its numbers stand for; nullptr where it is given by formulas, computed by
/// a program of its own, or not there. @throws UserMistake where the numbers have no solution
std::shared_ptr<const exact::Solution> exact_reference(const ReferenceSpec& reference);

/// State of a gas by the reference solution; empty where a case has none before it runs.
GivenGas reference_gas(const ReferenceSpec& reference);
/// Displacement of a solid by the reference solution; empty where a case has none before it runs.
GivenVector reference_displacement(const ReferenceSpec& reference);

/// Displacement of a solid at the start.
GivenVector initial_displacement(const Case& problem, const SolidSpec& solid);

/// det F > 0, and a stress of the law. Returns what is wrong with a deformation gradient, or "".
std::string unbearable(const SolidSpec& solid, const Mat2& F);

/// The deformation gradient that a grid sees in a cell displaced by u(x, t).
Mat2 deformation_gradient(const BodyCell& cell, const GivenVector& u, double t);

}  // namespace fsi
