#include "monitor/recording/recording.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "common/core/failure.hpp"
#include "common/io/atomic_file.hpp"
#include "monitor/recording/recording_block.hpp"

namespace fsi::monitor {

namespace {

namespace fs = std::filesystem;

/// A kill loses at most this much [s].
constexpr double flush_s = 5;
/// Messages of a block, should they come faster than usual.
constexpr std::size_t block_length = 2000;

constexpr auto format = "AMP-FSI recording 2";

std::string block_name(std::size_t index) {
  return fmt::format("{:06}", index);
}

/// What is there already may be replaced. @throws UserMistake
void expect_recording(const std::string& path) {
  std::error_code unknown;
  if (!fs::exists(path, unknown)) return;
  try {
    if (fs::is_regular_file(path) && io::Hdf5::open(path).text_attribute("format") == format) return;
  } catch (const Failure&) {  // another file
  }
  throw UserMistake(fmt::format("--record: '{}' is there and is no recording; name another file", path));
}

}  // namespace

Recorder::Recorder(std::string path, RunEntry run, double now)
    : path_(std::move(path)), run_(std::move(run)), start_(now), last_flush_(now) {
  expect_recording(path_);
  io::make_directory(path_ + ".parts");
  write_whole(true);
}

Recorder::~Recorder() {
  try {
    close();
  } catch (const std::exception& error) {
    fmt::print(stderr, "monitor: {}\n", error.what());
  }
}

std::string Recorder::block_path(std::size_t index) const {
  return fmt::format("{}.parts/{}.h5", path_, block_name(index));
}

void Recorder::add(const wire::Telemetry& telemetry, double now) {
  block_.push_back({.at = now - start_, .telemetry = telemetry});
  if (now - last_flush_ < flush_s && block_.size() < block_length) return;
  last_flush_ = now;
  flush();
}

void Recorder::add(const wire::Abort& abort, double now) {
  block_.push_back({.at = now - start_, .abort = abort});
}

void Recorder::flush() {
  if (block_.empty()) return;
  failed_ = true;  // unless the end of this function is reached
  io::Hdf5 file = io::Hdf5::create(io::aside(block_path(blocks_)));
  write_block(file, block_);
  file.close();
  io::rename_into_place(block_path(blocks_));
  ++blocks_;
  block_.clear();
  write_whole(true);
  failed_ = false;
}

/// The file itself: links to the blocks while it grows, the blocks themselves at the end.
void Recorder::write_whole(bool linked) const {
  io::Hdf5 file = io::Hdf5::create(io::aside(path_));
  file.write_attribute("format", std::string(format));
  file.write_attribute("run", run_.run);
  file.write_attribute("case", run_.name);
  file.write_attribute("dir", run_.dir);
  file.write_attribute("blocks", static_cast<std::uint64_t>(blocks_));
  for (std::size_t k = 0; k < blocks_; ++k) {
    if (linked) {
      file.link(block_name(k),
                fs::path(block_path(k)).parent_path().filename() / fs::path(block_path(k)).filename(), "/");
    } else {
      io::Hdf5 group = file.make_group(block_name(k));
      write_block(group, read_block(io::Hdf5::open(block_path(k))));
    }
  }
  file.close();
  io::rename_into_place(path_);
}

void Recorder::close() {
  if (std::exchange(closed_, true) || failed_) return;
  flush();
  write_whole(false);
  std::error_code none;
  fs::remove_all(path_ + ".parts", none);
}

Recording::Recording(const std::string& path) : path_(path), file_(io::Hdf5::open(path)) {
  if (!file_.has("000000")) throw OutputFailed(fmt::format("'{}' holds no recording of a run", path));
  run_ = {.run = file_.text_attribute("run"),
          .name = file_.text_attribute("case"),
          .dir = file_.text_attribute("dir")};
  blocks_ = static_cast<std::size_t>(file_.number_attribute("blocks"));
}

std::vector<Heard> Recording::next() {
  if (read_ >= blocks_) return {};
  return read_block(file_.group(block_name(read_++)));
}

}  // namespace fsi::monitor
