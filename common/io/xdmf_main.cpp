/// fsi_xdmf DIR: makes DIR/run.xmf, which shows all fields of a run in ParaView as one animated data set.

#include <fmt/format.h>

#include <cstdio>

#include "common/core/failure.hpp"
#include "common/io/xdmf.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: fsi_xdmf DIR\n");
    return static_cast<int>(fsi::ExitCode::user_mistake);
  }
  try {
    const auto times = fsi::io::write_xdmf(argv[1]);
    fmt::print("{}/run.xmf: {} output times\n", argv[1], times);
    return static_cast<int>(fsi::ExitCode::done);
  } catch (const fsi::Failure& failure) {
    fmt::print(stderr, "fsi_xdmf: {}\n", failure.what());
    return static_cast<int>(failure.code());
  }
}
