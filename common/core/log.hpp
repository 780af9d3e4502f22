#pragma once
/// Logging of the programs: warnings and errors to stderr, everything to <run-dir>/log/<program>.log.

#include <string>

namespace fsi {

/// A run that goes on keeps what its log says, why it ended before.
enum class LogFile { fresh, continued };

/// Opens the log of one program. `run_dir` may be empty: then only stderr is used.
void open_log(const std::string& program, const std::string& run_dir, LogFile kept);

void log_info(const std::string& message);
void log_warning(const std::string& message);
void log_error(const std::string& message);

}  // namespace fsi
