#pragma once
/// A run's state as text for a terminal.

#include <string>
#include <vector>

#include "monitor/state.hpp"

namespace fsi::monitor {

/// Size of a terminal in characters.
struct Extent {
  int columns = 80;
  int rows = 24;
};

/// The table, at most `extent.rows` lines of at most `extent.columns` characters.
std::vector<std::string> table(const RunState& state, double now, Extent extent);

/// The state in one line, for pipes.
std::string plain_line(const RunState& state);

/// Seconds as 12 s, 3 min 05 s or 2 h 10 min.
std::string duration_text(double seconds);

}  // namespace fsi::monitor
