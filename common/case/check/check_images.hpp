#pragma once
/// Sides across which a field goes on as an image of itself: mirrors, and sides that are periodic.

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// A mirror of a gas is straight and stays in its line; two periodic sides lie all the time as far from each other, in the
/// same direction, point by point. Looks at a sample of points, for the whole run where a map says where they are.
/// @throws UserMistake
void check_images(const Case& problem, const config::Node& root);

}  // namespace fsi
