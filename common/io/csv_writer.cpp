#include "common/io/csv_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "common/core/failure.hpp"
#include "common/core/log.hpp"
#include "common/io/atomic_file.hpp"

namespace fsi::io {

namespace {

[[noreturn]] void fail(const char* what, const std::string& path, int error, const char* remedy,
                       std::uint64_t lost = 1) {
  throw OutputFailed(fmt::format("cannot {} '{}': {}; {}", what, path, std::strerror(error), remedy), lost);
}

}  // namespace

CsvWriter::CsvWriter(std::string path, const std::vector<std::string>& columns, Opening opening, int batch)
    : path_(std::move(path)), columns_(columns.size()), batch_(batch) {
  const auto directory = std::filesystem::path(path_).parent_path().string();
  if (!directory.empty()) make_directory(directory);
  const bool fresh = opening == Opening::fresh;
  file_.reset(std::fopen(path_.c_str(), fresh ? "wbe" : "r+be"));  // NOLINT(cppcoreguidelines-owning-memory)
  if (!file_) fail(fresh ? "create" : "continue", path_, errno, "check the directory and its permissions");
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);  // whole batches only: never half a line
  pending_ = fmt::format("{}\n", fmt::join(columns, ","));
  if (fresh) {
    waiting_ = 1;
    flush();
    return;
  }
  std::string header(std::exchange(pending_, {}));
  std::string found(header.size(), '\0');
  found.resize(std::fread(found.data(), 1, found.size(), file_.get()));
  if (found != header)
    throw OutputFailed(fmt::format(
        "'{}' has other columns than this run, or its first line is damaged: restart with the same "
        "probes, or put that line back",
        path_));
}

CsvWriter::~CsvWriter() {
  try {
    if (file_) flush();
  } catch (const OutputFailed& failure) {
    log_warning(fmt::format("{}; lines lost: {}", failure.what(), failure.lost()));
  }
}

void CsvWriter::row(std::span<const double> values, std::string_view word) {
  const std::size_t given = values.size() + (word.empty() ? 0 : 1);
  if (given != columns_)
    throw std::logic_error(fmt::format("a line of '{}' has {} columns, not {}", path_, columns_, given));
  fmt::format_to(std::back_inserter(pending_), "{}{}{}\n", fmt::join(values, ","), word.empty() ? "" : ",",
                 word);
  if (++waiting_ >= batch_) flush();
}

void CsvWriter::flush() {
  const bool written = std::fwrite(pending_.data(), 1, pending_.size(), file_.get()) == pending_.size();
  const int error = errno;
  const std::size_t bytes = std::exchange(pending_, {}).size();
  const int lines = std::exchange(waiting_, 0);
  if (!written) {
    cut(size_);
    fail("write", path_, error, "check the free space", static_cast<std::uint64_t>(lines));
  }
  size_ += bytes;
}

void CsvWriter::cut(std::uint64_t size) {
  const auto end = static_cast<off_t>(size);
  static_cast<void>(::ftruncate(::fileno(file_.get()), end) == 0 &&
                    ::fseeko(file_.get(), end, SEEK_SET) == 0);
}

void CsvWriter::archive(Archive& archive) {
  if (!archive.loading()) {
    flush();
    if (::fdatasync(::fileno(file_.get())) != 0) fail("sync", path_, errno, "check the free space");
  }
  archive.number("bytes", size_);
  if (!archive.loading()) return;
  const std::uint64_t found = std::filesystem::file_size(path_);
  if (found < size_) {
    throw OutputFailed(
        fmt::format("'{}' has {} bytes, the checkpoint was written when it had {}", path_, found, size_));
  }
  cut(size_);
}

}  // namespace fsi::io
