#pragma once
/// The solid solver's port: a case file turned into a solver for its law, its state turned into messages and files.

#include <optional>
#include <string>
#include <vector>

#include "common/core/time/time_integral.hpp"
#include "common/grid/ripple.hpp"
#include "common/io/csv_writer.hpp"
#include "common/io/grid_writer.hpp"
#include "common/program/participant.hpp"
#include "solid_solver/program/body.hpp"
#include "solid_solver/program/crew.hpp"
#include "solid_solver/program/remedy.hpp"

namespace fsi::solid {

class SolidParticipant final : public Participant {
 public:
  SolidParticipant(const Setup& setup, const SolidSpec& spec, const LawKind& law);

  wire::Hello hello() const override;
  ProposedTimeStep compute_time_step() const override;
  void fill(std::size_t k, wire::PredictedInterface& predicted) const override;
  void apply_bcs(double t, ProjectedStates projected) override;
  void advance(double t, double dt, int substeps, ProjectedStates projected) override;
  void archive(Archive& archive) override;
  std::vector<io::GridOutput> fields_now() override;
  void write_fields(double t, std::uint64_t step) override;
  void write_tables(double t, double dt, ProjectedStates projected) override;
  void flush_tables() override;
  /// The state as it is: all grids of the solid at the time before the sweep that broke, or what was
  /// predicted when a condition on its sides broke.
  void write_last_state(double t, std::uint64_t step) override;
  wire::Health health() const override;
  void look_for_noise(double t) override;
  std::string remedy() const override;
  const grid::Watch* noise() const override { return &*ripples_; }
  void report(double t, io::Part& part) const override;

 private:
  /// What the solid goes by.
  std::span<const Answer> answers(ProjectedStates projected);
  /// @throws Diverged where the solid has lost its waves at an interface, which is in `interface_`
  void expect_waves(const Meeting& meeting) const;
  std::vector<Strip> strips_of_probes() const;
  /// Of all gases.
  SideLoad whole_load() const;
  std::vector<io::GridOutput> fields() const;
  /// Whether all that acts on the body is the gas.
  bool surrounded() const;
  /// From where the reference configuration has the interface to where its given path has it.
  void move_along(const Meeting& meeting, std::vector<double>& x) const;
  void watch_ripples();
  void open_tables();
  /// A line of the table; the forces are summed as well.
  void write_forces(double t, double dt);
  void write_probes(double t);

  const Setup& setup_;
  const SolidSpec& spec_;
  LawKind law_;
  SolidBody body_;
  AnySolidSolver& solver_;            ///< of the body
  mutable Crew crew_;                 ///< asked as well where nothing changes: the others have the numbers
  std::vector<Answer> answers_;       ///< memory that is used again every step
  mutable SolidInterface interface_;  ///< memory that is used again every step
  io::GridWriter fields_;
  std::optional<io::CsvWriter> forces_, probe_table_;
  std::vector<ProbePoint> probes_;
  Totals initial_totals_;
  TimeIntegral<4> received_;  ///< of the gas: force, power, size of the force
  Squeeze squeeze_;
  std::optional<grid::RippleWatch> ripples_;
  std::vector<grid::WatchedGrid> watched_;  ///< work memory
};

}  // namespace fsi::solid
