#include "common/core/log.hpp"

#include <fmt/format.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <memory>
#include <mutex>

#include "common/core/failure.hpp"

namespace fsi {

namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

struct Log {
  std::mutex lock;
  std::string program;
  std::unique_ptr<std::FILE, CloseFile> file;  ///< none before it is opened
};

Log& the_log() {
  static Log log;
  return log;
}

struct Level {
  const char* name;
  const char* colour;  ///< on a terminal
  bool shown;          ///< on stderr too
};
constexpr Level info{.name = "info", .colour = "32", .shown = false};
constexpr Level warning{.name = "warning", .colour = "33;1", .shown = true};
constexpr Level error{.name = "error", .colour = "31;1", .shown = true};

/// Local time to the millisecond.
std::string time_now() {
  timeval now{};
  gettimeofday(&now, nullptr);
  tm local{};
  localtime_r(&now.tv_sec, &local);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &local);
  constexpr int us_per_ms = 1000;
  return fmt::format("{}.{:03}", text, now.tv_usec / us_per_ms);
}

/// A log that cannot be written (a full disk) ends nothing: the results say so themselves.
void tell(const Level& level, const std::string& message) {
  Log& log = the_log();
  const std::lock_guard guard(log.lock);
  if (level.shown) {
    const bool colours = isatty(STDERR_FILENO) != 0;
    const std::string name =
        colours ? fmt::format("\033[{}m{}\033[0m", level.colour, level.name) : std::string(level.name);
    const std::string program = log.program.empty() ? "" : log.program + ": ";
    const std::string line = fmt::format("{}{}: {}\n", program, name, message);
    std::fputs(line.c_str(), stderr);
  }
  if (log.file) {
    const std::string line = fmt::format("{} {} {}\n", time_now(), level.name, message);
    std::fputs(line.c_str(), log.file.get());
    std::fflush(log.file.get());
  }
}

}  // namespace

void open_log(const std::string& program, const std::string& run_dir, LogFile kept) {
  Log& log = the_log();
  const std::lock_guard guard(log.lock);
  log.program = program;
  log.file.reset();
  if (run_dir.empty()) return;
  const auto path = std::filesystem::path(run_dir) / "log" / (program + ".log");
  log.file.reset(std::fopen(path.c_str(), kept == LogFile::fresh ? "we" : "ae"));
  if (!log.file)
    throw OutputFailed(fmt::format("cannot write '{}': {}", path.string(), std::strerror(errno)));
}

void log_info(const std::string& message) {
  tell(info, message);
}
void log_warning(const std::string& message) {
  tell(warning, message);
}
void log_error(const std::string& message) {
  tell(error, message);
}

}  // namespace fsi
