#pragma once
/// What else a case file could say where its grids do not fit: changes that are tried before they are named.

#include <functional>
#include <optional>

#include "common/case/grids/no_grids_fit.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// What became of a case with another choice.
struct TriedCase {
  bool valid = false;
  std::optional<NoGridsFit::Parts> left = {};  ///< grids of it that still do not fit
};

/// Tries one change of the case after the other: those that the mistake brings, numbers of grids left out (they
/// are then chosen), for a gas sharp corners of outlines without an inside and grid.factor twice and four times what
/// it is, rounder corners (as they are where the file says nothing, then from large radii to small ones), for a gas
/// numbers left out and a finer grid at once, a rigid body that is held. Where a change mends one body and grids of
/// another do not fit then, it is tried at both in the end, and so on.
/// @param root   the case as it was written, with what the command line says
/// @param factor grid.factor of the case [-]
/// @param tried  what becomes of a case with such a tree
/// @returns the mistake with the first change that is, or with what was tried in vain
UserMistake with_remedy(const NoGridsFit& mistake, const config::Node& root, double factor,
                        const std::function<TriedCase(const config::Node&)>& tried);

}  // namespace fsi
