#pragma once
/// The gas solver's port: a case file turned into a GasSolver, its state turned into messages and files.

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/case/case.hpp"
#include "common/exact/solution.hpp"
#include "common/grid/overlap/disagreement.hpp"
#include "common/grid/ripple.hpp"
#include "common/io/csv_writer.hpp"
#include "common/io/grid_writer.hpp"
#include "common/program/participant.hpp"
#include "fluid_solver/gas_solver.hpp"
#include "fluid_solver/measures/budget.hpp"
#include "fluid_solver/measures/strong_shocks.hpp"
#include "fluid_solver/program/crew.hpp"

namespace fsi::fluid {

class FluidParticipant final : public Participant {
 public:
  explicit FluidParticipant(const Setup& setup);

  wire::Hello hello() const override;
  ProposedTimeStep compute_time_step() const override;
  void fill(std::size_t k, wire::PredictedInterface& predicted) const override;
  void apply_bcs(double t, ProjectedStates projected) override;
  void advance(double t, double dt, int substeps, ProjectedStates projected) override;
  std::vector<io::GridOutput> fields_now() override;
  void write_fields(double t, std::uint64_t step) override;
  void write_tables(double t, double dt, ProjectedStates projected) override;
  void flush_tables() override;
  void write_last_state(double t, std::uint64_t step) override;
  void archive(Archive& archive) override;
  wire::Health health() const override;
  void look_for_noise(double t) override;
  const grid::Watch* noise() const override { return &*ripples_; }
  const grid::Watch* disagreement() const override { return disagreement_ ? &*disagreement_ : nullptr; }
  const grid::Watch* strong_shock() const override { return shocks_ ? &*shocks_ : nullptr; }
  void report(double t, io::Part& part) const override;

 private:
  /// A side of a component grid, and what the interface there is called.
  struct InterfaceSide {
    int grid;
    Side side;
    std::string name;
  };

  /// The chosen solution at the points of an interface: n.v and p - p_e. Empty without one.
  struct ChosenValues {
    std::vector<double> v, p;
  };
  /// Of the last complete step, or of the state as it is.
  std::vector<io::GridOutput> fields(bool last) const;
  std::string name_of_interface(const std::string& solid) const {
    return interface_name(*std::ranges::find(setup_.problem.solids, solid, &SolidSpec::name), spec_.name);
  }
  ChosenValues chosen_at(const InterfaceSide& interface) const;

  const Setup& setup_;
  const FluidSpec& spec_;
  std::shared_ptr<const exact::Solution> reference_;
  bool chosen_ = false;  ///< source terms make the reference exact
  std::vector<InterfaceSide> interfaces_;
  GasSolver solver_;
  mutable Crew crew_;  ///< asked as well where nothing changes: the others have the numbers
  io::GridWriter fields_;
  std::vector<ProbeSpec> probes_;
  std::optional<io::CsvWriter> probe_table_;
  Totals initial_totals_;
  double worst_cells_ = 1;        ///< quality of the moving grids' cells, smallest since the start
  std::optional<Budget> budget_;  ///< of a gas around closed bodies
  std::optional<io::CsvWriter> budget_table_;
  std::optional<grid::RippleWatch> ripples_;
  std::optional<grid::DisagreementWatch> disagreement_;  ///< of grids that overlap
  std::optional<ShockWatch> shocks_;        ///< where the case leaves open whether there is a viscosity
  std::vector<grid::WatchedGrid> watched_;  ///< work memory

  void open_budget();
  std::vector<Strip> strips_of_tables() const;
  void watch_fields();
};

}  // namespace fsi::fluid
