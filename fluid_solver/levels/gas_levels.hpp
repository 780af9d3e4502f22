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
#include <initializer_list>
#include <span>
#include <vector>

#include "common/core/archive.hpp"
#include "common/grid/overlap/composite_grid.hpp"
#include "common/ranks/rows/share.hpp"
#include "fluid_solver/boundary/boundary_conditions.hpp"
#include "fluid_solver/component.hpp"
#include "fluid_solver/levels/cell_mask.hpp"
#include "fluid_solver/levels/level_faces.hpp"
#include "fluid_solver/levels/transfer.hpp"
#include "fluid_solver/ranks/flux_delivery.hpp"

namespace fsi::fluid {

/// What the levels work on.
struct LevelScene {
  std::span<Component> components;
  const grid::CompositeGrid*
      composite;  ///< how body-fitted grids overlap the finest level; null: there are none
  Share& share;   ///< who has which rows
};

class GasLevels {
 public:
  /// For a background of its options' levels; components[first] is to be level 1.
  /// @throws UserMistake where the background's points do not fit
  GasLevels(const Component& background, const Refinement& options, std::size_t first, double gamma);

  int levels() const { return options_.levels; }
  /// Grids of the levels 1, 2, ..
  std::vector<grid::MovingGrid> coarse_grids(const Component& background) const;

  /// Level 0 has values everywhere; chooses the levels for them and for the bodies.
  void start(const LevelScene& scene);
  /// Ranks have got other rows, or the first ones.
  void share_out(const LevelScene& scene);
  /// Tells the finest level its points; after every update of the overlap.
  void use_finest_points(Component& finest, const grid::CompositeGrid* composite);
  /// The fluxes that the next finer level carried through its rim become those of level l.
  void match(const LevelScene& scene, int l);
  /// Averages of finer levels, where coarser ones need them, in rows of one's own. Boundary points are known.
  void average(const LevelScene& scene);
  /// Values of all rims from the next coarser level, and the ghosts of all coarse levels. Averages are known, in halos
  /// too.
  void surround(const LevelScene& scene, const BoundaryTask& task);
  /// To be called with every completed step; adapts the levels to the state when it is time.
  /// @returns whether something changed
  bool adapt(const LevelScene& scene, const BoundaryTask& task);

  /// The points of level l > 0 that have averages.
  const grid::RowSets& averaged(int l) const { return at(l).restricted; }
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
  void restore(const LevelScene& scene);

 private:
  /// Level l > 0.
  struct Level {
    CellMask covered;  ///< by the next finer level
    grid::RowSets restricted,
        prolonged;        ///< covered points with averages; points that surround the finer level
    grid::RowSets valid;  ///< points with a value
    LevelFaces faces;
    // What of it this rank does, and what others bring for that.
    grid::RowSets restricted_here, prolonged_here;
    Delivery to_restrict, to_prolong;
    FluxDelivery to_match;
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
  std::vector<FieldView> fields_;     ///< work memory: the state of each grid

  Level& at(int l) { return coarse_[static_cast<std::size_t>(l) - 1]; }
  const Level& at(int l) const { return coarse_[static_cast<std::size_t>(l) - 1]; }
  const LatticeShape& shape(int l) const { return shapes_[static_cast<std::size_t>(l)]; }
  void use_points(const LevelScene& scene);
  std::span<const FieldView> states(const LevelScene& scene);
  CellMask region(int l, const std::vector<CellMask>& covered) const;
  /// Of the refined quantity.
  int plane() const { return options_.quantity == RefinedQuantity::p ? 3 : 0; }
  bool closes_a_cell(int l, int i, int j) const;
  void install(const LevelScene& scene, std::vector<CellMask> covered);
  enum class Averaged { state, quantity };
  void average_at(const LevelScene& scene, int l, const grid::RowSets& points, Averaged what);
  std::vector<CellMask> average_all(const LevelScene& scene, const std::vector<CellMask>& wanted,
                                    Averaged what);
  void average_uncovered(const LevelScene& scene, const std::vector<CellMask>& covered,
                         const std::vector<CellMask>& known);
  double least_bend(const LevelScene& scene) const;
  std::vector<CellMask> choose(const LevelScene& scene, const std::vector<CellMask>& known) const;
  enum class Copies { state, both };
  void hand_down(const LevelScene& scene, int l, const grid::RowSets& points, Copies copies);
  void fill_new(const LevelScene& scene, const std::vector<CellMask>& covered, const BoundaryTask& task);
  /// Points with averages and those around the finer level, of a level.
  struct Rim {
    grid::RowSets restricted, prolonged;
  };
  void complete_rims(const LevelScene& scene, const std::vector<Rim>& before, const BoundaryTask& task);

  // Several ranks.
  grid::RowSets averaged_here(const LevelScene& scene, int l, const grid::RowSets& points) const;
  grid::RowSets prolonged_here(const LevelScene& scene, int l, const grid::RowSets& points) const;
  Delivery averages_of(const LevelScene& scene, int l, const grid::RowSets& points) const;
  void need_averages(const LevelScene& scene, int l, const grid::RowSets& points, Delivery& delivery) const;
  bool averages_averages(int l) const;
  void plan_averages(const LevelScene& scene);
  Delivery parents_of(const LevelScene& scene, int l, const grid::RowSets& points) const;
  FluxDelivery fluxes_of(const LevelScene& scene, int l) const;
  void bring_halos(const LevelScene& scene, int l, std::initializer_list<const grid::RowSets*> points);
  void gather(const LevelScene& scene, int l, CellMask& flags) const;
};

}  // namespace fsi::fluid
