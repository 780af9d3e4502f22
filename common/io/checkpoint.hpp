#pragma once
/// Checkpoints: everything a run needs to go on as if it had never ended.
///
///   DIR/checkpoints/00000400/fluid.h5 ...     one file per program, all of the same step; a program of
///                                             somebody else's may leave NAME.state, in a format of its own
///   DIR/checkpoints/00000400/manifest.json    written last: the set is complete, and these are its checksums
///
/// Files are written to a temporary one, synced and renamed. The last two complete sets are kept; other folders
/// than those whose names are digits, and links, are somebody else's and stay as they are.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/core/archive.hpp"

namespace fsi::io {

/// Where a run stands between two steps.
struct Standing {
  std::uint64_t step = 0;
  double t = 0;   ///< time after that step [time]
  double dt = 0;  ///< its size [time]
};

/// What must be the same for a program that goes on with the state of another one.
struct CheckpointOrigin {
  std::string participant;
  std::string case_digest;  ///< of all of the case that must not change
  std::string build;        ///< of the program's executable
  std::string processor;    ///< instruction sets that libraries choose their code by
};

/// Folder of a set.
std::string checkpoint_folder(const std::string& run_dir, std::uint64_t step);

/// Writes one program's file of a set. @throws OutputFailed
void write_checkpoint(const std::string& run_dir, const CheckpointOrigin& origin, const Standing& at,
                      const Archive& state);

struct LoadedCheckpoint {
  Standing at;
  Archive state;
};

/// Reads one program's file of the set in `folder`. @throws OutputFailed where it is damaged or the set is
/// not complete; UserMistake where it belongs to another case, build or processor, saying which
LoadedCheckpoint read_checkpoint(const std::string& folder, const CheckpointOrigin& reader);

/// Makes a set complete once all its files are there, and removes all sets but this one and the one before.
/// @returns the participants that left no file: the set is removed @throws OutputFailed
std::vector<std::string> complete_checkpoint(const std::string& run_dir, const Standing& at,
                                             std::span<const std::string> participants,
                                             const std::string& case_digest);

}  // namespace fsi::io
