#pragma once
/// An interface whose two sides have different points. The exchange happens at the points of the finer side:
/// the predicted state of the coarser one is brought there, and the projected state is handed back to it.
///
///     finer side     o--o--o--o--o--o--o--o--o      projection
///                    |  bring |     | give |        cubic; impedances linear
///     coarser side   O-----------O-----------O
///
/// The traction that a solid gets, as a function along the curve, acts with exactly the same force as at the finer points. A
/// gas gets what changes its own traction, interpolated: it takes it over as its pressure and keeps it, and what its points
/// cannot show would be added to this pressure once more in every step.

#include <Eigen/SparseCore>
#include <cstddef>
#include <span>
#include <vector>

#include "common/core/types.hpp"
#include "common/wire/messages.hpp"
#include "coupler/exchange/curve_interpolation.hpp"
#include "coupler/interface_motion.hpp"

namespace fsi::coupler {

class InterfaceTransfer {
 public:
  /// @param curve of the coarser side  @param coarse its points at t = 0, 2 n  @param fine points of the
  /// other side, 2 m  @param to_gas the coarser side is the gas
  InterfaceTransfer(const Curve& curve, std::span<const double> coarse, std::span<const double> fine,
                    bool to_gas);

  std::size_t coarse_points() const { return curve_.n; }

  /// Whether the ends slide along walls: the first and the last of the finer points.
  void let_ends_slide(bool first, bool last) {
    curve_.first.slides = opposite_ ? last : first;
    curve_.last.slides = opposite_ ? first : last;
  }

  /// The predicted state of the coarser side at the finer points. Holds until the next call.
  const wire::PredictedInterface& bring(const wire::PredictedInterface& coarse);

  /// Leaves of values at the finer points what the coarser ones can show.
  void resolve(std::span<double> fine) const;

  /// Turns an answer at the finer points into one for the coarser side.
  /// @param x positions of the finer points to which n and w_n of the answer belong
  void give(std::span<const double> x, wire::ProjectedInterface& answer) const;

 private:
  void bring_modes(const wire::ModalResponse& coarse);
  std::vector<double> at_coarse(std::span<const double> fine) const;
  std::vector<double> gas_traction(std::span<const double> fine) const;
  /// @param x, fine as for `give`
  std::vector<double> solid_traction(std::span<const double> x, const wire::ProjectedInterface& fine) const;
  void give_robin(wire::ProjectedInterface& answer) const;

  Curve curve_;  ///< of the coarser side
  bool to_gas_;
  CurveInterpolation to_fine_, to_coarse_;
  Eigen::SparseMatrix<double> modes_to_fine_;
  std::vector<double> x_0_, x_0_fine_;  ///< positions at t = 0
  bool opposite_;                       ///< the first of the finer points is at the curve's last one
  std::vector<double> x_, v_, p_;       ///< coarser side, predicted
  wire::PredictedInterface brought_;
};

}  // namespace fsi::coupler
