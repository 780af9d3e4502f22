#pragma once
/// The ranks of a solid as rank 0 directs them: what it does with its body, it tells the others to do as well.
///
///     rank 0   SolidParticipant ---> Crew ---> SolidBody
///                                      | broadcast: what, and with which numbers
///     others   serve() <---------------+
///                 |------------------------> SolidBody
///
/// With one rank nothing is told to anybody.

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "common/program/program.hpp"
#include "common/ranks/orders.hpp"
#include "solid_solver/program/body.hpp"

namespace fsi::solid {

class Crew {
 public:
  Crew(std::shared_ptr<Ranks> ranks, SolidBody& body) : foreman_(std::move(ranks)), body_(body) {}
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  Crew(Crew&&) = delete;
  Crew& operator=(Crew&&) = delete;
  /// Lets the others go.
  ~Crew();

  bool alone() const { return foreman_.alone(); }
  void apply_bcs(double t, std::span<const Answer> answers);
  void advance(double t, double dt, int substeps, std::span<const Answer> answers, const Lap& lap);
  /// Interface sides and these strips come to rank 0.
  void fetch(const std::vector<Strip>& strips);
  Pose pose();
  void collect();
  void collect_all();
  /// The solver has loaded a state, which the others get from it.
  void loaded();

 private:
  Foreman foreman_;
  SolidBody& body_;
  bool collected_ = false;  ///< since the state changed last
};

/// The life of another rank than the first: does what it is told until it is let go.
void serve(const Setup& setup, const SolidSpec& spec, const LawKind& law);

}  // namespace fsi::solid
