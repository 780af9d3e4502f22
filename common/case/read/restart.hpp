#pragma once
/// What of a case a restart may change: how long it runs, what
/// it writes, what it expects. All else decides about numbers.

#include <string>
#include <vector>

#include "common/core/input/config.hpp"

namespace fsi {

/// The part of a case that must stay the same.
config::Node fixed_part(const config::Node& root);

/// "time.cfl: 0.8, was 0.9" for every entry that two trees do not share.
std::vector<std::string> differences(const config::Node& before, const config::Node& now);

/// Compares a resolved case with that of a former run, which is in the file `former`.
/// @throws UserMistake saying what differs
void check_restart(const std::string& resolved, const std::string& former);

}  // namespace fsi
