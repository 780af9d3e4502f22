#pragma once
/// Outlines that cross themselves: they have no inside, and no grid along them can be laid.

#include <string>

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// @param shape what describes the curve in the file, with its points
/// @param path  its key
/// @throws UserMistake with the place at which the curve meets itself, and the lines of the list that cross
void refuse_own_crossing(const CurveSpec& curve, const config::Node& shape, const std::string& path);

}  // namespace fsi
