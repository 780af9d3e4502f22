#include "common/io/checksum.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <fstream>
#include <vector>

#include "common/core/failure.hpp"

namespace fsi::io {

namespace {

constexpr std::size_t slices = 8;  ///< bytes per step of the loop
using Tables = std::array<std::array<std::uint32_t, 256>, slices>;

/// tables[k][b]: what byte b does to the remainder k bytes later.
constexpr Tables make_tables() {
  Tables tables{};
  for (std::uint32_t b = 0; b < 256; ++b) {
    std::uint32_t rest = b;
    for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1) ^ ((rest & 1) != 0 ? 0xEDB88320U : 0U);
    tables[0][b] = rest;
  }
  for (std::size_t k = 1; k < slices; ++k) {
    for (std::size_t b = 0; b < 256; ++b)
      tables[k][b] = (tables[k - 1][b] >> 8) ^ tables[0][tables[k - 1][b] & 0xFF];
  }
  return tables;
}

constexpr Tables tables = make_tables();

std::uint32_t continued(std::uint32_t rest, const char* data, std::size_t size) {
  const auto byte = [&](std::size_t k) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(data[k]));
  };
  for (; size >= slices; data += slices, size -= slices) {
    const std::uint32_t low = rest ^ (byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24);
    rest = tables[7][low & 0xFF] ^ tables[6][(low >> 8) & 0xFF] ^ tables[5][(low >> 16) & 0xFF] ^
           tables[4][low >> 24] ^ tables[3][byte(4)] ^ tables[2][byte(5)] ^ tables[1][byte(6)] ^
           tables[0][byte(7)];
  }
  for (std::size_t k = 0; k < size; ++k) rest = (rest >> 8) ^ tables[0][(rest ^ byte(k)) & 0xFF];
  return rest;
}

}  // namespace

Checksum checksum_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw OutputFailed(fmt::format("cannot read '{}'", path));
  constexpr std::size_t chunk = std::size_t{1} << 20;
  std::vector<char> buffer(chunk);
  Checksum sum;
  std::uint32_t rest = 0xFFFFFFFFU;
  while (file) {
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    const auto got = static_cast<std::size_t>(file.gcount());
    rest = continued(rest, buffer.data(), got);
    sum.bytes += got;
  }
  if (!file.eof()) throw OutputFailed(fmt::format("cannot read '{}'", path));
  sum.crc32 = rest ^ 0xFFFFFFFFU;
  return sum;
}

}  // namespace fsi::io
