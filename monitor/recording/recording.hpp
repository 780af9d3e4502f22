#pragma once
/// Everything heard of a run, in one HDF5 file, and back. README.md describes its layout.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/io/hdf5.hpp"
#include "common/wire/messages.hpp"
#include "monitor/registry.hpp"

namespace fsi::monitor {

/// Something heard, `at` seconds after the recording began.
struct Heard {
  double at = 0;  ///< [s]
  std::optional<wire::Telemetry> telemetry = {};
  std::optional<wire::Abort> abort = {};
};

/// Writes a recording. While it grows it is a series of small files beside a file of links, each written
/// to a temporary file, synced and renamed, so that a kill leaves all but the last seconds; at the end it
/// becomes one file.
class Recorder {
 public:
  /// @throws OutputFailed
  Recorder(std::string path, RunEntry run, double now);
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  Recorder(Recorder&&) = delete;
  Recorder& operator=(Recorder&&) = delete;
  ~Recorder();

  void add(const wire::Telemetry& telemetry, double now);
  void add(const wire::Abort& abort, double now);
  /// Makes one file of it, unless writing failed before: then what
  /// could be written stays as it is. @throws OutputFailed
  void close();

 private:
  void flush();
  void write_whole(bool linked) const;
  std::string block_path(std::size_t index) const;

  std::string path_;
  RunEntry run_;
  double start_, last_flush_;  ///< [s]
  std::vector<Heard> block_;
  std::size_t blocks_ = 0;
  bool closed_ = false, failed_ = false;
};

/// Reads a recording, one block after the other.
class Recording {
 public:
  /// @throws OutputFailed when it is no recording
  explicit Recording(const std::string& path);

  const RunEntry& run() const { return run_; }
  /// The next part in the order of time; empty at the end.
  std::vector<Heard> next();

 private:
  std::string path_;
  io::Hdf5 file_;
  RunEntry run_;
  std::size_t blocks_ = 0, read_ = 0;
};

}  // namespace fsi::monitor
