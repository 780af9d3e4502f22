#pragma once
/// The rigid body's port: a case file turned into a RigidBody, its state turned into messages and files.

#include <optional>
#include <string>
#include <vector>

#include "common/core/field.hpp"
#include "common/io/csv_writer.hpp"
#include "common/io/grid_writer.hpp"
#include "common/program/participant.hpp"
#include "solid_solver/rigid/body_report.hpp"
#include "solid_solver/rigid/from_case.hpp"

namespace fsi::rigid {

class RigidParticipant final : public Participant {
 public:
  RigidParticipant(const Setup& setup, const SolidSpec& spec);

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
  BodyFromCase from_case_;
  RigidBody& body_;
  io::GridWriter fields_;
  std::optional<ForceTable> forces_;
  std::optional<io::CsvWriter> probe_table_;
  std::vector<Vec2> probes_;  ///< reference positions
  /// An outline in the fields: two lines of points, itself and the centre of the body.
  struct Drawn {
    std::string grid;
    Field reference, state;
  };
  std::vector<Drawn> drawn_;
  Vec3 own_;  ///< own load at the end of the step
  GasLoad load_;
  Impulse impulse_;
  double dt_ = 0;  ///< of the step going on; 0 before the first

  BodyTotals initial_;

  BodyTotals totals() const;
  std::vector<io::GridOutput> fields();
  Vec3 own_load(double t) const;
  void open_tables();
  void place_grids();
};

}  // namespace fsi::rigid
