#include "tests/unit/case/cases.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "common/core/failure.hpp"

namespace fsi::tests {

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "fsi_case_XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, const std::string& text) const {
  const std::string path = (path_ / name).string();
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

std::vector<std::string> config_paths() {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(FSI_ROOT "/configs")) {
    if (entry.path().extension() == ".yaml") paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string text_of_file(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

Case load_text(const std::string& text, const std::vector<std::string>& overrides,
               const std::vector<std::string>& laws) {
  const TemporaryFolder folder;
  return load_case(folder.write("case.yaml", text), overrides, laws);
}

std::string mistake_in(const std::string& text, const std::vector<std::string>& overrides,
                       const std::vector<std::string>& laws) {
  try {
    load_text(text, overrides, laws);
    return "";
  } catch (const UserMistake& mistake) {
    const std::string message = mistake.what();
    const std::size_t begin = message.find("case.yaml");
    return message.starts_with("/") && begin != std::string::npos ? message.substr(begin) : message;
  }
}

double processor_time() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace fsi::tests
