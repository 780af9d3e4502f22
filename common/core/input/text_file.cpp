#include "common/core/input/text_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace fsi {

namespace {

std::string reason(int code) {
  return std::error_code(code, std::generic_category()).message();
}

/// Closes itself.
class Descriptor {
 public:
  /// Does not wait for anybody to write into a pipe.
  explicit Descriptor(const std::string& path)
      : fd_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

/// Bytes a character that begins with `lead` has; 0 where none begins so.
std::size_t length_of(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xc2 && lead < 0xe0) return 2;
  if (lead >= 0xe0 && lead < 0xf0) return 3;
  return lead >= 0xf0 && lead < 0xf5 ? 4 : 0;
}

/// Range of the second byte, where overlong forms, surrogates and numbers beyond Unicode are left out.
bool fits_second(unsigned char lead, unsigned char second) {
  if (lead == 0xe0) return second >= 0xa0 && second < 0xc0;
  if (lead == 0xed) return second >= 0x80 && second < 0xa0;
  if (lead == 0xf0) return second >= 0x90 && second < 0xc0;
  if (lead == 0xf4) return second >= 0x80 && second < 0x90;
  return (second & 0xc0) == 0x80;
}

}  // namespace

std::string kind_of_no_file(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  switch (fs::status(path, error).type()) {
    case fs::file_type::regular:
      return "";
    case fs::file_type::directory:
      return "a folder";
    case fs::file_type::character:
    case fs::file_type::block:
      return "a device";
    case fs::file_type::fifo:
      return "a pipe";
    case fs::file_type::socket:
      return "a socket";
    default:
      return fs::is_symlink(fs::symlink_status(path, error)) ? "a link that leads nowhere" : "";
  }
}

TextFile read_text_file(const std::string& path, std::size_t most_bytes) {
  if (const std::string kind = kind_of_no_file(path); !kind.empty()) return {"", "is " + kind};
  const Descriptor file(path);
  if (file.get() < 0) return {"", "cannot be read: " + reason(errno)};
  struct stat now {};
  if (::fstat(file.get(), &now) != 0 || !S_ISREG(now.st_mode)) return {"", "is no file"};
  TextFile result;
  std::array<char, 65536> part{};
  for (;;) {
    const ssize_t count = ::read(file.get(), part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return {"", "cannot be read: " + reason(errno)};
    if (count == 0) return result;
    result.text.append(part.data(), static_cast<std::size_t>(count));
    if (result.text.size() > most_bytes) return {"", fmt::format("is longer than {} bytes", most_bytes)};
  }
}

std::size_t first_bad_byte(const std::string& text) {
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(text[at]); };
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t length = length_of(byte(at));
    if (byte(at) == 0 || length == 0 || at + length > text.size()) return at;
    if (length > 1 && !fits_second(byte(at), byte(at + 1))) return at;
    for (std::size_t k = 2; k < length; ++k) {
      if ((byte(at + k) & 0xc0) != 0x80) return at;
    }
    at += length;
  }
  return at;
}

}  // namespace fsi
