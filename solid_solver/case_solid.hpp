#pragma once
/// Which solid of the case a program stands for.

#include <fmt/format.h>

#include "common/core/failure.hpp"
#include "common/program/program.hpp"

namespace fsi::solid {

/// The solid of the case this program stands for: the one named, or the only one.
inline const SolidSpec& solid_of(const Setup& setup) {
  for (const SolidSpec& spec : setup.problem.solids) {
    if (spec.name == setup.name) return spec;
  }
  throw UserMistake(fmt::format("the case has no solid \"{}\"; --name must be one of solids", setup.name));
}

}  // namespace fsi::solid
