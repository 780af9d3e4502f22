#pragma once
/// Ways to follow a run until it ends: on a terminal, line by line, or once.

#include <optional>
#include <vector>

#include "monitor/source.hpp"
#include "monitor/state.hpp"
#include "monitor/web/server.hpp"

namespace fsi::monitor {

/// True once a signal asks this program to end.
bool interrupted();
void catch_signals();

/// On the whole terminal, with keys; afterwards the last state stays on the terminal. Line by line where the
/// terminal cannot do better.
void follow_on_terminal(Source& source, RunState& state);

/// One line per second, and one whenever the status changes.
void follow_plain(Source& source, RunState& state, bool json);

/// In browsers; goes on after the end of the run, so that it can be looked at, until a signal ends it.
void follow_web(Source& source, RunState& state, const WebOptions& options);

/// The run a person chooses on the terminal; none when they leave.
std::optional<RunEntry> choose_on_terminal(const std::vector<RunEntry>& runs);

}  // namespace fsi::monitor
