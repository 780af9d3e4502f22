#include "common/program/program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <system_error>

#include "common/core/command_line.hpp"
#include "common/core/input/suggest.hpp"
#include "common/core/log.hpp"
#include "common/io/atomic_file.hpp"
#include "common/program/build_id.hpp"
#include "common/ranks/peers.hpp"

namespace fsi {

namespace {

std::atomic<int> caught_signal{0};
std::atomic<bool> loop_obeys_sigterm{false};

void remember(int signal) {
  if (caught_signal != SIGINT) caught_signal = signal == SIGUSR1 ? SIGTERM : signal;
}

void catch_signals() {
  std::signal(SIGPIPE, SIG_IGN);  // the checkpoint at the launcher's death comes after its end of the pipe
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is output that fails, with a name
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = SA_RESTART;  // nothing that is being written breaks off
  sigemptyset(&action.sa_mask);
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGUSR1, &action, nullptr);  // as SIGTERM, which mpirun would not pass on
  prctl(PR_SET_PDEATHSIG, SIGTERM);      // the launcher's death ends the run
}

std::string from_environment(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody sets it here
  return value == nullptr ? "" : value;
}

ExitCode note(const Failure& failure, io::Part& part) {
  part.status = "failed";
  part.reason = failure.what();
  part.origin = failure.origin().empty() ? part.participant : failure.origin();
  part.failure = {.place = failure.place(), .what = failure.cause()};
  return failure.code();
}

/// To the launcher's file in memory: a report that no full disk stops.
void leave_copy(const io::Part& part) {
  const char* descriptor =
      std::getenv("AMP_FSI_REPORT");  // NOLINT(concurrency-mt-unsafe): nobody sets it here
  if (descriptor == nullptr) return;
  const std::string text = io::to_json(part);
  // A path where mpirun stands between the two, which passes no open files on.
  const bool path = descriptor[0] == '/';
  const int file =
      path ? ::open(descriptor, O_WRONLY | O_CLOEXEC) : std::atoi(descriptor);  // NOLINT(cert-err34-c)
  const auto written = ::write(file, text.data(), text.size());
  if (path) ::close(file);
  if (written < 0) log_warning("the launcher cannot be told how this program ended");
}

/// Runs the body; a failure becomes a code and the report's reason.
ExitCode run_body(const std::function<void()>& body, io::Part& part) {
  try {
    body();
    if (part.status == "running") part.status = "completed";
    return ExitCode::done;
  } catch (const Failure& failure) {
    return note(failure, part);
  } catch (const std::exception& error) {
    return note({ExitCode::internal_error, fmt::format("internal error: {}", error.what())}, part);
  }
}

/// Most memory the program ever had [MiB].
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  constexpr double kib_per_mib = 1024;
  return static_cast<double>(usage.ru_maxrss) / kib_per_mib;
}

ExitCode leave_part(const Setup& setup, io::Part& part, ExitCode code) {
  part.exit_code = code;
  part.peak_memory_mib = peak_memory();
  const double updates = static_cast<double>(part.points) * static_cast<double>(part.substeps);
  part.point_updates_per_s = part.compute_s > 0 ? updates / part.compute_s : 0;
  if (setup.ranks->first()) leave_copy(part);
  try {
    io::write_part(setup.run_dir, part);
  } catch (const Failure& failure) {
    log_error(failure.what());
    return code == ExitCode::done ? failure.code() : code;
  }
  return code;
}

/// {name: number} of NAME=NUMBER,.. @throws UserMistake
std::map<std::string, int> numbered(const std::string& list) {
  std::map<std::string, int> result;
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    const std::string name = word.substr(0, word.rfind('='));
    const char *begin = word.data() + std::min(name.size() + 1, word.size()),
               *end = word.data() + word.size();
    const auto [rest, error] = std::from_chars(begin, end, result[name]);
    if (error != std::errc{} || rest != end)
      throw UserMistake(fmt::format("--pids: {} is not NAME=PID", in_ticks(word)));
  }
  return result;
}

/// False: help was asked for. @throws UserMistake
bool read_command_line(int argc, char** argv, const std::string& role, Setup& setup, std::string& case_path,
                       Sharing sharing, int& ranks) {
  CommandLine line(fmt::format("AMP-FSI {}: one program of a run; ./launch/fsi starts it", role));
  line.add_option("--case", case_path, "case file (YAML)").required();
  line.add_option("--run-dir", setup.run_dir, "folder of the results").required();
  line.add_option("--run", setup.run, "identity of the run on the bus");
  line.add_option("--restart", setup.restart, "folder of the checkpoint to go on from");
  line.add_option("--name", setup.name, "name of this participant in the case");
  line.add_option("--pause-at", setup.pause_at, "pause after so many steps");
  std::string pids;
  line.add_option("--pids", pids, "NAME=PID,..: processes of the other participants");
  if (sharing == Sharing::ranks) {
    line.add_option("--ranks", ranks, "processes that compute it together, started by mpirun");
    line.add_option("--recut", setup.recut, "tests: they share out their work anew after so many steps");
  }
  if (!line.parse(argc, argv)) return false;
  setup.pids = numbered(pids);
  return true;
}

/// This process becomes one of several that compute a participant. Others than the first leave signals to it, and
/// have a log and a report of their own.
void join_ranks(Setup& setup, io::Part& part, int size) {
  if (size == 1) return;
  setup.ranks = open_ranks(size);
  const int rank = setup.ranks->rank();
  if (rank > 0) {
    part.participant = fmt::format("{}.rank{}", setup.name, rank);
    for (const int number : {SIGTERM, SIGINT, SIGUSR1}) std::signal(number, SIG_IGN);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
  }
}

/// Different programs, or processors for which libraries choose different code, would not get the same numbers.
void check_same_build(const Setup& setup) {
  const std::string mine = build_id() + " on " + processor_kind() + "\n";
  std::istringstream all(as_text(setup.ranks->together(as_values(mine))));
  std::string first, other;
  std::getline(all, first);
  for (int rank = 1; std::getline(all, other); ++rank) {
    if (other == first) continue;
    throw UserMistake(
        fmt::format("rank {} of {} is program {}, rank 0 is {}: they would not get the same numbers; "
                    "start the same build on processors of one kind (FSI_MARCH)",
                    rank, setup.name, other, first));
  }
}

/// Runs the body, while a rank that waits for others looks after them.
void run_on_ranks(Setup& setup, const std::function<void()>& body) {
  if (setup.ranks->alone()) return body();
  check_same_build(setup);
  RankPeers peers(*setup.ranks, setup.name,
                  {.stopped_s = setup.problem.time.peer_timeout, .step_s = setup.problem.time.step_timeout});
  setup.ranks->while_waiting([&peers](bool begins) { peers.look(begins); });
  body();
}

}  // namespace

void throw_if_interrupted() {
  const int signal = caught_signal;
  if (signal == SIGINT) throw Failure(ExitCode::interrupted, "interrupted (SIGINT)");
  if (signal != 0 && !loop_obeys_sigterm) throw Failure(ExitCode::terminated, "ended on request (SIGTERM)");
}

void end_in_good_order() {
  loop_obeys_sigterm = true;
}

bool asked_to_end() {
  return caught_signal == SIGTERM;
}

void end_program(const Setup& setup, io::Part part, const Failure& failure) {
  const ExitCode code = note(failure, part);
  log_error(part.reason);
  _exit(static_cast<int>(leave_part(setup, part, code)));
}

void write_results(const Setup& setup, io::Part& part, const std::function<void()>& write) {
  try {
    write();
  } catch (const OutputFailed& failure) {
    if (!setup.problem.output.go_on) throw;
    double& lost = part.counters[lost_outputs];
    const bool told = lost > 0 && std::ilogb(lost) == std::ilogb(lost + static_cast<double>(failure.lost()));
    lost += static_cast<double>(failure.lost());
    if (!told) {  // whenever it has become twice as much
      log_warning(fmt::format("{}; the run goes on without (output.on_failure), results lost: {}",
                              failure.what(), lost));
    }
  }
}

const SolidSpec& solid_of(const Setup& setup) {
  const auto found = std::ranges::find(setup.problem.solids, setup.name, &SolidSpec::name);
  if (found != setup.problem.solids.end()) return *found;
  throw UserMistake(fmt::format("the case has no solid \"{}\"; --name must be one of solids", setup.name));
}

const FluidSpec& fluid_of(const Setup& setup) {
  if (const FluidSpec* fluid = fluid_named(setup.problem, setup.name)) return *fluid;
  if (setup.problem.fluids.empty())
    throw UserMistake("the case has no section `fluid`; write one or start a solid solver");
  throw UserMistake(
      fmt::format("the case has no gas \"{}\"; --name must be `fluid`, or one of fluids", setup.name));
}

void count_step(io::Part& part, double t, double dt) {
  part.dt_min = part.steps == 0 ? dt : std::min(part.dt_min, dt);
  part.dt_max = part.steps == 0 ? dt : std::max(part.dt_max, dt);
  ++part.steps;
  part.t = t;
}

std::vector<wire::StepsLimited> limits_of(const io::Part& part) {
  std::vector<wire::StepsLimited> limits;
  for (const auto& [by, steps] : part.limited_by) limits.push_back({.by = by, .steps = steps});
  return limits;
}

double Stopwatch::lap() {
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - last_).count();
  last_ = now;
  return seconds;
}

void WorkClock::lap(io::Work work) {
  const double seconds = watch_.lap();
  part_.time_s[static_cast<std::size_t>(work)] += seconds;
  (work == io::Work::waiting ? part_.wait_s : part_.compute_s) += seconds;
}

void ProgressLines::joined() {
  fmt::print("joined\n");
  std::fflush(stdout);
}

void ProgressLines::show(std::uint64_t step, double t, double dt, const std::string& limit) {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  // Whoever reads may have been stopped; a line that is lost then is no loss, and a program that waited would be.
  pollfd out{.fd = STDOUT_FILENO, .events = POLLOUT, .revents = 0};
  if (poll(&out, 1, 0) != 1 || (out.revents & POLLOUT) == 0) return;
  std::string word = limit;
  std::ranges::replace(word, ' ', '_');
  fmt::print("progress step={} t={} dt={:.6g} limit={} t_end={}\n", step, t, dt, word, t_end_);
  std::fflush(stdout);
}

int run_program(int argc, char** argv, const std::string& default_name, const std::string& role,
                const std::function<void(const Setup&, io::Part&)>& body, Sharing sharing) {
  Setup setup{.problem = {}, .run_dir = ".", .run = "run", .name = default_name};
  std::string case_path;
  int ranks = 1;
  try {
    if (!read_command_line(argc, argv, role, setup, case_path, sharing, ranks)) return 0;
  } catch (const UserMistake& mistake) {
    fmt::print(stderr, "{}: {}\n", default_name, mistake.what());
    return static_cast<int>(mistake.code());
  }

  catch_signals();
  setup.key = from_environment("AMP_FSI_KEY");
  setup.network = from_environment("AMP_FSI_NETWORK");
  io::Part part;
  part.participant = setup.name;
  part.role = role;
  part.status = "running";
  ExitCode code = run_body(
      [&] {
        join_ranks(setup, part, ranks);
        io::make_directory(setup.run_dir + "/log");
        open_log(part.participant, setup.run_dir,
                 setup.restart.empty() ? LogFile::fresh : LogFile::continued);
        setup.problem = load_case(case_path);
        run_on_ranks(setup, [&] { body(setup, part); });
      },
      part);
  if (code != ExitCode::done) log_error(part.reason);
  if (code == ExitCode::done && !setup.ranks->first()) return 0;  // rank 0 reports for all
  code = leave_part(setup, part, code);
  return static_cast<int>(code);
}

}  // namespace fsi
