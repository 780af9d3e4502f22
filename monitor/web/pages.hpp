#pragma once
/// The files of the page, compiled in; pages.cpp.in is filled when CMake runs.

#include <array>

namespace fsi::monitor {

struct PageFile {
  const char* path;
  const char* type;
  const char* content;
};

extern const std::array<PageFile, 8> page_files;

}  // namespace fsi::monitor
