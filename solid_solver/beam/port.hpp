#pragma once
/// The beam's port: a case file turned into a BeamMotion with
/// its outline, its state turned into messages and files.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "common/interface/modal_system.hpp"
#include "common/io/csv_writer.hpp"
#include "solid_solver/beam/from_case.hpp"
#include "solid_solver/bodies/participant.hpp"

namespace fsi::beam {

class BeamParticipant final : public bodies::BodyParticipant {
 public:
  BeamParticipant(const Setup& setup, const SolidSpec& spec);

  ProposedTimeStep compute_time_step() const override;
  void fill(std::size_t k, wire::PredictedInterface& predicted) const override;
  void apply_bcs(double t, ProjectedStates projected) override;
  void advance(double t, double dt, int substeps, ProjectedStates projected) override;
  void write_tables(double t, double dt, ProjectedStates projected) override;
  void flush_tables() override;

 private:
  bodies::BodyTotals totals() const override;
  bool is_surrounded() const override;
  void archive_motion(Archive& archive) override;
  void values_at(const bodies::DrawnPoint& point, std::span<double> values) const override;
  void values_at(const Attached& point, const Vec2& x_bar, std::span<double> values) const;
  bodies::BodyMotion mean_motion() const;
  Eigen::VectorXd own_load(double t) const;
  double node_weight(int node) const;

  BeamFromCase from_case_;
  BeamMotion& motion_;
  const std::vector<Skin>& skins_;
  io::CsvWriter energies_;
  std::vector<Attached> probes_;
  AddedMass added_mass_;
  const ModalLoad* gas_ = nullptr;  ///< what the gas answered last
};

}  // namespace fsi::beam
