#include "common/core/log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "common/core/failure.hpp"

namespace fsi {

void open_log(const std::string& program, const std::string& run_dir, LogFile kept) {
  auto terminal = std::make_shared<spdlog::sinks::stderr_color_sink_st>();
  terminal->set_level(spdlog::level::warn);
  terminal->set_pattern("%n: %^%l%$: %v");
  std::vector<spdlog::sink_ptr> sinks{terminal};
  if (!run_dir.empty()) {
    const auto path = std::filesystem::path(run_dir) / "log" / (program + ".log");
    try {
      auto file = std::make_shared<spdlog::sinks::basic_file_sink_st>(path.string(), kept == LogFile::fresh);
      file->set_pattern("%Y-%m-%d %H:%M:%S.%e %l %v");
      sinks.push_back(std::move(file));
    } catch (const spdlog::spdlog_ex& error) {
      throw OutputFailed(error.what());
    }
  }
  auto logger = std::make_shared<spdlog::logger>(program, sinks.begin(), sinks.end());
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

void log_info(const std::string& message) {
  spdlog::info("{}", message);
}
void log_warning(const std::string& message) {
  spdlog::warn("{}", message);
}
void log_error(const std::string& message) {
  spdlog::error("{}", message);
}

}  // namespace fsi
