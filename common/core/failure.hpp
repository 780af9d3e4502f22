#pragma once
/// Three kinds of failure that are never mixed, and the exit codes they end a program with.

#include <stdexcept>
#include <string>

namespace fsi {

enum class ExitCode : int {
  done = 0,
  expectation_missed = 1,  ///< an `expect:` entry missed, or an internal error
  user_mistake = 2,
  numbers_broke = 3,
  peer_lost = 4,
  output_failed = 5,
  interrupted = 130,
  terminated = 143,
};

/// A failure that ends a program with a code and one line of explanation.
class Failure : public std::runtime_error {
 public:
  Failure(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// The user's mistake: one line with file:line:column (where
/// there is one), what is wrong and what to write. Exit 2.
class UserMistake : public Failure {
 public:
  explicit UserMistake(const std::string& message) : Failure(ExitCode::user_mistake, message) {}
};

/// The numbers broke: step, time, grid, point and value. Exit 3.
class NumbersBroke : public Failure {
 public:
  explicit NumbersBroke(const std::string& message) : Failure(ExitCode::numbers_broke, message) {}
};

/// A program of the run is lost, silent or does not fit. Exit 4.
class PeerLost : public Failure {
 public:
  explicit PeerLost(const std::string& message) : Failure(ExitCode::peer_lost, message) {}
};

/// Results cannot be written. Exit 5.
class OutputFailed : public Failure {
 public:
  explicit OutputFailed(const std::string& message) : Failure(ExitCode::output_failed, message) {}
};

}  // namespace fsi
