#include "common/io/checksum.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cstddef>
#include <fstream>
#include <vector>

#include "common/core/failure.hpp"

namespace fsi::io {

Checksum checksum_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw OutputFailed(fmt::format("cannot read '{}'", path));
  constexpr std::size_t chunk = std::size_t{1} << 20;
  std::vector<char> buffer(chunk);
  Checksum sum;
  while (file) {
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    const auto got = static_cast<std::size_t>(file.gcount());
    sum.crc32 =
        static_cast<std::uint32_t>(crc32_z(sum.crc32, reinterpret_cast<const Bytef*>(buffer.data()), got));
    sum.bytes += got;
  }
  if (!file.eof()) throw OutputFailed(fmt::format("cannot read '{}'", path));
  return sum;
}

}  // namespace fsi::io
