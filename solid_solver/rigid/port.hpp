#pragma once
/// The rigid body's port: a case file turned into a RigidBody, its state turned into messages and files.

#include <span>

#include "solid_solver/bodies/participant.hpp"
#include "solid_solver/rigid/from_case.hpp"

namespace fsi::rigid {

class RigidParticipant final : public bodies::BodyParticipant {
 public:
  RigidParticipant(const Setup& setup, const SolidSpec& spec);

  ProposedTimeStep compute_time_step() const override;
  void fill(std::size_t k, wire::PredictedInterface& predicted) const override;
  void apply_bcs(double t, ProjectedStates projected) override;
  void advance(double t, double dt, int substeps, ProjectedStates projected) override;
  void write_tables(double t, double dt, ProjectedStates projected) override;

 private:
  bodies::BodyTotals totals() const override;
  bool is_surrounded() const override;
  void archive_motion(Archive& archive) override;
  void values_at(const bodies::DrawnPoint& point, std::span<double> values) const override;
  void values_at(const Vec2& x_bar, std::span<double> values) const;
  Vec3 own_load(double t) const;

  BodyFromCase from_case_;
  RigidBody& body_;
  Vec3 own_;  ///< own load at the end of the step
};

}  // namespace fsi::rigid
