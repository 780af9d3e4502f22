#pragma once
/// What to write where the grids of a body cannot be marched or connected.

#include <string>

#include "common/case/check/check_overlap.hpp"

namespace fsi {

/// The remedy, and the key that it changes.
struct Advice {
  const config::Node& node;
  std::string path;
  std::string text;       ///< what to write
  std::string fact = {};  ///< what was found
  double missing = 0;     ///< of a distance that is too short [length]
  bool tried = false;     ///< the grids connect with what `text` says
};

/// Looks for what is too near for the grids, then tries finer spacings and fewer lines.
/// @param check grids that cannot be marched or connected as they are
Advice advice_for(const OverlapCheck& check);

}  // namespace fsi
