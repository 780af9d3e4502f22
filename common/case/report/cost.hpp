#pragma once
/// What a run will cost: time steps, what sets them, steps and about how long they take.

#include <string>
#include <vector>

#include "common/case/case.hpp"
#include "common/core/types.hpp"

namespace fsi {

/// The time step of one program at t = 0, from the wave speeds
/// and the cells, paper eq. (44) and (45) without damping.
struct StepCost {
  std::string program;  ///< "fluid", or the name of a gas or a solid
  bool is_gas = false;
  int levels = 1;            ///< of the background; with more, `points` are those of the finest everywhere
  double points = 0;         ///< of all its grids, without those that outlines leave unused [-]
  double moving = 0;         ///< points of its grids that move with a body [-]
  double grids = 0;          ///< to march these anew and to connect them, each step, about [s]
  double dt = 0;             ///< infinite for a program that takes any step [time]
  std::string grid = {};     ///< whose cell sets it
  Vec2 x = Vec2::Zero();     ///< where
  Vec2 cell = Vec2::Zero();  ///< distances of points there, along the grid's two directions [length]
  bool has_corners = false;  ///< that grid is fitted to an outline with sharp corners
  double usual_dt =
      0;  ///< with the worst twentieth of all cells left out: much greater where a few set the step
  double saved = 0;  ///< part of the run's time that a step of usual_dt would save [-]
};

struct RunCost {
  std::vector<StepCost> programs;  ///< gas first
  double dt = 0;                   ///< of a step that all take together, safety factor included [time]
  double steps = 0;                ///< to time.end [-]
  double seconds = 0;              ///< about, each program on a core of its own [s]
  double h = 0;                    ///< of the case's `grid` [length]
  /// The same with `time.multirate`, of a case that could have it and does not; else 0.
  double multirate_steps = 0, multirate_seconds = 0;
  /// Of a program within a step: 1, or more with `time.multirate`.
  int substeps(const StepCost& program) const;
  /// What a step takes it on one core, about [s].
  double seconds_of(const StepCost& program) const;
};

/// Of a case whose grids connect. Wave speeds are those of the initial and the boundary states, the largest
/// for all grids: a flow that becomes faster takes more steps.
RunCost cost_of(const Case& problem);

/// @throws UserMistake for a run of more steps than any can take, or of more substeps than a step may have: the first one would
/// be refused (`TimeSchedule`, `TimeStepAgreement`)
void refuse_endless(const RunCost& cost);

/// For people, a line for each program and one for the run;
/// and one more where a few small cells set the step, or where the run takes more than an hour.
std::string cost_text(const RunCost& cost);

}  // namespace fsi
