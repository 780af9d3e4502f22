#pragma once
/// A run that is over, from what it left in its folder.

#include <optional>
#include <string>

#include "common/wire/messages.hpp"
#include "monitor/source.hpp"

namespace fsi::monitor {

/// How a run ended, as the launcher wrote it down.
struct Ending {
  std::string name;             ///< of the case
  std::optional<double> t_end;  ///< time the case was to reach; a summary of former versions does not say it
  std::optional<wire::Abort> abort;
};

/// None while the folder holds no summary.
std::optional<Ending> ending_of(const std::string& run_dir);

/// Shown like a run that has just ended: what its programs reported, and the history that its tables hold. What
/// is present are the values of the last line.
class EndedRun : public Source {
 public:
  /// @throws UserMistake where the folder is none of a run that is over
  explicit EndedRun(const std::string& run_dir);

  const RunEntry& run() const { return run_; }

  void listen(RunState& state, double seconds) override;
  double now() const override { return 0; }
  std::string request(Request request) override;
  std::string controls() const override { return ""; }

 private:
  RunEntry run_;
  Ending ending_;
};

}  // namespace fsi::monitor
