#pragma once
/// DIR/run.xmf: everything that DIR holds as one animated data set for ParaView, solids in deformed position.

#include <string>

namespace fsi::io {

/// Writes run.xmf from the files present in `run_dir` and returns the number of output times in it. Repeating
/// it gives the same file. @throws OutputFailed
std::size_t write_xdmf(const std::string& run_dir);

}  // namespace fsi::io
