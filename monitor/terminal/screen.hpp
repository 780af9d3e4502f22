#pragma once
/// Everything about a run on one terminal screen, from 80
/// x 24 on. Pure: a state goes in, a picture comes out.

#include <string>
#include <vector>

#include "monitor/frame.hpp"
#include "monitor/state.hpp"

namespace fsi::monitor {

/// What the person watching has chosen.
struct View {
  std::size_t interface = 0;  ///< shown in the profile; counted modulo their number
  bool braille = true;        ///< the terminal knows more than ASCII
  bool help = false;
  bool ask_stop = false;  ///< waiting for yes or no
  std::string message;    ///< in the last line instead of the keys
  std::string controls;   ///< keys that act on the run, for the last line; empty: none
};

Frame screen(const RunState& state, double now, const View& view, Extent extent);

/// List of runs to choose from.
Frame chooser(const std::vector<RunEntry>& runs, std::size_t selected, Extent extent);

/// Seconds as 12 s, 3 min 05 s or 2 h 10 min.
std::string duration_text(double seconds);

/// The state in one line, for pipes.
std::string plain_line(const RunState& state);

}  // namespace fsi::monitor
