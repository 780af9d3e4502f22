#pragma once
/// Which runs are going on: the launcher keeps one small JSON file per run of this user.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace fsi::monitor {

struct RunEntry {
  std::string run;         ///< identity on the bus
  std::string name;        ///< the case
  std::string dir;         ///< folder of the results
  int pid = 0;             ///< the launcher
  std::uint64_t born = 0;  ///< start time of its process in clock ticks since boot; 0: not told
  std::string key{};       ///< of the run; never shown, never recorded
  std::string network{};   ///< where its programs meet, if they are on several machines (bus::BusOptions)
  std::vector<std::string> participants{};  ///< who will speak; empty: not told
};

/// Where the launcher puts the entries: amp-fsi in $XDG_RUNTIME_DIR or /run/user/UID when it can write there,
/// else
/// ~/.cache/amp-fsi/HOST, else /tmp/amp-fsi-UID. A folder in
/// which others may make a name first is the last resort.
std::filesystem::path registry_folder();

/// Entries in this folder whose launcher lives, in the order of their names. Unreadable files are passed
/// over, and a folder of somebody else.
std::vector<RunEntry> running_runs(const std::filesystem::path& folder);

/// The entries that `wanted` may mean: all for "", else those with this identity, folder, case, or else those
/// whose identity begins so.
std::vector<RunEntry> matching(const std::vector<RunEntry>& entries, const std::string& wanted);

}  // namespace fsi::monitor
