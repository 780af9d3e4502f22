#pragma once
/// Which runs are going on: the launcher keeps one small JSON file per run of this user.

#include <filesystem>
#include <string>
#include <vector>

namespace fsi::monitor {

struct RunEntry {
  std::string run;    ///< identity on the bus
  std::string name;   ///< the case
  std::string dir;    ///< folder of the results
  int pid = 0;        ///< the launcher
  std::string key{};  ///< of requests to the run; never shown, never recorded
};

/// Where the entries lie: $XDG_RUNTIME_DIR/amp-fsi when there is one, else /tmp/amp-fsi-UID.
std::vector<std::filesystem::path> registry_folders();

/// Entries in these folders whose launcher lives, in the order of their names. Unreadable files are passed
/// over, and folders of somebody else.
std::vector<RunEntry> running_runs(const std::vector<std::filesystem::path>& folders);

/// The entries that `wanted` may mean: all for "", else those with this identity, folder, case, or else those
/// whose identity begins so.
std::vector<RunEntry> matching(const std::vector<RunEntry>& entries, const std::string& wanted);

}  // namespace fsi::monitor
