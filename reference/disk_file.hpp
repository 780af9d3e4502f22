#pragma once
/// The file a run of the rotating disk leaves, read back by exact::DiskTable.

#include <string>
#include <vector>

#include "reference/disk_chain.hpp"

namespace fsi::reference {

/// Largest of each quantity over several differences.
Difference largest(const std::vector<Difference>& all);

/// Errors of `fine` at each output time that both have, from a run with half the points: a second-order
/// scheme with half the points is four times as wrong, so the difference is three times the error.
std::vector<Difference> estimated_errors(const std::vector<DiskOutput>& fine,
                                         const std::vector<DiskOutput>& half);

/// Writes a group per output: fields, conserved totals and estimated
/// errors; and why the run ended early, if it did.
/// @throws OutputFailed when the file cannot be written
void write_disk_table(const std::string& path, const DiskRun& run, const std::vector<Difference>& errors);

}  // namespace fsi::reference
