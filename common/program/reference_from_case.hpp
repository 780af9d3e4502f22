#pragma once
/// The reference solution a case names: initial data, boundary data and the yardstick of the errors.

#include <memory>
#include <string>

#include "common/case/case.hpp"
#include "common/exact/solution.hpp"

namespace fsi {

/// Null where the case has none, or one that only the solid can build (`manufactured` without a gas).
/// @throws UserMistake for an unknown kind @throws OutputFailed when a table of `run_dir` cannot be read
std::shared_ptr<const exact::Solution> reference_from_case(const Case& problem, const std::string& run_dir);

}  // namespace fsi
