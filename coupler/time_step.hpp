#pragma once
/// One time step for everybody: the minimum of the proposals, or with multirate a macro step that suits the gas,
/// in which each solid takes as many equal substeps as it needs.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/core/time/time_schedule.hpp"

namespace fsi::coupler {

/// Largest step one program can take.
struct Proposal {
  std::string from;          ///< participant's name
  double dt = 0;             ///< safety factor included; infinite: no limit [time]
  std::string reason;        ///< what limits it, for people
  bool may_substep = false;  ///< a solid under multirate: it can take substeps inside a larger step
};

/// What everybody does next.
struct AgreedStep {
  PlannedStep plan;
  std::string limited_by;              ///< the program or setting that limits the step
  std::string reason;                  ///< what limits that program, for people
  std::vector<std::int32_t> substeps;  ///< for each proposal: equal steps it takes inside the agreed one
};

class TimeStepAgreement {
 public:
  /// @param start time of the first exchange
  TimeStepAgreement(const TimeSchedule::Options& options, double start);

  /// The step from now on; `t()` becomes the time after it.
  /// @throws Diverged when a proposal is no positive number, vanishes, or needs more than 10000 substeps
  AgreedStep agree(std::span<const Proposal> proposals);
  double t() const { return t_; }
  const TimeSchedule& schedule() const { return schedule_; }
  void archive(Archive& archive);

 private:
  TimeSchedule schedule_;
  double t_;  ///< [time]
};

}  // namespace fsi::coupler
