#pragma once
/// What a case needs of the machine's memory, and whether it has it: known before anything is made.

#include <limits>
#include <string>
#include <vector>

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// What one program needs at its peak.
struct MemoryNeed {
  std::string program;  ///< "fluid", or the name of a gas or a solid
  double points = 0;    ///< of all its grids [-]
  double bytes = 0;     ///< [byte]
};

/// Of every program whose grids the case describes; without those of an external solid.
std::vector<MemoryNeed> memory_of(const Case& problem);

/// Of all programs together [byte].
double total_memory(const Case& problem);

/// "3.2 GB"
std::string bytes_text(double bytes);

inline constexpr double unlimited_memory = std::numeric_limits<double>::infinity();

/// What programs that are started now can have [byte]: MemAvailable of `meminfo`, or less where a control
/// group of this process allows less.
double available_memory();

/// load_case of a case that may not need more than `available`. @throws UserMistake
Case load_case_within(double available, const std::string& path,
                      const std::vector<std::string>& overrides = {},
                      const std::vector<std::string>& laws = {});

/// @throws UserMistake at the largest grid where the case needs more than `available`
void check_memory(const Case& problem, const config::Node& root, double available);

}  // namespace fsi
