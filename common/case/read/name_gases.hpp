#pragma once
/// Which gas is on the other side of a solid's interfaces.

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Names the gas at every interface of every solid that does not name it itself: the one gas that names the
/// solid. Where no gas does, the name stays empty, which a check refuses.
/// @throws UserMistake where several gases do
void name_gases(Case& problem, const config::Node& root);

}  // namespace fsi
