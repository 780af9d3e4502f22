#pragma once
/// Tables that grow by one line per step: interface.csv, probes.csv, forces_<solid>.csv.

#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/archive.hpp"

namespace fsi::io {

/// Whether an output begins or goes on where a checkpoint left it.
enum class Opening { fresh, continued };

/// Numbers, with as many digits as they need to read back exactly. Lines reach the file in batches: a
/// kill loses at most the last `batch` of them, and never leaves half a line before a whole one.
class CsvWriter {
 public:
  /// Starts the file with one header line; name the unit in the column, "t [time]". A table that is continued
  /// must have the same header, and gets its length by `archive`.
  /// @throws OutputFailed
  CsvWriter(std::string path, const std::vector<std::string>& columns, Opening opening = Opening::fresh,
            int batch = 16);
  CsvWriter(CsvWriter&&) noexcept = default;
  CsvWriter& operator=(CsvWriter&&) noexcept = default;
  CsvWriter(const CsvWriter&) = delete;
  CsvWriter& operator=(const CsvWriter&) = delete;
  /// Hands over the last lines. Where that fails the log says so: who wants to know flushes before.
  ~CsvWriter();

  /// One value per column; with `word` that is the last one. It holds no comma and no quotation mark.
  /// @throws OutputFailed @throws std::logic_error when the number of values is wrong
  void row(std::span<const double> values, std::string_view word = {});
  void row(std::initializer_list<double> values) {
    row(std::span<const double>(values.begin(), values.size()));
  }
  /// Hands all lines to the operating system; after a failure the file ends with the last whole batch, and the
  /// lines since then are lost. @throws OutputFailed with their number
  void flush();
  /// Brings all lines to the disk and notes the length of the file;
  /// on loading, cuts off what came after. @throws OutputFailed
  void archive(Archive& archive);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }  // NOLINT(cppcoreguidelines-owning-memory)
  };
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::string pending_;
  std::uint64_t size_ = 0;  ///< of the file [byte]
  std::size_t columns_ = 0;
  int batch_ = 16, waiting_ = 0;  ///< lines: at most, and those of `pending_`

  void cut(std::uint64_t size);
};

}  // namespace fsi::io
