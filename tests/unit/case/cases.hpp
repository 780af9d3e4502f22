#pragma once
/// Case files for the tests: written to a folder of their own, removed at the end.

#include <filesystem>
#include <string>
#include <vector>

#include "common/case/case.hpp"

namespace fsi::tests {

/// A folder that vanishes with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  /// Writes a file; returns its path.
  std::string write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

/// Paths of all files in configs/.
std::vector<std::string> config_paths();

std::string text_of_file(const std::string& path);

/// Loads a case written as text in a file case.yaml.
Case load_text(const std::string& text, const std::vector<std::string>& overrides = {},
               const std::vector<std::string>& laws = {});

/// The message of the mistake that loading the text is, folder names left out: "case.yaml:3:5: ..."; "" where
/// it is fine.
std::string mistake_in(const std::string& text, const std::vector<std::string>& overrides = {},
                       const std::vector<std::string>& laws = {});

/// Of this process [s].
double processor_time();

}  // namespace fsi::tests
