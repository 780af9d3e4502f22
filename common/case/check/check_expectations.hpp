#pragma once
/// Whether what a case expects of its run can be there.

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Every quantity that is expected is one that a summary.json
/// may have, as far as that is known before the run.
/// @throws UserMistake
void check_expectations(const Case& problem, const config::Node& root);

}  // namespace fsi
