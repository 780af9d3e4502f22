#include "common/io/csv_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <stdexcept>

#include "common/core/failure.hpp"
#include "common/io/atomic_file.hpp"

namespace fsi::io {

CsvWriter::CsvWriter(std::string path, const std::vector<std::string>& columns, int batch)
    : path_(std::move(path)), columns_(columns.size()), batch_(batch) {
  const auto directory = std::filesystem::path(path_).parent_path().string();
  if (!directory.empty()) make_directory(directory);
  file_.reset(std::fopen(path_.c_str(), "wbe"));  // NOLINT(cppcoreguidelines-owning-memory)
  if (!file_) {
    throw OutputFailed(fmt::format("cannot create '{}': {}; check the directory and its permissions", path_,
                                   std::strerror(errno)));
  }
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);  // whole batches only: never half a line
  pending_ = fmt::format("{}\n", fmt::join(columns, ","));
  flush();
}

CsvWriter::~CsvWriter() {
  try {
    if (file_) flush();
  } catch (const OutputFailed&) {  // a caller that wants to know calls flush() before
    pending_.clear();
  }
}

void CsvWriter::row(std::span<const double> values) {
  if (values.size() != columns_) {
    throw std::logic_error(
        fmt::format("a line of '{}' has {} columns, not {}", path_, columns_, values.size()));
  }
  fmt::format_to(std::back_inserter(pending_), "{}\n", fmt::join(values, ","));
  if (++waiting_ >= batch_) flush();
}

void CsvWriter::flush() {
  const bool written = std::fwrite(pending_.data(), 1, pending_.size(), file_.get()) == pending_.size();
  const int error = errno;
  pending_.clear();
  waiting_ = 0;
  if (!written) {
    throw OutputFailed(
        fmt::format("cannot write '{}': {}; check the free space", path_, std::strerror(error)));
  }
}

}  // namespace fsi::io
