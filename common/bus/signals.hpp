#pragma once
/// Ctrl-C and SIGTERM end a program in order.

namespace fsi::bus {

/// From now on SIGINT and SIGTERM are only remembered.
void catch_signals();
/// Number of the first signal caught, 0 if none. Fits BusOptions::interrupted.
int caught_signal() noexcept;

}  // namespace fsi::bus
