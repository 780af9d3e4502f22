#pragma once
/// One block of a recording: some seconds of telemetry as tables of numbers.

#include <vector>

#include "common/io/hdf5.hpp"
#include "monitor/recording/recording.hpp"

namespace fsi::monitor {

void write_block(io::Hdf5& group, const std::vector<Heard>& heard);
std::vector<Heard> read_block(const io::Hdf5& group);

}  // namespace fsi::monitor
