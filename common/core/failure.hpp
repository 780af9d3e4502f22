#pragma once
/// Three kinds of failure that are never mixed, the exit codes they end a program with, and where in a run they are.
///
///     a kernel returns that a point is broken       its solver knows grid and point, often the time
///     the solver throws Diverged(what, place)   the time loop adds the step        Failure::know
///     the program tells the others                  Abort: what, place, who            idl/amp_fsi.idl
///     and leaves it in its report                   `failure` of summary.json          docs/output.md

#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fsi {

enum class ExitCode : int {
  done = 0,
  internal_error =
      1,  ///< a mistake of ours; the launcher also ends with 1 where an `expect:` entry is missed
  user_mistake = 2,
  diverged = 3,
  peer_lost = 4,
  output_failed = 5,
  interrupted = 130,
  terminated = 143,
};

/// Where in a run something is, as far as it is known.
struct Place {
  std::optional<std::uint64_t> step = {};  ///< of the run
  std::optional<double> t = {};            ///< [time]
  std::string program = {};                ///< whose numbers they are, where another one found them broken
  std::string interface = {};              ///< name of its solid
  std::string grid = {};
  std::vector<int> point = {};        ///< (i, j) of a grid, (k) of an interface; empty: not known
  std::vector<double> position = {};  ///< of the point (x, y) [length]; empty: not known
  bool of_reference = false;          ///< `position` is that of a solid at rest
};

/// `step 412, t = 1.37, grid "beam", point (14, 3) at (0.2, 0.1): det F = -0.02`; without what is not known.
std::string sentence_of(const Place& place, const std::string& what);

/// A failure that ends a program with a code and one line of explanation.
class Failure : public std::exception {
 public:
  /// `origin`: the participant where it began, where that is not the one that throws.
  Failure(ExitCode code, std::string cause, Place place = {}, std::string origin = {});

  ExitCode code() const { return code_; }
  /// What is wrong, without where and whose it is.
  const std::string& cause() const { return cause_; }
  const Place& place() const { return place_; }
  const std::string& origin() const { return origin_; }
  /// All of it as one line.
  const char* what() const noexcept override { return line_.c_str(); }

  /// Adds what was not known where it was thrown.
  void know(const Place& more);
  /// Adds what may help.
  void advise(const std::string& remedy);

 private:
  void write_line();

  ExitCode code_;
  std::string cause_, origin_, line_;
  Place place_;
};

/// The user's mistake: one line with file:line:column (where
/// there is one), what is wrong and what to write. Exit 2.
class UserMistake : public Failure {
 public:
  explicit UserMistake(std::string message) : Failure(ExitCode::user_mistake, std::move(message)) {}
};

/// The solution diverged: what is wrong with it, and where. Exit 3.
class Diverged : public Failure {
 public:
  explicit Diverged(std::string cause, Place place = {})
      : Failure(ExitCode::diverged, std::move(cause), std::move(place)) {}
};

/// A program of the run is lost, silent or does not fit. Exit 4.
class PeerLost : public Failure {
 public:
  explicit PeerLost(std::string message) : Failure(ExitCode::peer_lost, std::move(message)) {}
};

/// Results cannot be written. Exit 5.
class OutputFailed : public Failure {
 public:
  /// `lost`: how many results, such as lines of a table.
  explicit OutputFailed(std::string message, std::uint64_t lost = 1)
      : Failure(ExitCode::output_failed, std::move(message)), lost_(lost) {}

  std::uint64_t lost() const { return lost_; }

 private:
  std::uint64_t lost_;
};

}  // namespace fsi
