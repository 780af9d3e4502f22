#pragma once
/// The method of analytic solutions: source terms that make a chosen state of the gas an exact solution,
/// such as paper eq. (47).
///
/// Half of a step's source is added before the sweep, where the grid was, and half after it, where the grid
/// is. So the predictor sees it, a control volume carries what it took in at either end of its way, and the
/// kernels know nothing of it.

#include <utility>

#include "common/core/field.hpp"
#include "common/ranks/rows/rank_rows.hpp"
#include "fluid_solver/gas_options.hpp"
#include "fluid_solver/state_vector.hpp"

namespace fsi::fluid {

class Forcing {
 public:
  /// Distances in space and time over which the exact state changes by much.
  struct Scales {
    double length = 1;  ///< [length]
    double time = 1;    ///< [time]
  };

  /// `exact` must be smooth, also a little outside the domain: at ghost points.
  Forcing(StateField exact, double gamma, const Scales& scales)
      : exact_(std::move(exact)), gamma_(gamma), scales_(scales) {}

  const StateField& exact() const { return exact_; }
  /// dq/dt + df_j/dx_j of the exact state, q = (rho, rho v1, rho v2, rho E). paper eq. (1)
  StateVector source(double x, double y, double t) const;
  /// The same at all points and ghost points x, in the rows one has.
  void evaluate(ConstFieldView x, double t, FieldView source, const RankRows& rows) const;
  /// q := q + weight * source in conserved variables; q holds rho, v1, v2, p. In the rows one has.
  void add(ConstFieldView source, double weight, FieldView q, const RankRows& rows) const;

 private:
  StateField exact_;
  double gamma_;
  Scales scales_;
};

}  // namespace fsi::fluid
