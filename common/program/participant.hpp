#pragma once
/// What a solver is to the loop that drives it. Implement this to bring a solver of your own.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/core/archive.hpp"
#include "common/grid/watch.hpp"
#include "common/io/grid_writer.hpp"
#include "common/io/part.hpp"
#include "common/program/program.hpp"
#include "common/wire/messages.hpp"

namespace fsi {

/// Largest step the solver can take, safety factor included; infinite when it has no limit.
struct ProposedTimeStep {
  double dt = 0;  ///< [time]
  std::string reason;
};

/// Projected states of the solver's interfaces in the order of its hello; empty when it runs alone.
using ProjectedStates = std::span<const wire::ProjectedInterface* const>;

class Participant {
 public:
  Participant() = default;
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;
  Participant(Participant&&) = delete;
  Participant& operator=(Participant&&) = delete;
  virtual ~Participant() = default;

  /// From now on the solver may say on what it spent its time; the driver does so after each of its calls.
  void use(WorkClock& clock) { clock_ = &clock; }

  /// Role, name, law, points and interfaces.
  virtual wire::Hello hello() const = 0;
  virtual ProposedTimeStep compute_time_step() const = 0;
  /// Predicted state of interface number k of the hello. The driver has filled in interface, step, time and
  /// proposal, and adds health and times.
  virtual void fill(std::size_t k, wire::PredictedInterface& predicted) const = 0;
  /// Boundary and interface conditions at t.
  virtual void apply_bcs(double t, ProjectedStates projected) = 0;
  /// From t to t + dt in `substeps` equal steps, without interface conditions at the end.
  virtual void advance(double t, double dt, int substeps, ProjectedStates projected) = 0;
  /// Saves or loads all that the next steps depend on, tables and series of fields included.
  virtual void archive(Archive& archive) = 0;

  // What follows nobody needs to have.

  /// Fields of the present state, for pictures. The views hold until the state changes.
  virtual std::vector<io::GridOutput> fields_now() { return {}; }
  /// Fields at t.
  virtual void write_fields(double /*t*/, std::uint64_t /*step*/) {}
  /// Lines of the tables, once a step. Of several, `io::write_each` lets one that fails not lose the others.
  virtual void write_tables(double /*t*/, double /*dt*/, ProjectedStates /*projected*/) {}
  /// Hands the lines of the tables that still wait to the operating system, at the end.
  virtual void flush_tables() {}
  /// Fields at the last time t at which boundary conditions held, apart from the series: the solution diverged.
  virtual void write_last_state(double /*t*/, std::uint64_t /*step*/) {}
  /// By default that of a body that does not deform.
  virtual wire::Health health() const { return {.min_det_F = 1}; }
  /// Looks for noise in the fields at t, and compares grids that overlap; once in a while, at output times and at the
  /// end.
  virtual void look_for_noise(double /*t*/) {}
  /// What to change in the case where the solution diverged: one thing, the likeliest.
  virtual std::string remedy() const { return {}; }
  /// What was found; null for a solver without fields.
  virtual const grid::Watch* noise() const { return nullptr; }
  /// Where its grids disagree; null for a solver without grids that overlap.
  virtual const grid::Watch* disagreement() const { return nullptr; }
  /// The strongest shock of a gas without viscosity; null for a solver that need not look for one.
  virtual const grid::Watch* strong_shock() const { return nullptr; }
  /// Errors, counters and budgets at the end of the run.
  virtual void report(double /*t*/, io::Part& /*part*/) const {}

 protected:
  /// The time since the last lap, of the solver or its driver, went into `work`.
  void lap(io::Work work) {
    if (clock_ != nullptr) clock_->lap(work);
  }

 private:
  WorkClock* clock_ = nullptr;
};

/// Runs a solver to the end of the case: with the coupler when it has interfaces, alone when it has none.
void participate(const Setup& setup, io::Part& part, Participant& solver);

}  // namespace fsi
