#pragma once
/// Beams whose line, sections and ends fit their outlines.

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// The line of a beam lies in its body, the body has a thickness along it, and where its outline ends on a wall
/// the section there stays on that wall. @throws UserMistake where not
void check_beams(const Case& problem, const config::Node& root);

}  // namespace fsi
