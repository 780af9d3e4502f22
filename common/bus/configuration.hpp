#pragma once
/// How Cyclone DDS is set up for lock-step exchange, on one machine or between several.

#include <string>

namespace fsi::bus {

inline constexpr const char* more_settings = "AMP_FSI_CYCLONEDDS";  ///< for who looks into the bus: tracing

/// Programs that one machine has ports for in a domain, monitors included; a run may have 81 with 64 solids in 16 gases.
inline constexpr int places_in_a_domain = 120;

/// The configuration of a run's domain: no multicast, the run as discovery tag; without a `network`
/// (BusOptions) loopback only, with large fragments, else the interface of its first address, with fragments
/// that fit into a packet of a network, and all its addresses as peers. What the environment variable
/// `more_settings` says comes after it and wins; CYCLONEDDS_URI, which is meant for other programs, is not read.
std::string configuration_xml(const std::string& run, double participant_lease_s, const std::string& network);

}  // namespace fsi::bus
