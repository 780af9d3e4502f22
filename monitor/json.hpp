#pragma once
/// A run's state for scripts, for the page in the browser and for Prometheus.

#include <string>

#include "monitor/state.hpp"

namespace fsi::monitor {

/// Everything known now as one JSON object (README.md lists the keys).
std::string to_json(const RunState& state, double now);

/// What was: {"history": {name: [[t, value], ...]}, "timeline": {program: [[seconds ago, share], ...]}}.
std::string history_json(const RunState& state, double now);

/// The numbers of the state in the text format of Prometheus.
std::string to_prometheus(const RunState& state, double now);

}  // namespace fsi::monitor
