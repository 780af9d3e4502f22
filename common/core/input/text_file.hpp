#pragma once
/// Files that a user names. What he names may be no file at all: a folder, a device that never ends, a pipe
/// nobody writes to.

#include <cstddef>
#include <string>

namespace fsi {

/// A text, or why there is none.
struct TextFile {
  std::string text;
  std::string trouble;  ///< "is a folder", "cannot be read: Permission denied"; empty where all is well
};

/// What `path` is where it is no file that can be read: "a folder", "a device", "a link that leads nowhere";
/// empty for a file, and where there is nothing.
std::string kind_of_no_file(const std::string& path);

/// Reads a file of at most `most_bytes`.
TextFile read_text_file(const std::string& path, std::size_t most_bytes);

/// Position of the first byte that is not UTF-8 text, or past the end. A zero is no text either.
std::size_t first_bad_byte(const std::string& text);

}  // namespace fsi
