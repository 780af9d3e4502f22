#pragma once
/// The solid of a case as every rank has it: its solver, and what it does between two answers of the coupler.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/case/case.hpp"
#include "common/io/part.hpp"
#include "solid_solver/any_solid_solver.hpp"
#include "solid_solver/boundary/joined_sides.hpp"
#include "solid_solver/boundary/robin.hpp"
#include "solid_solver/program/case_data.hpp"
#include "solid_solver/program/law_kind.hpp"

namespace fsi::solid {

/// Where the solid meets a gas: along a side of a grid, or along several from corner to corner.
struct Meeting {
  JoinedSides along;
  int grid;          ///< component grid
  std::string name;  ///< of the interface

  bool is_side() const { return along.stretches().size() == 1; }
  Side side() const { return along.stretches().front().side; }
};

/// What the coupler says of an interface, as far as a solid goes by it.
struct Answer {
  std::span<const double> n, v_n, w_n;  ///< projected state, as in InterfaceValues
  RobinData gas;                        ///< for the steps within the next macro step
};

/// Called after each kind of work, when it is known what the time went into.
using Lap = std::function<void(io::Work)>;

class SolidBody {
 public:
  SolidBody(const Setup& setup, const SolidSpec& spec, const LawKind& law);

  AnySolidSolver& solver() { return *solver_; }
  const AnySolidSolver& solver() const { return *solver_; }
  const CaseData& data() const { return data_; }
  /// The interfaces, in the order of the hello.
  std::span<const Meeting> meetings() const { return meetings_; }

  void apply_bcs(double t, std::span<const Answer> answers);
  /// From t to t + dt in equal steps, without interface conditions at the end. Calls lap(kind of work) after each kind
  /// but the last.
  void advance(double t, double dt, int substeps, std::span<const Answer> answers, const Lap& lap);

  /// Predicted state of an interface; reuses the memory of `state`.
  void show(const Meeting& meeting, SolidInterface& state) const;
  /// Reference positions of its points.
  std::vector<double> reference_points(const Meeting& meeting) const;
  SideLoad load(const Meeting& meeting) const;
  /// Unit normals of an interface at these positions; of ends that slide along a wall, its direction.
  std::vector<double> normals(const Meeting& meeting, std::span<const double> x,
                              std::span<const std::uint8_t> freedom) const;

 private:
  void find_interface(const SolidSpec& spec, int grid, const std::array<BoundarySpec, 4>& boundary);
  void find_outline(const SolidSpec& spec);
  std::vector<double> unturned_normals(const Meeting& meeting, std::span<const double> x) const;
  /// Direction in which an end of an interface slides along a wall.
  Vec2 along_wall(const Meeting& meeting, bool first) const;
  /// Adds what an interface is told to `values_`, side by side.
  void tell(Meeting& meeting, InterfaceValues values);
  /// Does a rank know the interface?
  bool shows(const Meeting& meeting) const;
  /// The interfaces inside a macro step: the gas is known by its outgoing characteristic.
  void close_substep(double t, std::span<const Answer> answers);

  CaseData data_;
  std::unique_ptr<AnySolidSolver> solver_;
  std::vector<Meeting> meetings_;
  SolidInterface interface_;                   ///< memory that is used again every step
  mutable std::vector<SolidInterface> sides_;  ///< the same
  std::vector<InterfaceValues> values_;        ///< the same
};

}  // namespace fsi::solid
