#pragma once
/// Start-up: which solid meets the gas where, and whether the points of both sides lie on one curve.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/wire/messages.hpp"

namespace fsi::coupler {

/// The two sides of one interface.
struct InterfacePair {
  std::string fluid, solid;  ///< participants
  std::string name;          ///< of the interface: that of the solid, or <solid>.<gas>
  std::vector<double> x;     ///< initial positions of the points of the exchange, 2 n
  std::vector<double> n0;    ///< reference normals of the solid there, 2 n
  bool periodic = false;     ///< the interface goes on beyond its ends, a period further

  /// The side with fewer points, where the two sides do not have the same ones.
  struct Coarser {
    bool is_gas = false;
    std::vector<double> x;   ///< its initial positions, 2 m
    std::vector<double> n0;  ///< reference normals of the solid there, 2 m
  };
  std::optional<Coarser> coarser = {};
};

/// All interfaces of a run, in the order of the gases' hellos. Where the points of both sides are the same, in
/// the same order and no farther apart than a thousandth of their spacing, the exchange happens at those of
/// the gas; otherwise at those of the side with more of them.
/// @param periodic names of those that go on beyond their ends, a period further
/// @throws UserMistake naming interface, point, distance and remedy where the sides are not one curve
/// @throws PeerLost when a program's hello does not make sense
std::vector<InterfacePair> match_interfaces(std::span<const wire::Hello> hellos,
                                            std::span<const std::string> periodic = {});

}  // namespace fsi::coupler
