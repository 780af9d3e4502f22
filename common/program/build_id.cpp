#include "common/program/build_id.hpp"

#include <elf.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <link.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>

namespace fsi {

namespace {

constexpr std::size_t aligned(std::size_t size) {
  return (size + 3) / 4 * 4;
}

/// The hash in a segment of notes; empty where there is none.
std::string hash_in(std::span<const std::byte> notes) {
  while (notes.size() >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) note;
    std::memcpy(&note, notes.data(), sizeof note);
    const std::size_t name_at = sizeof note, hash_at = name_at + aligned(note.n_namesz);
    if (note.n_type == NT_GNU_BUILD_ID && hash_at + note.n_descsz <= notes.size())
      return fmt::format("{:02x}", fmt::join(notes.subspan(hash_at, note.n_descsz), ""));
    notes = notes.subspan(std::min(notes.size(), hash_at + aligned(note.n_descsz)));
  }
  return {};
}

/// Called for every loaded object, the executable first; ends with it.
int look_into(dl_phdr_info* object, std::size_t, void* result) {
  for (ElfW(Half) k = 0; k < object->dlpi_phnum; ++k) {
    const ElfW(Phdr)& segment = object->dlpi_phdr[k];
    if (segment.p_type != PT_NOTE) continue;
    // The loader says where things are in numbers.
    // NOLINTNEXTLINE(performance-no-int-to-ptr,cppcoreguidelines-pro-type-reinterpret-cast)
    const auto* begin = reinterpret_cast<const std::byte*>(object->dlpi_addr + segment.p_vaddr);
    std::string hash = hash_in({begin, segment.p_memsz});
    if (!hash.empty()) *static_cast<std::string*>(result) = std::move(hash);
  }
  return 1;
}

}  // namespace

std::string build_id() {
  std::string id;
  dl_iterate_phdr(look_into, &id);
  return id;
}

std::string processor_kind() {
  if (__builtin_cpu_supports("avx512f") != 0) return "avx512f";
  if (__builtin_cpu_supports("avx2") != 0) return __builtin_cpu_supports("fma") != 0 ? "avx2 fma" : "avx2";
  return "sse2";
}

std::string instruction_set() {
#if defined(__AVX512F__)
  return "avx512f";
#elif defined(__AVX2__) && defined(__FMA__)
  return "avx2 fma";
#elif defined(__AVX2__)
  return "avx2";
#else
  return "sse2";
#endif
}

}  // namespace fsi
