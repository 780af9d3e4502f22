#pragma once
/// A background of several levels: each is a lattice over the whole rectangle, three times as coarse as the
/// next finer one, and advances those of its points that no finer level covers.
///
///     level 1     O   O   O   O | . . . | O         O  advanced
///     level 0             ~ ~ ~ | o o o | ~ ~ ~     o  advanced
///                                                   ~  made from level 1 before each step
///                                                   .  averages of level 0, two points deep
///
/// All levels take the same step; what crosses a rim is one flux for both sides. Level 0 is the background
/// that body-fitted grids overlap; bodies and what overlaps them lie in its advanced part.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/core/archive.hpp"
#include "common/grid/overlap/composite_grid.hpp"
#include "fluid_solver/boundary/boundary_conditions.hpp"
#include "fluid_solver/component.hpp"
#include "fluid_solver/levels/cell_mask.hpp"
#include "fluid_solver/levels/level_faces.hpp"
#include "fluid_solver/levels/transfer.hpp"

namespace fsi::fluid {

class GasLevels {
 public:
  /// For a background of its options' levels; components[first] is to be level 1.
  /// @throws UserMistake where the background's points do not fit
  GasLevels(const Component& background, const Refinement& options, std::size_t first, double gamma);

  int levels() const { return options_.levels; }
  /// Grids of the levels 1, 2, ..
  std::vector<grid::MovingGrid> coarse_grids(const Component& background) const;

  /// Level 0 has values everywhere; chooses the levels for them and for the bodies. @param composite null:
  /// there are none
  void start(std::span<Component> components, const grid::CompositeGrid* composite);
  /// Tells the finest level its points; after every update of the overlap.
  void use_finest_points(Component& finest, const grid::CompositeGrid* composite);
  /// The fluxes that the next finer level carried through its rim become those of level l.
  void match(std::span<Component> components, int l) const;
  /// Averages of finer levels, where coarser ones need them. Boundary points are known.
  void average(std::span<Component> components) const;
  /// Values of the rim of level l from the next coarser one, whose ghosts are known.
  void surround(std::span<Component> components, int l) const;
  /// To be called with every completed step; adapts the levels to the state when it is time.
  /// @returns whether something changed
  bool adapt(std::span<Component> components, const grid::CompositeGrid* composite, const BoundaryTask& task);

  /// The points of level l that stand for the areas around them.
  const grid::RowSets& owned(int l) const { return owned_[static_cast<std::size_t>(l)]; }
  /// Which component is level l.
  std::size_t component(int l) const { return l == 0 ? 0 : first_ + static_cast<std::size_t>(l) - 1; }
  bool is_coarse(const Component& component, std::span<const Component> components) const {
    return &component >= &components[first_];
  }
  bool has(std::size_t component) const { return component == 0 || component >= first_; }
  int level_of(std::size_t component) const {
    return component < first_ ? 0 : static_cast<int>(component - first_) + 1;
  }

  /// Takes points off a picture of level l, row by row (0: not shown), whose areas another level shows: the cells between
  /// shown points then tile the rectangle, a finer level's up to the coarser one's.
  void show_once(int l, std::span<std::uint8_t> kinds) const;

  void archive(Archive& archive);
  /// After loading.
  void restore(std::span<Component> components, const grid::CompositeGrid* composite);

 private:
  /// Level l > 0.
  struct Level {
    CellMask covered;  ///< by the next finer level
    grid::RowSets restricted,
        prolonged;        ///< covered points with averages; points that surround the finer level
    grid::RowSets valid;  ///< points with a value
    LevelFaces faces;
  };

  Refinement options_;
  std::size_t first_;
  double gamma_;
  Ends ends_{};
  std::vector<LatticeShape> shapes_;
  std::vector<Level> coarse_;         ///< of levels 1, 2, ..
  std::vector<grid::RowSets> owned_;  ///< of all levels
  grid::RowSets reach_;               ///< of level 0: owned and surrounding points
  int since_ = 0;                     ///< steps since the last adaptation
  int adaptations_ = 0;               ///< that changed something
  grid::RowSets both_, both_reach_;   ///< work memory: of level 0, without what a body covers

  Level& at(int l) { return coarse_[static_cast<std::size_t>(l) - 1]; }
  const Level& at(int l) const { return coarse_[static_cast<std::size_t>(l) - 1]; }
  const LatticeShape& shape(int l) const { return shapes_[static_cast<std::size_t>(l)]; }
  void use_points(std::span<Component> components, const grid::CompositeGrid* composite);
  CellMask region(int l, const std::vector<CellMask>& covered) const;
  bool closes_a_cell(int l, int i, int j) const;
  void install(std::span<Component> components, std::vector<CellMask> covered);
  std::vector<CellMask> average_all(std::span<Component> components,
                                    const std::vector<CellMask>& wanted) const;
  std::vector<CellMask> choose(std::span<const Component> components, const grid::CompositeGrid* composite,
                               const std::vector<CellMask>& known) const;
  void fill_new(std::span<Component> components, const std::vector<CellMask>& covered,
                const BoundaryTask& task) const;
};

}  // namespace fsi::fluid
