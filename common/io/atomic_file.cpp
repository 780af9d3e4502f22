#include "common/io/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "common/core/failure.hpp"

namespace fsi::io {

namespace {

[[noreturn]] void fail(const std::string& what, const std::string& path, int error) {
  throw OutputFailed(fmt::format("{} '{}': {}; check the directory, its permissions and the free space", what,
                                 path, std::strerror(error)));
}

/// Owner of a file descriptor.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags) : value_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  int get() const { return value_; }

 private:
  int value_;
};

void sync(const std::string& path, int flags) {
  const Descriptor file(path, flags);
  if (file.get() < 0) fail("cannot open", path, errno);
  if (::fsync(file.get()) != 0) fail("cannot sync", path, errno);
}

}  // namespace

void make_directory(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) fail("cannot create the directory", path, error.value());
}

std::string aside(const std::string& path) {
  return path + ".part";
}

void rename_into_place(const std::string& path) {
  const std::string from = aside(path);
  sync(from, O_RDWR);
  if (::rename(from.c_str(), path.c_str()) != 0) fail("cannot write", path, errno);
  const auto directory = std::filesystem::path(path).parent_path().string();
  sync(directory.empty() ? "." : directory, O_RDONLY | O_DIRECTORY);
}

void write_atomically(const std::string& path, const std::string& text) {
  const std::string temporary = aside(path);
  {
    const Descriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
    if (file.get() < 0) fail("cannot create", temporary, errno);
    std::string_view rest = text;
    while (!rest.empty()) {
      const auto written = ::write(file.get(), rest.data(), rest.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail("cannot write", temporary, errno);
      rest.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  rename_into_place(path);
}

}  // namespace fsi::io
