#pragma once
/// The numbers of a solid's law: moduli of the rest state, in any of the forms a case may write them, and
/// what only one law takes.

#include <string>

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Sets lambda, mu and the law's own numbers (`data`) of a solid whose `law` is known. Numbers that only
/// another law takes are passed over, so that `--solid NAME=LAW` can compare laws.
/// @throws UserMistake where moduli are missing, written in two forms, or outside what the law can bear
void build_material(const config::Node& solid, const std::string& path, SolidSpec& spec);

}  // namespace fsi
