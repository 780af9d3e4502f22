#pragma once
/// Turns the largest stable step into the next step: output
/// times and the end are hit exactly, growth is limited.

#include <string>
#include <vector>

#include "common/core/archive.hpp"

namespace fsi {

/// A solid that would take more substeps than these in a step has no step worth the name.
inline constexpr double most_substeps = 10000;

/// Times from 0 to `end`, sorted. Those closer to each other than 1e-8 of the run are one, the first of them;
/// those so close to the start or the end are that.
std::vector<double> distinct_times(std::vector<double> times, double end);

/// What keeps a step from being longer.
enum class StepLimit { proposal, growth, largest, output };

/// Its name in the case file, `proposer` for a proposal.
std::string name_of(StepLimit limit, const std::string& proposer);
/// What it is, for people; `reason` for a proposal.
std::string words_for(StepLimit limit, const std::string& reason);

struct PlannedStep {
  double dt = 0;                          ///< [time]
  double t_next = 0;                      ///< exactly an output time when the step reaches one [time]
  bool output = false;                    ///< fields are wanted at t_next
  bool end = false;                       ///< t_next is the end of the run
  StepLimit limit = StepLimit::proposal;  ///< `output` where a wanted time makes the step shorter than half
};

class TimeSchedule {
 public:
  struct Options {
    double end = 1;                    ///< [time]
    std::vector<double> output_times;  ///< any order; times beyond the end are ignored; see distinct_times
    double growth = 1.2;               ///< largest ratio of successive steps [-]
    double dt_max = 0;                 ///< 0: no limit besides stability [time]
  };

  explicit TimeSchedule(Options options);

  bool output_at_start() const;
  /// The step from t when `proposal` is the largest stable one (named by `reason`). What remains until the next
  /// wanted time is divided evenly, so that no sliver of a step is left over.
  /// @throws Diverged when the proposal is not a positive number or vanishes against the length of the run, in
  /// which the first step did not; UserMistake when that already did
  PlannedStep plan(double t, double proposal, const std::string& reason);
  /// Whether t, planned by another schedule, is an output time or the end of this one: that of a run that
  /// goes on with another end.
  bool is_output(double t) const;
  bool is_end(double t) const;
  void archive(Archive& archive) { archive.number("previous", previous_); }

 private:
  Options options_;
  double previous_ = 0;  ///< last step before it was shortened to hit a time [time]
};

}  // namespace fsi
