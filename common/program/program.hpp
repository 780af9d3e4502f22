#pragma once
/// The shell every program of a run lives in: command line,
/// signals, log, exit code and the report it leaves behind.

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "common/case/case.hpp"
#include "common/core/failure.hpp"
#include "common/io/csv_writer.hpp"
#include "common/io/part.hpp"
#include "common/ranks/ranks.hpp"
#include "common/wire/messages.hpp"

namespace fsi {

/// What a program is told on its command line, and the case it read.
struct Setup {
  Case problem;
  std::string run_dir;
  std::string run;           ///< identity of the run on the bus
  std::string name;          ///< participant's name: "fluid", "coupler" or the solid's name
  std::string restart = {};  ///< folder of the checkpoint the run goes on from; empty: it begins
  std::string key = {};      ///< of the run, from the environment's AMP_FSI_KEY
  std::string network = {};  ///< of a run on several machines, from AMP_FSI_NETWORK (bus::BusOptions)
  std::optional<std::uint64_t> pause_at = {};  ///< the run pauses after so many steps
  std::map<std::string, int> pids = {};        ///< coupler: the processes of the others, where they are known
  std::shared_ptr<Ranks> ranks = one_rank();   ///< who computes this participant
  int recut = 0;                               ///< tests: ranks share out their work anew after so many steps

  io::Opening opening() const { return restart.empty() ? io::Opening::fresh : io::Opening::continued; }
};

/// The solid of the case this program stands for. @throws UserMistake
const SolidSpec& solid_of(const Setup& setup);
/// The gas of the case this program stands for. @throws UserMistake
const FluidSpec& fluid_of(const Setup& setup);

/// What the monitor shows of who limited the steps.
std::vector<wire::StepsLimited> limits_of(const io::Part& part);

/// Counts one finished macro step of size dt that ended at time `t`.
void count_step(io::Part& part, double t, double dt);

/// Whether several ranks can compute a participant.
enum class Sharing { one_rank, ranks };

/// Runs the body of a program with everything around it. Failures become the exit code and the report's
/// reason. `default_name` is the participant's name when --name is not given.
int run_program(int argc, char** argv, const std::string& default_name, const std::string& role,
                const std::function<void(const Setup&, io::Part&)>& body,
                Sharing sharing = Sharing::one_rank);

/// Ends the program at once, from whatever thread; its report says why.
[[noreturn]] void end_program(const Setup& setup, io::Part part, const Failure& failure);

/// Counter of the report: results that could not be written.
inline constexpr const char* lost_outputs = "lost_outputs";

/// Writes results. Where that fails and the case says to go on without
/// them, the loss is counted, and told whenever it has doubled. @throws OutputFailed
void write_results(const Setup& setup, io::Part& part, const std::function<void()>& write);

/// Ends the program when a signal asks for it: SIGINT (exit 130), and SIGTERM (exit 143) until
/// `end_in_good_order` was called.
void throw_if_interrupted();
/// From now on the time loop obeys SIGTERM: it looks at `asked_to_end` and ends after a checkpoint, however
/// long that takes.
void end_in_good_order();
/// SIGTERM has come.
bool asked_to_end();

/// Wall-clock time.
class Stopwatch {
 public:
  Stopwatch() : last_(std::chrono::steady_clock::now()) {}
  /// Seconds since the last lap.
  double lap();

 private:
  std::chrono::steady_clock::time_point last_;
};

/// Wall-clock time of a program by kinds of work, added to its report.
class WorkClock {
 public:
  explicit WorkClock(io::Part& part) : part_(part) {}
  /// The time since the last lap went into `work`.
  void lap(io::Work work);

 private:
  io::Part& part_;
  Stopwatch watch_;
};

/// Prints `progress step=.. t=.. dt=.. limit=.. t_end=..` lines for the launcher, at most ten a second. Times have all digits: the
/// launcher's summary of a run whose programs left no report has them from here.
class ProgressLines {
 public:
  explicit ProgressLines(double t_end) : t_end_(t_end) {}
  /// Prints `joined`: everybody has, and the first step begins.
  static void joined();
  void show(std::uint64_t step, double t, double dt, const std::string& limit);

 private:
  double t_end_;  ///< [time]
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace fsi
