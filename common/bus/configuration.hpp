#pragma once
/// How Cyclone DDS is set up for lock-step exchange on one machine.

#include <string>

namespace fsi::bus {

/// The configuration of a run's domain: loopback only, no multicast, large fragments, the run as discovery
/// tag. What the environment variable CYCLONEDDS_URI says comes after it and wins.
std::string configuration_xml(const std::string& run, double participant_lease_s);

}  // namespace fsi::bus
