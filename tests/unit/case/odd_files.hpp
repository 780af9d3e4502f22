#pragma once
/// What a person may name in the place of a file.

#include <sys/stat.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "tests/unit/case/cases.hpp"

namespace fsi::tests {

/// Path of a name in a folder.
inline std::string path_in(const TemporaryFolder& folder, const std::string& name) {
  const std::filesystem::path some(folder.write("some", ""));
  return (some.parent_path() / name).string();
}

/// A link that leads to itself.
inline std::string make_loop(const TemporaryFolder& folder, const std::string& name) {
  std::filesystem::create_symlink(name, path_in(folder, name));
  return path_in(folder, name);
}

/// A pipe that nobody writes to.
inline std::string make_pipe(const TemporaryFolder& folder, const std::string& name) {
  if (mkfifo(path_in(folder, name).c_str(), 0600) != 0) throw std::runtime_error("no pipe");
  return path_in(folder, name);
}

}  // namespace fsi::tests
