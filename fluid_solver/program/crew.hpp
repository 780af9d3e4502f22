#pragma once
/// The ranks of the gas as rank 0 directs them: what it does with its solver, it tells the others to do as well.
///
///     rank 0   FluidParticipant ---> Crew ---> GasSolver
///                                      | broadcast: what, and with which numbers
///     others   serve() <---------------+
///                 |------------------------> GasSolver
///
/// With one rank nothing is told to anybody.

#include <memory>
#include <span>
#include <vector>

#include "common/program/program.hpp"
#include "common/ranks/orders.hpp"
#include "common/ranks/ranks.hpp"
#include "fluid_solver/gas_solver.hpp"

namespace fsi::fluid {

class Crew {
 public:
  Crew(std::shared_ptr<Ranks> ranks, GasSolver& solver) : foreman_(std::move(ranks)), solver_(solver) {}
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  Crew(Crew&&) = delete;
  Crew& operator=(Crew&&) = delete;
  /// Lets the others go.
  ~Crew();

  bool alone() const { return foreman_.alone(); }
  void apply_bcs(double t, std::span<const InterfaceValues> interfaces);
  void move(double t_new, double dt, std::span<const grid::SideCommand> commands);
  void advance(double t, double dt);
  /// Whatever one wants to know next is up to date: see GasSolver.
  void look();
  void fetch(std::span<const Strip> strips);
  void collect();
  void collect_all();
  /// The solver has loaded a state, which the others get from it.
  void loaded();

 private:
  Foreman foreman_;
  GasSolver& solver_;
  bool looked_ = false, collected_ = false;  ///< since the state changed last

  void state_changes() { looked_ = collected_ = false; }
};

/// The life of another rank than the first: does what it is told until it is let go.
void serve(const Setup& setup);

}  // namespace fsi::fluid
