#pragma once
/// Files that are either whole or not there: written to a temporary file, synced, renamed.

#include <string>

namespace fsi::io {

/// Creates a directory and those above it. @throws OutputFailed
void make_directory(const std::string& path);

/// Name of the temporary file for `path`, in the same directory.
std::string aside(const std::string& path);

/// Syncs `aside(path)` to disk and gives it the name `path`, replacing what was there. @throws OutputFailed
void rename_into_place(const std::string& path);

/// Replaces the file `path` by `text`: a kill at any moment
/// leaves the old file or the new one. @throws OutputFailed
void write_atomically(const std::string& path, const std::string& text);

}  // namespace fsi::io
