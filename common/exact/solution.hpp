#pragma once
/// A known solution of a coupled problem: initial data, boundary data and the yardstick of the errors.

#include <map>
#include <memory>
#include <string>

#include "common/core/choices.hpp"
#include "common/exact/state.hpp"

namespace fsi::exact {

/// One more exact solution is one class derived from this, one line in make_solution and two for its name in
/// common/core/choices.hpp.
class Solution {
 public:
  Solution() = default;
  Solution(const Solution&) = default;
  Solution(Solution&&) = default;
  Solution& operator=(const Solution&) = default;
  Solution& operator=(Solution&&) = default;
  virtual ~Solution() = default;

  /// State of the gas at the point (x, y) of space.
  virtual GasState gas(double x, double y, double t) const = 0;
  /// State of the solid at the reference point (x_bar, y_bar).
  virtual SolidState solid(double x_bar, double y_bar, double t) const = 0;
  /// Why nothing is known at time t, for a solution that ends before; empty where something is.
  virtual std::string missing_at(double /*t*/) const { return ""; }
  /// True where the solution is only known at output times, so that it cannot give boundary data.
  virtual bool only_at_output_times() const { return false; }
};

/// Solution of a kind with the data `numbers` of a case's `reference` section; a tabulated one
/// (`piston_1d`, `rotating_disk`) is read from `run_dir`/reference.h5.
/// @throws UserMistake naming an unknown number, or a kind that is none of a named solution @throws OutputFailed when the table cannot be read
std::unique_ptr<Solution> make_solution(ReferenceKind kind, const std::map<std::string, double>& numbers,
                                        const std::string& run_dir);

}  // namespace fsi::exact
