#pragma once
/// The reference of the case file, written from the schema.

#include <string>

namespace fsi {

/// docs/case_file.md, whole.
std::string case_file_document();

}  // namespace fsi
