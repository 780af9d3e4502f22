#pragma once
/// From the validated tree to the typed case.

#include <cstddef>

#include "common/case/case.hpp"
#include "common/case/document/scope.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Whether the name of a case, a part of the names of files, may hold it: letters, digits and _ . -
bool fits_case_name(char c);
/// Names of files have 255 characters at most; time, pid and endings are added to that of the case.
inline constexpr std::size_t longest_case_name = 100;

/// Fills a Case from a tree that `validate` has passed. @throws
/// UserMistake where two keys do not fit together
Case build_case(const config::Node& root, const Scope& scope);

}  // namespace fsi
