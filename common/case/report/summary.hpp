#pragma once
/// What the launcher and a person need to know about a case.

#include <string>
#include <utility>
#include <vector>

#include "common/case/case.hpp"

namespace fsi {

/// A program of the run.
struct ParticipantSummary {
  std::string name, role, executable, law;
};

/// Gas, solids, and the coupler where there is something to couple.
std::vector<ParticipantSummary> participants_of(const Case& problem);

/// True where a gas meets a solid.
bool is_coupled(const Case& problem);

/// One JSON object: name, title, path, digest, restart_digest, resolved, coupled, fluid, participants,
/// solids, grid_factor, time, interface, output, reference, expect.
std::string summary_as_json(const Case& problem);

/// One line for a person.
std::string summary_line(const Case& problem);

/// Name and title of every case in a folder; a file that cannot be read has its mistake as title.
std::vector<std::pair<std::string, std::string>> list_cases(const std::string& folder);

}  // namespace fsi
