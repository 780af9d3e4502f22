#pragma once
/// What a case file says about a solid, as a beam.

#include "common/case/case.hpp"
#include "solid_solver/beam/motion.hpp"
#include "solid_solver/beam/skin.hpp"

namespace fsi::beam {

struct BeamFromCase {
  BeamMotion motion;
  Skin skin;
  bool meets_gas = false;
};

/// Line, sections and supports of `spec.beam`; the outline is that of its shape, or the interface side of its
/// grid. What holds on the other sides is said by `ends`, and schemes of continua have no meaning for it:
/// neither is looked at.
/// @throws UserMistake for conditions a beam cannot meet
BeamFromCase beam_from_case(const SolidSpec& spec);

}  // namespace fsi::beam
