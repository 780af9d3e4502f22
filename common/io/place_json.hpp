#pragma once
/// Where something failed, as the reports and summary.json write it (docs/output.md).

#include <nlohmann/json_fwd.hpp>

#include "common/core/failure.hpp"

namespace fsi::io {

/// {step, t, program, interface, grid, point, position or reference_position}; without what is not known.
nlohmann::ordered_json to_json(const Place& place);

/// Reads them again; null counts as not known. @throws nlohmann::json::exception where one is no such thing
Place place_of(const nlohmann::json& object);

}  // namespace fsi::io
