#pragma once
/// The middle of Procedure 1: from the predicted states of all programs to the projected states, the next
/// time step and the commanded motion. Knows no bus, no gas law, no solid law and no grid.
///
///     Coupler coupler(options, hellos);
///     for k = 0, 1, ...:  answers = coupler.step(predicted states of exchange k)      until
///     coupler.finished()

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/core/archive.hpp"
#include "common/wire/messages.hpp"
#include "coupler/exchange/interface_exchange.hpp"
#include "coupler/time_step.hpp"

namespace fsi::coupler {

struct CouplerOptions {
  TimeSchedule::Options time;
  double start = 0;        ///< time of the first exchange [time]
  bool multirate = false;  ///< solids may take substeps inside the step of the gas
  int robin_order = 2;     ///< extrapolation of the Robin data in time: 1 linear, 2 quadratic
  Combination combination;
  bool checkpoint_at_end = false;          ///< everybody writes one of the last step
  Path path = {};                          ///< of the interfaces; empty: the solids move them
  std::vector<std::string> periodic = {};  ///< interfaces that go on beyond their ends, a period further
};

class Coupler {
 public:
  /// @throws UserMistake when the interfaces of gas and solids do not meet; PeerLost when a hello makes no
  /// sense
  Coupler(const CouplerOptions& options, std::span<const wire::Hello> hellos);

  /// One exchange: projects every interface, agrees on the next step, commands the motion. Two answers per
  /// interface, to the gas and to the solid; they hold until the next call.
  /// @throws Diverged naming step, t, program, interface, point and quantity
  std::span<const wire::ProjectedInterface> step(std::span<const wire::PredictedInterface> predicted);

  /// The run ends with the next exchange.
  void request_stop(const std::string& reason) { stop_reason_ = reason; }
  /// Everybody writes a checkpoint of the step that follows the next exchange.
  void request_checkpoint() { checkpoint_ = true; }
  /// Everybody sends pictures of the next exchange; with `now` false only if the run ends with it.
  void request_show(bool now) {
    show_ = now;
    show_end_ = true;
  }
  /// The last exchange asked for pictures.
  bool shown() const { return shown_; }
  /// The last exchange asked for one: to be written now. Never at the end of the run.
  bool checkpoint_asked() const { return checkpoint_asked_; }
  /// Everything the next exchanges depend on.
  void archive(Archive& archive);

  bool finished() const { return finished_; }
  /// Exchanges made so far are 0 .. step_number().
  std::uint64_t step_number() const { return moment_.step; }
  /// Time of the last exchange, and the size of the step that led to it (0 at the first).
  double t() const { return moment_.t; }
  double dt() const { return moment_.dt; }
  /// The step agreed on in the last exchange.
  const AgreedStep& next() const { return next_; }
  /// What everybody proposed for it.
  const std::vector<Proposal>& proposals() const { return proposals_; }
  /// What the last exchange did, one per interface.
  std::vector<InterfaceReport> reports() const;
  /// For the monitor: values along each interface at the last exchange.
  std::vector<wire::Telemetry::Interface> profiles() const;
  /// Points of all interfaces.
  std::size_t points() const;

 private:
  const wire::PredictedInterface& find(std::span<const wire::PredictedInterface> predicted,
                                       const std::string& from, const std::string& interface) const;
  /// The interfaces of one solid.
  struct Solid {
    std::string name;
    std::vector<std::size_t> interfaces;
    ModalBody modes;  ///< where it has some
  };

  void project_interface(std::span<const wire::PredictedInterface> predicted);
  Eigen::VectorXd project_modes(Solid& solid) const;
  void agree_on_time_step(std::span<const wire::PredictedInterface> predicted);
  void shorten_first_step();
  void answer();
  std::int32_t substeps_of(const std::string& participant) const;

  CouplerOptions options_;
  TimeStepAgreement agreement_;
  std::vector<InterfaceExchange> interfaces_;
  std::vector<Solid> solids_;
  std::vector<std::string> participants_;  ///< the gases first
  std::size_t gases_ = 0;                  ///< so many
  std::vector<Proposal> proposals_;        ///< of the participants
  std::vector<wire::ProjectedInterface> answers_;
  Moment moment_;
  AgreedStep next_;
  bool begun_ = false, finished_ = false, output_ = false, at_end_ = false;
  bool checkpoint_ = false, checkpoint_asked_ = false;
  bool show_ = false, show_end_ = false, shown_ = false;
  std::string stop_reason_;
};

}  // namespace fsi::coupler
