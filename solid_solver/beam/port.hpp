#pragma once
/// The beam's port: a case file turned into a BeamMotion with
/// its outline, its state turned into messages and files.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/field.hpp"
#include "common/interface/modal_system.hpp"
#include "common/io/csv_writer.hpp"
#include "common/io/grid_writer.hpp"
#include "common/program/participant.hpp"
#include "solid_solver/beam/from_case.hpp"
#include "solid_solver/rigid/body_report.hpp"

namespace fsi::beam {

class BeamParticipant final : public Participant {
 public:
  BeamParticipant(const Setup& setup, const SolidSpec& spec);

  wire::Hello hello() const override;
  TimeStepBid compute_time_step() const override;
  void fill(std::size_t k, wire::PredictedInterface& predicted) const override;
  void apply_bcs(double t, ProjectedStates projected) override;
  void advance(double t, double dt, int substeps, ProjectedStates projected) override;
  std::vector<io::GridOutput> fields_now() override { return fields(); }
  void write_fields(double t, std::uint64_t step) override;
  void write_tables(double t, double dt, ProjectedStates projected) override;
  void write_last_state(double t, std::uint64_t step) override;
  void archive(Archive& archive) override;
  void report(double t, io::Part& part) const override;

 private:
  const Setup& setup_;
  const SolidSpec& spec_;
  BeamFromCase from_case_;
  BeamMotion& motion_;
  const std::vector<Skin>& skins_;
  io::GridWriter fields_;
  std::optional<rigid::ForceTable> forces_;
  std::optional<io::CsvWriter> probe_table_, energies_;
  std::vector<Attached> probes_;
  std::vector<Vec2> probe_places_;  ///< reference positions
  /// A skin in the fields: two lines of points, its outline and a line just beside the centre line.
  struct Drawn {
    std::string grid;
    Field reference, state;
  };
  std::vector<Drawn> drawn_;
  AddedMass added_mass_;
  const ModalLoad* gas_ = nullptr;  ///< what the gas answered last
  rigid::GasLoad load_;
  rigid::Impulse impulse_;
  double dt_ = 0;  ///< of the step going on; 0 before the first

  rigid::BodyTotals initial_;

  rigid::BodyTotals totals() const;
  std::vector<io::GridOutput> fields();
  /// The values of `quantities` at a point of the beam.
  std::array<double, 12> values_at(const Attached& point, const Vec2& x_bar) const;
  Eigen::VectorXd own_load(double t) const;
  double node_weight(int node) const;
  void open_tables();
  void place_grids();
};

}  // namespace fsi::beam
