/// The tables of a beam where one of them cannot be written.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "common/case/case.hpp"
#include "solid_solver/beam/port.hpp"
#include "tests/unit/io/full_disk.hpp"
#include "tests/unit/io/scratch.hpp"

namespace fsi::beam {
namespace {

class TablesOfABeam : public io::InScratch {
 protected:
  void SetUp() override {
    InScratch::SetUp();
    setup = {
        .problem = load_case(
            configs_folder() + "/clamped_beam.yaml",
            {"time.dt=0.01", "solids.beam.initial={v: [0, 0]}", "output.on_failure=go_on",
             "solids.beam.beam={line: [[0, 0], [0, 1]], thickness: 0.1, elements: 5, ends: [clamped, free]}"},
            {"beam=beam"}),
        .run_dir = dir,
        .run = "run",
        .name = "beam"};
  }

  /// Lines below the header of a table.
  int lines(const std::string& table) const {
    return static_cast<int>(std::ranges::count(content(dir + "/" + table), '\n')) - 1;
  }

  fsi::Setup setup;  // GoogleTest keeps the bare name from its tests
};

TEST_F(TablesOfABeam, LoseWhatIsCountedAndNothingOfThoseThatHaveRoom) {
  constexpr int steps = 40;
  for (const std::string full : {"forces_beam.csv", "parts/probes_beam.csv", "energies_beam.csv"}) {
    io::Part part;
    BeamParticipant beam(setup, solid_of(setup));
    io::fill_disk_of(dir + "/" + full);
    for (int k = 0; k < steps; ++k) write_results(setup, part, [&] { beam.write_tables(k, 1, {}); });
    write_results(setup, part, [&] { beam.flush_tables(); });
    for (const std::string table : {"forces_beam.csv", "parts/probes_beam.csv", "energies_beam.csv"})
      EXPECT_EQ(lines(table), table == full ? 0 : steps) << table << " where there is no room in " << full;
    EXPECT_EQ(part.counters[lost_outputs], steps) << full;
  }
}

TEST_F(TablesOfABeam, AreAllNamedWhereNoneCanBeWritten) {
  setup.problem.output.go_on = false;
  io::Part part;
  BeamParticipant beam(setup, solid_of(setup));
  beam.write_tables(0, 1, {});
  for (const std::string full : {"/forces_beam.csv", "/energies_beam.csv"}) io::fill_disk_of(dir + full);
  try {
    write_results(setup, part, [&] { beam.flush_tables(); });
    FAIL() << "two of them cannot be written";
  } catch (const OutputFailed& failure) {
    const std::string said = failure.what();
    EXPECT_NE(said.find("forces_beam.csv"), std::string::npos) << said;
    EXPECT_NE(said.find("energies_beam.csv"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace fsi::beam
