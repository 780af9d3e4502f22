#pragma once
/// One interface through the whole run: takes the predicted states of gas and solid, projects them, remembers
/// what the substeps and the motion need.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/archive.hpp"
#include "common/interface/wave_curve.hpp"
#include "common/wire/messages.hpp"
#include "coupler/exchange/matching.hpp"
#include "coupler/exchange/modal_body.hpp"
#include "coupler/exchange/transfer.hpp"
#include "coupler/interface_motion.hpp"

namespace fsi::coupler {

/// What one step did to one interface: largest values over its points, before the projection.
struct InterfaceReport {
  std::string name;
  double velocity_jump = 0;   ///< |n.v_f - n.v_s|, clamped points left out [velocity]
  double traction_jump = 0;   ///< |w_s - (p_e - p) n|, zero for solids that have no traction [pressure]
  double shear = 0;           ///< |t.w_s|, zero in an inviscid gas [pressure]
  double gap = 0;             ///< |n.(x_gas - x_solid)| [length]
  double velocity_scale = 0;  ///< largest of the gas's speed of sound and its |n.v| [velocity]
  double traction_scale = 0;  ///< largest pressure of the gas [pressure]
  double p_max = 0;           ///< largest pressure on the solid, after the projection [pressure]
  double power = 0;  ///< of the gas on the solid, the integral of w_n v_n, after the projection [power/depth]
  std::size_t vacuum = 0;  ///< points the gas cannot follow
};

/// How the predicted states of both sides are put together.
struct Combination {
  Projection projection = Projection::simplified;
  bool wave_curve = true;  ///< with the whole wave curve of the gas; false: its tangent, paper eq. (19)
};

/// Where and when an exchange happens, for messages.
struct Moment {
  std::uint64_t step = 0;
  double t = 0;   ///< [time]
  double dt = 0;  ///< size of the step that led here, 0 at the first exchange [time]
};

class InterfaceExchange {
 public:
  /// @param robin_levels times t_k at which Robin data is kept, 1 to 3
  /// @throws PeerLost when the solid's reference normals are of no use
  /// @param path where the interface goes; empty: where the solid takes it
  InterfaceExchange(InterfacePair pair, Combination combination, int robin_levels, const Path& path = {});

  const InterfacePair& pair() const { return pair_; }
  std::size_t points() const { return curve_.n; }

  /// Takes in the predicted states, which have to live until they are projected. @throws Diverged naming
  /// step, t, program, interface, point and quantity
  void take(const Moment& moment, const wire::PredictedInterface& gas, const wire::PredictedInterface& solid);
  /// What the solid's degrees of freedom answer, and along which points the gas answers them; a deformable
  /// solid has no modes.
  const wire::ModalResponse& modal() const { return solid_->modal; }
  ModalSide modal_side() const { return {.N = N_, .gas = gas_, .ds = ds_}; }
  /// Projects what was taken in. @param q_dot of the solid's degrees of freedom; empty for a deformable one
  /// @throws Diverged as above
  void project_interface(const Moment& moment, const Eigen::VectorXd& q_dot);
  /// Everything about the state just projected, as both sides get it.
  void fill_state(wire::ProjectedInterface& answer) const;
  /// Robin data of the gas characteristic for the solid's substeps.
  void fill_robin(wire::ProjectedInterface& answer) const;
  /// Part of the first step that the gas proposes, from waves alone since its grid rests, in which no point of the
  /// interface goes further along its normal than waves would in all of it; 1 where none is faster than they.
  double share_of_first_step() const;
  /// Position commanded for a next step of size `dt`.
  void fill_motion(double dt, wire::ProjectedInterface& answer) const;
  /// What is above speaks of the points of the exchange; this gives a side that has others its own.
  void fit(wire::ProjectedInterface& to_fluid, wire::ProjectedInterface& to_solid) const;

  /// Velocities of the solid's degrees of freedom, as projected; empty for a deformable one.
  std::span<const double> q_dot() const { return {q_dot_.data(), static_cast<std::size_t>(q_dot_.size())}; }

  void archive(Archive& archive);

  const InterfaceReport& report() const { return report_; }
  /// Predicted and projected values along the interface, at most `most` points.
  wire::Telemetry::Interface profile(std::size_t most) const;

 private:
  struct Level {   ///< projected state at one time
    double t = 0;  ///< [time]
    std::vector<double> v_n, w_n;
  };

  void check_gas(const Moment& moment, const wire::PredictedInterface& gas) const;
  void check_solid(const Moment& moment, const wire::PredictedInterface& solid) const;
  void check_modes(const wire::PredictedInterface& solid) const;
  void check_sense(const Moment& moment) const;
  std::string why_broken() const;
  void prepare(const Moment& moment);
  void project_deformable(const Moment& moment, const wire::PredictedInterface& solid);
  void follow_solid();
  void project_modal();
  void remember(const Moment& moment, const wire::PredictedInterface& solid);
  void measure(const wire::PredictedInterface& gas, const wire::PredictedInterface& solid);

  InterfacePair pair_;
  Combination combination_;
  Curve curve_;
  std::optional<InterfaceTransfer> transfer_;  ///< where the two sides have different points
  InterfaceMotion motion_;
  std::optional<PrescribedMotion> prescribed_;
  Eigen::SparseMatrix<double> N_;  ///< mode vectors of such a solid, predicted
  Eigen::VectorXd q_dot_;          ///< of a solid with degrees of freedom, now
  const wire::PredictedInterface *predicted_gas_ = nullptr,
                                 *solid_ = nullptr;  ///< taken in, at the points of the exchange
  std::vector<Level> levels_;                        ///< newest first
  std::size_t known_ = 0;                            ///< levels that are filled
  std::vector<double> n_, ds_, v_, a_, z_f_, x_solid_, x_gas_;
  std::vector<GasSide> gas_;       ///< predicted gas
  std::vector<double> solid_v_n_;  ///< predicted normal velocity of the solid
  std::vector<double> solid_w_n_;  ///< predicted normal traction of the solid; empty for one without traction
  std::vector<double> solid_w_t_;  ///< its tangential traction, along the normal turned to the left
  double p_e_ = 0;                 ///< [pressure]
  InterfaceReport report_;
};

}  // namespace fsi::coupler
