#pragma once
/// Start-up: which solid meets the gas where, and whether the points of both sides lie on each other.

#include <span>
#include <string>
#include <vector>

#include "common/wire/messages.hpp"

namespace fsi::coupler {

/// The two sides of one interface.
struct InterfacePair {
  std::string fluid, solid;  ///< participants
  std::string name;          ///< of the interface: that of the solid
  std::vector<double> x;     ///< initial positions of the gas's points, 2 n
  std::vector<double> n0;    ///< reference normals of the solid, 2 n
};

/// All interfaces of a run, in the order of the gas's hello. Each needs the same number of points on both
/// sides, in the same order, no farther apart than a thousandth of their spacing.
/// @throws UserMistake naming interface, point, distance and remedy
/// @throws PeerLost when a program's hello does not make sense
std::vector<InterfacePair> match_interfaces(std::span<const wire::Hello> hellos);

}  // namespace fsi::coupler
