#pragma once
/// A law as the solid program takes it: what it says of it, and its solver.

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/grid/overlap/composite_grid.hpp"
#include "solid_solver/any_solid_solver.hpp"
#include "solid_solver/laws/any_law.hpp"
#include "solid_solver/solid_part.hpp"

namespace fsi::solid {

/// What a case says of a solid's material.
struct LawNumbers {
  double lambda = 0, mu = 0;                 ///< [pressure]
  const std::map<std::string, double>& own;  ///< what the law takes besides, by their keys
};

struct LawKind {
  std::string_view name;
  bool softens = false;  ///< carries no waves beyond some strain, and another law does
  AnyLaw (*law)(const LawNumbers& numbers);
  /// A body at t = 0; parameters and errors are those of SolidSolver.
  std::unique_ptr<AnySolidSolver> (*solver)(std::vector<SolidPart> parts,
                                            std::vector<grid::BodyFittedGrid> bodies,
                                            const LawNumbers& numbers, const SolidOptions& options);
};

/// Compiled with the law's solver (law_solver.cpp.in).
template <Law L>
LawKind law_kind();

}  // namespace fsi::solid
