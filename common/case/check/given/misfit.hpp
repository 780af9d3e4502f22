#pragma once
/// What keeps a fine run in one dimension (`piston_1d`, `rotating_disk`) from being one of the case.

#include <optional>
#include <string>

#include "common/case/case.hpp"

namespace fsi {

/// A key of the case, and what is wrong there.
struct Misfit {
  std::string path, text;
};

/// A gas to the right of a solid, both along x.
std::optional<Misfit> misfit_of_piston(const Case& problem);

/// The unit disk that turns in a gas at rest. It turns at first as `reference` says.
std::optional<Misfit> misfit_of_disk(const Case& problem);

/// @throws UserMistake of a misfit of the case in `file`
void expect_none(const std::optional<Misfit>& found, const std::string& file);

}  // namespace fsi
