#include "common/program/program.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/core/log.hpp"
#include "common/io/atomic_file.hpp"

namespace fsi {

namespace {

std::atomic<int> received_signal{0};

void remember_signal(int signal) {
  received_signal = signal;
}

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = remember_signal;
  sigemptyset(&action.sa_mask);
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);     // NOLINT(cert-err33-c): nothing to do when it fails
  prctl(PR_SET_PDEATHSIG, SIGTERM);  // the launcher's death ends the run
}

nlohmann::json to_json(const Report& report, ExitCode code) {
  const double updates = static_cast<double>(report.points) * static_cast<double>(report.substeps);
  return {{"participant", report.participant},
          {"role", report.role},
          {"status", report.status},
          {"reason", report.reason},
          {"exit_code", static_cast<int>(code)},
          {"t", report.t},
          {"steps", report.steps},
          {"dt_min", report.dt_min},
          {"dt_max", report.dt_max},
          {"points", report.points},
          {"substeps", report.substeps},
          {"compute_s", report.compute_s},
          {"wait_s", report.wait_s},
          {"point_updates_per_s", report.compute_s > 0 ? updates / report.compute_s : 0.0},
          {"errors", report.errors},
          {"counters", report.counters},
          {"conservation", report.conservation},
          {"interface", report.interface}};
}

/// Runs the body; a failure becomes a code and the report's reason.
ExitCode run_body(const std::function<void()>& body, Report& report) {
  try {
    body();
    report.status = "completed";
    return ExitCode::done;
  } catch (const Failure& failure) {
    report.reason = failure.what();
    return failure.code();
  } catch (const std::exception& error) {
    report.reason = fmt::format("internal error: {}", error.what());
    return ExitCode::expectation_missed;
  }
}

ExitCode write_report(const Setup& setup, const Report& report, ExitCode code) {
  try {
    const auto path = std::filesystem::path(setup.run_dir) / "parts" / (setup.name + ".json");
    std::filesystem::create_directories(path.parent_path());
    io::write_atomically(path.string(), to_json(report, code).dump(1) + "\n");
  } catch (const std::exception& error) {
    log_error(error.what());
    return code == ExitCode::done ? ExitCode::output_failed : code;
  }
  return code;
}

}  // namespace

bool interrupted() {
  return received_signal != 0;
}

void throw_if_interrupted() {
  const int signal = received_signal;
  if (signal == SIGINT) throw Failure(ExitCode::interrupted, "interrupted (SIGINT)");
  if (signal != 0) throw Failure(ExitCode::terminated, "ended on request (SIGTERM)");
}

void Report::count_step(double now, double dt) {
  dt_min = steps == 0 ? dt : std::min(dt_min, dt);
  dt_max = steps == 0 ? dt : std::max(dt_max, dt);
  ++steps;
  t = now;
}

double Stopwatch::lap() {
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - last_).count();
  last_ = now;
  return seconds;
}

void ProgressLines::show(std::uint64_t step, double t, double dt, const std::string& limit) {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  std::string word = limit;
  std::ranges::replace(word, ' ', '_');
  fmt::print("progress step={} t={:.9g} dt={:.6g} limit={} t_end={:.9g}\n", step, t, dt, word, t_end_);
  std::fflush(stdout);
}

int run_program(int argc, char** argv, const std::string& default_name, const std::string& role,
                const std::function<void(const Setup&, Report&)>& body) {
  CLI::App app(fmt::format("AMP-FSI {}: one program of a run; ./launch/fsi starts it", role));
  Setup setup{.problem = {}, .run_dir = ".", .run = "run", .name = default_name};
  std::string case_path;
  app.add_option("--case", case_path, "case file (YAML)")->required();
  app.add_option("--run-dir", setup.run_dir, "folder of the results")->required();
  app.add_option("--run", setup.run, "identity of the run on the bus");
  app.add_option("--name", setup.name, "name of this participant in the case");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : static_cast<int>(ExitCode::user_mistake);
  }

  catch_signals();
  Report report;
  report.participant = setup.name;
  report.role = role;
  ExitCode code = run_body(
      [&] {
        std::filesystem::create_directories(std::filesystem::path(setup.run_dir) / "log");
        open_log(setup.name, setup.run_dir);
        setup.problem = load_case(case_path);
        body(setup, report);
      },
      report);
  if (code != ExitCode::done) log_error(report.reason);
  code = write_report(setup, report, code);
  return static_cast<int>(code);
}

}  // namespace fsi
