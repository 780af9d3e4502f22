#pragma once
/// The description of the case file as a JSON Schema (draft 7), for editors.

#include <string>

namespace fsi {

/// Knows keys, kinds, words, ranges and shapes; what only `fsi_case check` knows (formulas, places, what fits
/// together) it lets pass.
std::string case_file_json_schema();

}  // namespace fsi
