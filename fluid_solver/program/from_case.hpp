#pragma once
/// A gas as a case describes it, at its start: the same on every rank.

#include <memory>

#include "common/case/case.hpp"
#include "common/exact/solution.hpp"
#include "fluid_solver/gas_solver.hpp"

namespace fsi::fluid {

/// The gas of a solution.
StateField field_of(std::shared_ptr<const exact::Solution> solution);

/// Whether source terms make the reference exact.
bool is_chosen(const Case& problem, const std::shared_ptr<const exact::Solution>& reference);

/// Whether a budget of the gas can be drawn up: it needs to know all that passes its boundary, so bodies away
/// from it, and no sources.
bool has_budget(const Case& problem, const FluidSpec& spec,
                const std::shared_ptr<const exact::Solution>& reference);

/// The gas with its initial state. @throws UserMistake, Diverged
GasSolver gas_at_start(const Case& problem, const FluidSpec& spec,
                       const std::shared_ptr<const exact::Solution>& reference);

}  // namespace fsi::fluid
