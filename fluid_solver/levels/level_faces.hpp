#pragma once
/// Fluxes through the rim of a refined region: what leaves the fine level enters the coarse one.
///
///     o   o   o | O          each face of a coarse control volume at the rim is three fine faces; the coarse
///     o   o   o =            flux there is their mean
///     o   o   o | O

#include <array>
#include <cstddef>
#include <vector>

#include "fluid_solver/kernels/face_fluxes.hpp"
#include "fluid_solver/levels/cell_mask.hpp"
#include "fluid_solver/levels/transfer.hpp"

namespace fsi::fluid {

class LevelFaces {
 public:
  LevelFaces() = default;
  /// The faces between covered points of a coarse lattice and the others: those to note on the fine lattice
  /// of `fine` points, and those to impose.
  LevelFaces(const CellMask& covered, const LatticeShape& fine, const Ends& ends, FaceFluxes& noted,
             FaceFluxes& imposed);

  /// The imposed fluxes from those noted in the step.
  void match(const FaceFluxes& noted, FaceFluxes& imposed) const;

  /// Calls action(direction, imposed face, noted face) for each of those that an imposed flux is the mean of.
  template <class Action>
  void each_source(const Action& action) const {
    for (const int direction : {0, 1}) {
      const std::vector<Source>& sources = direction == 0 ? along_ : between_;
      for (std::size_t face = 0; face < sources.size(); ++face) {
        for (std::size_t k = 0; k < static_cast<std::size_t>(sources[face].n); ++k)
          action(direction, face, sources[face].from[k]);
      }
    }
  }

 private:
  /// Of an imposed face: the fine faces, and whether a mirror cancels the flux of momentum along it.
  struct Source {
    int n = 0;
    std::array<std::size_t, 3> from{};
    std::array<double, 3> weight{};
    bool mirrored = false;
  };
  /// A face of the coarse lattice, and the same one between points of the lattice.
  struct CoarseFace {
    int i, j, real_i, real_j;
  };
  std::vector<Source> along_, between_;

  static std::vector<CoarseFace> rim(const CellMask& covered, int direction);
  static std::vector<Source> link(const std::vector<CoarseFace>& faces, int direction,
                                  const LatticeShape& fine, const Ends& ends, FaceList& noted);
};

}  // namespace fsi::fluid
