#pragma once
/// The checksum of a file, to find out whether it is still what was written.

#include <cstdint>
#include <string>

namespace fsi::io {

struct Checksum {
  std::uint64_t bytes = 0;
  std::uint32_t crc32 = 0;  ///< of zlib: 0 of nothing

  bool operator==(const Checksum&) const = default;
};

/// @throws OutputFailed where the file cannot be read
Checksum checksum_of(const std::string& path);

}  // namespace fsi::io
