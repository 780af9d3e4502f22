#pragma once
/// Looks at body-fitted grids before anything starts.

#include <string>
#include <vector>

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// A background with the grids before it.
struct OverlapCheck {
  const GridSpec& background;
  const std::vector<BodyFittedSpec>& body_fitted;
  const config::Node& owner;  ///< section `fluid` or `solids.NAME`
  std::string path;
};

/// The background is a rectangle, the grids can be marched from their curves without folds, and every point
/// has a donor. @throws UserMistake
void check_overlap(const OverlapCheck& check);

}  // namespace fsi
