#include "monitor/registry.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "common/bus/peers/peer.hpp"

namespace fsi::monitor {

namespace {

namespace fs = std::filesystem;

/// Another process may have its number by now.
bool lives(const RunEntry& launcher) {
  if (launcher.pid <= 0) return false;
  if (launcher.born != 0) return bus::start_time(launcher.pid) == launcher.born;
  return kill(launcher.pid, 0) == 0 || errno == EPERM;
}

bool is_own_folder(const fs::path& folder) {
  struct stat found {};
  return stat(folder.c_str(), &found) == 0 && S_ISDIR(found.st_mode) && found.st_uid == getuid() &&
         access(folder.c_str(), W_OK) == 0;
}

std::string variable(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody sets it here
  return value == nullptr ? "" : value;
}

/// What others left under a name of ours says nothing.
bool is_ours(const fs::path& folder) {
  struct stat found {};
  return lstat(folder.c_str(), &found) == 0 && S_ISDIR(found.st_mode) && found.st_uid == getuid();
}

std::optional<RunEntry> read_entry(const fs::path& path) {
  std::ifstream file(path);
  const auto entry = nlohmann::json::parse(file, nullptr, false);
  if (!entry.is_object()) return std::nullopt;
  try {
    return RunEntry{.run = entry.at("run").get<std::string>(),
                    .name = entry.value("case", ""),
                    .dir = entry.value("dir", ""),
                    .pid = entry.at("pid").get<int>(),
                    .born = entry.value("born", std::uint64_t{0}),
                    .key = entry.value("key", ""),
                    .network = entry.value("network", ""),
                    .participants = entry.value("participants", std::vector<std::string>{})};
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

}  // namespace

fs::path registry_folder() {
  for (const std::string& runtime : {variable("XDG_RUNTIME_DIR"), fmt::format("/run/user/{}", getuid())}) {
    if (!runtime.empty() && is_own_folder(runtime)) return fs::path(runtime) / "amp-fsi";
  }
  if (const std::string home = variable("HOME"); !home.empty() && is_own_folder(home))
    return fs::path(home) / ".cache" / "amp-fsi" / bus::host_name();
  return fmt::format("/tmp/amp-fsi-{}", getuid());
}

std::vector<RunEntry> running_runs(const fs::path& folder) {
  std::vector<RunEntry> entries;
  if (!is_ours(folder)) return entries;
  std::error_code none;
  for (const auto& file : fs::directory_iterator(folder, none)) {
    if (file.path().extension() != ".json") continue;
    const auto entry = read_entry(file.path());
    if (entry && lives(*entry)) entries.push_back(*entry);
  }
  std::ranges::sort(entries, {}, &RunEntry::run);
  return entries;
}

std::vector<RunEntry> matching(const std::vector<RunEntry>& entries, const std::string& wanted) {
  if (wanted.empty()) return entries;
  const auto select = [&](const std::function<bool(const RunEntry&)>& fits) {
    std::vector<RunEntry> selected;
    std::ranges::copy_if(entries, std::back_inserter(selected), fits);
    return selected;
  };
  std::error_code none;
  auto found =
      select([&](const RunEntry& e) { return e.run == wanted || fs::equivalent(e.dir, wanted, none); });
  if (found.empty()) found = select([&](const RunEntry& e) { return e.name == wanted; });
  if (found.empty()) found = select([&](const RunEntry& e) { return e.run.starts_with(wanted); });
  return found;
}

}  // namespace fsi::monitor
