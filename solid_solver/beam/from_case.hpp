#pragma once
/// What a case file says about a solid, as a beam.

#include <vector>

#include "common/case/case.hpp"
#include "solid_solver/beam/motion.hpp"
#include "solid_solver/beam/skin.hpp"

namespace fsi::beam {

struct BeamFromCase {
  BeamMotion motion;
  std::vector<Skin> skins;  ///< one for each gas; one of a beam alone
  bool meets_gas = false;
};

/// Line, sections and supports of `spec.beam`; the outlines are that of its shape, or the interface sides of its
/// grid. What holds on the other sides is said by `ends`, and schemes of continua have no meaning for it:
/// neither is looked at.
/// @throws UserMistake for conditions a beam cannot meet
BeamFromCase beam_from_case(const SolidSpec& spec);

}  // namespace fsi::beam
