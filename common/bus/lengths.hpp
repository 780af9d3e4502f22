#pragma once
/// Whether the arrays of a message have the lengths its interface
/// asks for. Nobody indexes an array unchecked.

#include <cstddef>
#include <cstdint>

#include "common/wire/messages.hpp"

namespace fsi::bus {

/// Points and dimensions of an interface.
struct InterfaceSize {
  std::size_t points = 0;
  std::size_t dimension = 0;
};

/// Size announced by a hello.
/// @throws PeerLost naming `from` when the dimension is not 1, 2 or 3 or the positions do not divide by it
InterfaceSize size_of(const wire::InterfaceInfo& info, const std::string& from);

/// @throws PeerLost naming sender, interface and array when one is neither empty nor as long as it must be
void check_lengths(const wire::PredictedInterface& predicted, InterfaceSize size);
void check_lengths(const wire::ProjectedInterface& projected, InterfaceSize size);

/// Whether all arrays of a picture have the lengths its grids say, within bounds, and all its numbers are
/// finite: it may come from anybody.
bool is_sound(const wire::Picture& picture);

}  // namespace fsi::bus
