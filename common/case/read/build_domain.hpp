#pragma once
/// Grids and boundaries, which gas and solids have in common.

#include <array>
#include <string>

#include "common/case/case.hpp"
#include "common/case/document/reader.hpp"

namespace fsi {

/// Who a grid and its boundaries belong to.
struct Owner {
  const config::Node& node;  ///< section `fluid`, `fluids.NAME` or `solids.NAME`
  std::string name;          ///< "fluid", or the name of a gas or a solid
  std::string path;          ///< for messages
  std::string partner;       ///< gas: the solid that a bare `interface` means, "" where there is not one
  bool is_gas = false;
};

/// @throws UserMistake
GridSpec build_grid(const Reader& reader, const Owner& owner);

/// What a node under `boundary` says of one side. @throws UserMistake
BoundarySpec build_boundary(const Reader& reader, const Owner& owner, const config::Node& node,
                            const std::string& path);

/// The four sides; `grid` learns where it is periodic. @throws UserMistake
std::array<BoundarySpec, 4> build_boundaries(const Reader& reader, const Owner& owner, GridSpec& grid);

}  // namespace fsi
