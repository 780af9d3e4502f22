#pragma once
/// Checks a tree against the schema and evaluates its numbers in place.

#include "common/case/document/scope.hpp"
#include "common/case/schema/schema.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Every key known, every value of its type and in its range; numbers become their values, formulas are
/// compiled once to see that they are right but stay text.
/// @throws UserMistake with place, key, what is wrong and what to write
void validate(config::Node& root, const schema::Section& section, const Scope& scope);

}  // namespace fsi
