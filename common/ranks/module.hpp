#pragma once
/// What the module with MPI in it offers.

#include "common/ranks/ranks.hpp"

namespace fsi {

/// Makes the ranks of this process, which its caller owns.
using OpenRanks = Ranks*();
inline constexpr const char* open_ranks_symbol = "fsi_open_ranks";
/// File beside the programs.
inline constexpr const char* ranks_module = "libfsi_ranks_mpi.so";

}  // namespace fsi
