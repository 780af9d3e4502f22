#pragma once
/// The coupler's port: the case turned into options, the
/// exchanges turned into tables, progress and telemetry.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/sessions/coupler_session.hpp"
#include "common/io/csv_writer.hpp"
#include "common/program/run/checkpoints.hpp"
#include "common/program/run/session.hpp"
#include "common/wire/request.hpp"
#include "coupler/coupler.hpp"

namespace fsi::coupler {

/// A coupled run from hello to the last exchange.
class CoupledRun {
 public:
  /// Waits until everybody has joined. @throws UserMistake when the interfaces do not meet
  CoupledRun(const Setup& setup, io::Part& part);

  /// Exchanges until the end of the case. Whatever fails, everybody else is told.
  void run();

 private:
  void loop();
  void obey_requests();
  void obey(Request request, bool& checkpoint);
  void exchange();
  void complete_checkpoint();
  void record();
  /// What is known now of the step that follows, for its line in the table.
  void note_agreement();
  void show();
  /// Telemetry of the last exchange.
  void publish();
  wire::Picture outline() const;
  void archive(Archive& archive);

  const Setup& setup_;
  io::Part& part_;
  bus::CouplerSession session_;
  Coupler coupler_;
  io::CsvWriter table_;
  std::vector<double> proposed_;     ///< by each program, for the step that led here [time]
  std::string limited_by_ = "none";  ///< that step
  ProgressLines progress_;
  Checkpoints checkpoints_;
  CheckpointClock due_;
  io::Standing at_;                          ///< the exchange to come
  std::optional<std::uint64_t> checkpoint_;  ///< step of the set being written
  bool paused_ = false;
  bool stop_ = false;  ///< after a checkpoint
  std::string end_;    ///< who asked for the end, after a checkpoint
  WorkClock clock_;
};

}  // namespace fsi::coupler
