#pragma once
/// Pictures of fields for whoever watches a run: one quantity on the component grids, at so few points that
/// it costs next to nothing. Nothing of the state is changed.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/io/grid_writer.hpp"
#include "common/wire/messages.hpp"

namespace fsi {

/// A picture is at most about so large [byte]: it then fits into the receive buffer of a stock kernel.
inline constexpr std::size_t largest_picture = 160 << 10;

/// The fields that a quantity is made of; none of one that is not known.
const std::vector<std::string>& planes_of(const std::string& quantity);

/// A quantity of `wire::Picture` on these grids: "pressure", "density", "speed" |v|, "stress" |P| (the root
/// of the sum of squares of the nominal stress), "schlieren" |grad rho| (largest among the points a sample
/// stands for). Nothing where the fields do not have what it is made of. Of n points along a direction every
/// k-th is a sample, and the last; k is 1 where the grids are small. A sample that is an unused point has the
/// value of the nearest point less than k away that is used, and no value without one.
std::optional<wire::Picture> picture_of(std::span<const io::GridOutput> grids, const std::string& quantity);

/// Levels of the samples' values, one vector per grid, and what they stand for; numbers that are not finite
/// have no value.
void set_levels(wire::Picture& picture, std::span<const std::vector<double>> values);

}  // namespace fsi
