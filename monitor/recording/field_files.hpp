#pragma once
/// Pictures of the output times that a run wrote: what a page shows of the time before it was opened, of a run
/// that is over and of a recording.

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/wire/messages.hpp"

namespace fsi::monitor {

class FieldFiles {
 public:
  /// @param run_dir folder of the run; empty, or one that is gone: there are no pictures
  explicit FieldFiles(std::string run_dir) : run_dir_(std::move(run_dir)) {}

  /// Pictures that were not given before, for these wishes (ROLE.QUANTITY) and for output times up to `until`
  /// [time]; a few at a time, those of one output time together. An output that cannot be read is passed over,
  /// the newest one until it can.
  std::vector<wire::Picture> next(const std::vector<std::string>& wishes, double until);

 private:
  /// The series of one program.
  struct Series {
    std::string path, from, role;
  };
  std::vector<Series> series() const;
  std::vector<wire::Picture> next_of(const Series& one, const std::string& quantity, double until);

  std::string run_dir_;
  std::map<std::pair<std::string, std::string>, std::size_t> given_;  ///< outputs, by program and quantity
};

}  // namespace fsi::monitor
