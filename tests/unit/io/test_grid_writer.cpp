#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <regex>

#include "common/core/failure.hpp"
#include "common/core/field.hpp"
#include "common/io/grid_writer.hpp"
#include "common/io/hdf5.hpp"
#include "common/io/xdmf.hpp"
#include "tests/unit/io/scratch.hpp"
#include "tests/waiting.hpp"

namespace fsi::io {
namespace {

constexpr int n1 = 7, n2 = 5;

/// A field whose ghosts and padding are filled too, so that a writer that leaves the grid is seen.
Field filled(int points1, int points2, int planes, double start) {
  Field field(Layout(points1, points2), planes);
  double value = start;
  for (double& entry : field.values()) entry = -1e30;
  for (int k = 0; k < planes; ++k) {
    for (int j = 0; j < points2; ++j) {
      for (int i = 0; i < points1; ++i) field(k, i, j) = value += 0.01;
    }
  }
  return field;
}

class GridSeries : public InScratch {
 protected:
  Field x = filled(n1, n2, 2, 0), u = filled(n1, n2, 2, 10), q = filled(n1, n2, 3, 20);

  void write_fluid(GridWriter& writer, double t, std::uint64_t step) {
    const GridOutput grid{
        .grid = "channel", .x = x.view(), .u = {}, .fields = {{"rho", q.view(), 0}, {"p", q.view(), 2}}};
    writer.write(t, step, {&grid, 1});
  }
  void write_solid(GridWriter& writer, double t) {
    const GridOutput grid{.grid = "block", .x = x.view(), .u = u.view(), .fields = {{"u1", u.view(), 0}}};
    writer.write(t, 0, {&grid, 1});
  }
};

TEST_F(GridSeries, HoldsThePointsOfTheGridWithoutGhosts) {
  GridWriter writer(dir, "fluid");
  write_fluid(writer, 0, 0);
  write_fluid(writer, 0.25, 17);
  const Hdf5 file = Hdf5::open(dir + "/fluid.h5");
  ASSERT_EQ(file.names(), (std::vector<std::string>{"000000", "000001"}));
  const Hdf5 output = file.group("000001");
  EXPECT_EQ(output.number_attribute("t"), 0.25);
  EXPECT_EQ(output.number_attribute("step"), 17);
  const Array p = output.read("channel/p");
  ASSERT_EQ(p.shape, (std::vector<std::uint64_t>{n2, n1}));
  for (int j = 0; j < n2; ++j) {
    for (int i = 0; i < n1; ++i) EXPECT_EQ(p.values[static_cast<std::size_t>(j * n1 + i)], q(2, i, j));
  }
}

TEST_F(GridSeries, ShowsASolidInDeformedAndInReferencePosition) {
  GridWriter writer(dir, "solid_beam");
  write_solid(writer, 0);
  const Hdf5 grid = Hdf5::open(dir + "/solid_beam.h5").group("000000/block");
  EXPECT_EQ(grid.read("x1_bar").values.front(), x(0, 0, 0));
  EXPECT_EQ(grid.read("x1").values.front(), x(0, 0, 0) + u(0, 0, 0));
  EXPECT_EQ(grid.read("x2").values.back(), x(1, n1 - 1, n2 - 1) + u(1, n1 - 1, n2 - 1));
  const Array both = grid.read("x");
  EXPECT_EQ(both.shape, (std::vector<std::uint64_t>{n2, n1, 2}));
  EXPECT_EQ(both.values[0], grid.read("x1").values[0]);
  EXPECT_EQ(both.values[1], grid.read("x2").values[0]);
}

TEST_F(GridSeries, LeavesNoFileAsideBehind) {
  GridWriter writer(dir, "fluid");
  write_fluid(writer, 0, 0);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(dir)) {
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }
}

TEST_F(GridSeries, SaysSoWhenTheDirectoryCannotBeWritten) {
  try {
    GridWriter writer(occupied_place(dir), "fluid");
    FAIL() << "must not start";
  } catch (const OutputFailed& failure) {
    EXPECT_NE(std::string(failure.what()).find("occupied"), std::string::npos);
    EXPECT_NE(std::string(failure.what()).find("permissions"), std::string::npos);
  }
}

TEST_F(GridSeries, SaysSoWhenTheDirectoryIsTakenAwayDuringTheRun) {
  GridWriter writer(dir, "fluid");
  write_fluid(writer, 0, 0);
  std::filesystem::remove_all(dir + "/fields");
  EXPECT_THROW(write_fluid(writer, 1, 1), OutputFailed);
}

/// Text between `open` and `close`, every time it occurs.
std::vector<std::string> all_between(const std::string& text, const std::string& open,
                                     const std::string& close) {
  std::vector<std::string> found;
  for (auto at = text.find(open); at != std::string::npos; at = text.find(open, at)) {
    at += open.size();
    found.push_back(text.substr(at, text.find(close, at) - at));
  }
  return found;
}

TEST_F(GridSeries, XdmfReferencesArraysThatExistWithTheShapeItStates) {
  GridWriter fluid(dir, "fluid"), solid(dir, "solid_beam");
  for (const double t : {0.0, 0.5, 1.0}) {
    write_fluid(fluid, t, 0);
    write_solid(solid, t);
  }
  EXPECT_EQ(write_xdmf(dir), 3U);
  const std::string text = content(dir + "/run.xmf");
  const std::regex item(R"re(<DataItem Dimensions="([\d ]+)"[^>]*>([^:<]+):([^<]+)</DataItem>)re");
  int items = 0;
  for (std::sregex_iterator match(text.begin(), text.end(), item), end; match != end; ++match, ++items) {
    const Hdf5 file = Hdf5::open(dir + "/" + (*match)[2].str());
    EXPECT_EQ(fmt::format("{}", fmt::join(file.shape((*match)[3].str()), " ")), (*match)[1].str())
        << (*match)[0];
  }
  EXPECT_EQ(items, 3 * (3 + 2));  // fluid: x, rho, p; solid: x, u1
  EXPECT_EQ(all_between(text, "<Time Value=\"", "\""), (std::vector<std::string>{"0", "0.5", "1"}));
}

TEST_F(GridSeries, UnusedPointsAreHiddenFromWhateverIsBuiltOnVtk) {
  GridWriter writer(dir, "fluid");
  GridOutput grid{.grid = "channel", .x = x.view(), .u = {}, .fields = {{"rho", q.view(), 0}}};
  for (std::uint8_t k = 0; k < n1 * n2; ++k) grid.kinds.push_back(k % 3);
  writer.write(0, 0, {&grid, 1});
  write_xdmf(dir);
  const Array kind = Hdf5::open(dir + "/fluid.h5").read("000000/channel/kind");
  const Array hidden = Hdf5::open(dir + "/fluid.h5").read("000000/channel/vtkGhostType");
  ASSERT_EQ(hidden.shape, kind.shape);
  for (std::size_t k = 0; k < kind.values.size(); ++k)
    EXPECT_EQ(hidden.values[k], kind.values[k] == 0 ? 2 : 0);
  EXPECT_EQ(all_between(content(dir + "/run.xmf"), R"(NumberType="UChar" Precision="1" Format="HDF">)", "<"),
            (std::vector<std::string>{"fields/fluid_000000.h5:/channel/vtkGhostType"}));
}

TEST_F(GridSeries, XdmfOfAnInterruptedRunShowsWhatIsThereAndIsRepeatable) {
  GridWriter fluid(dir, "fluid"), solid(dir, "solid_beam");
  write_fluid(fluid, 0, 0);
  write_solid(solid, 0);
  write_fluid(fluid, 1, 1);  // the solid was killed before its second output
  EXPECT_EQ(write_xdmf(dir), 2U);
  const std::string once = content(dir + "/run.xmf");
  EXPECT_EQ(write_xdmf(dir), 2U);
  EXPECT_EQ(content(dir + "/run.xmf"), once);
  EXPECT_EQ(all_between(once, "<Grid Name=\"solid_beam/block\"", ">").size(), 1U);
}

TEST_F(GridSeries, XdmfTellsTimesApartInAnyUnit) {
  GridWriter fluid(dir, "fluid"), solid(dir, "solid_beam");
  for (const std::uint64_t step : {0U, 1U, 2U}) {
    const double t = 1e-10 * static_cast<double>(step);
    write_fluid(fluid, t, step);
    write_solid(solid, t * (1 + 1e-15));
  }
  EXPECT_EQ(write_xdmf(dir), 3U);
}

TEST_F(GridSeries, XdmfOfAnEmptyDirectoryHasNoTimes) {
  EXPECT_EQ(write_xdmf(dir), 0U);
}

/// What the child of the kill campaign does until it is killed:
/// outputs in which every value is the output's number.
[[noreturn]] void write_until_killed(const std::string& dir, int points) {
  Field x(Layout(points, points), 2), q(Layout(points, points), 1);
  GridWriter writer(dir, "fluid");
  for (int k = 0;; ++k) {
    for (double& value : q.values()) value = k;
    const GridOutput grid{.grid = "box", .x = x.view(), .u = {}, .fields = {{"p", q.view(), 0}}};
    writer.write(k, static_cast<std::uint64_t>(k), {&grid, 1});
  }
}

/// Outputs in the series; fails the test if one of them is not whole.
std::size_t count_whole_outputs(const std::string& dir) {
  const Hdf5 file = Hdf5::open(dir + "/fluid.h5");
  const auto outputs = file.names();
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    EXPECT_EQ(file.group(outputs[k]).number_attribute("t"), static_cast<double>(k));
    const Array p = file.read(outputs[k] + "/box/p");
    EXPECT_TRUE(std::ranges::all_of(p.values, [&](double value) { return value == static_cast<double>(k); }))
        << k;
  }
  return outputs.size();
}

TEST_F(GridSeries, OpensWithAllEarlierOutputsWhenTheWriterIsKilledAtAnyMoment) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> delay_s(0, 0.02);
  std::size_t outputs = 0;
  for (int kill_number = 0; kill_number < 50; ++kill_number) {
    const std::string run = fmt::format("{}/{}", dir, kill_number);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) write_until_killed(run, 60);
    const std::string awaited = fmt::format("{}/fields/fluid_{:06}.h5", run, kill_number % 4);
    EXPECT_TRUE(fsi::test::until([&] { return std::filesystem::exists(awaited); }));
    EXPECT_TRUE(fsi::test::until([&] { return std::filesystem::exists(run + "/fluid.h5"); }));
    fsi::test::let_pass(delay_s(random));
    kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the writer ended by itself";
    const std::size_t listed = count_whole_outputs(run);
    const auto finished = [](const auto& file) { return file.path().extension() == ".h5"; };
    const auto files = std::ranges::count_if(std::filesystem::directory_iterator(run + "/fields"), finished);
    EXPECT_GE(listed + 1, static_cast<std::size_t>(files)) << "an earlier output is missing in the series";
    outputs += listed;
    EXPECT_GE(write_xdmf(run), 1U);
    std::filesystem::remove_all(run);
  }
  EXPECT_GT(outputs, 50U) << "the kills came too early to show anything";
}

/// Writes a small output, then one larger than any file may be; ends as a program does.
[[noreturn]] void write_beyond_the_limit(const std::string& dir) {
  signal(SIGXFSZ, SIG_IGN);  // the write fails instead, as on a full disk
  const rlimit limit{.rlim_cur = 100'000, .rlim_max = 100'000};
  setrlimit(RLIMIT_FSIZE, &limit);
  int code = 0;
  try {
    GridWriter writer(dir, "fluid");
    for (const int points : {10, 300}) {
      const Field x(Layout(points, points), 2);
      const GridOutput grid{.grid = "box", .x = x.view(), .u = {}, .fields = {{"p", x.view(), 0}}};
      writer.write(0, 0, {&grid, 1});
    }
  } catch (const OutputFailed& failure) {
    code = static_cast<int>(failure.code());
  }
  std::exit(code);
}

TEST_F(GridSeries, AFullDiskIsNamedAndLeavesTheEarlierOutputs) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) write_beyond_the_limit(dir);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), static_cast<int>(ExitCode::output_failed));
  const Hdf5 file = Hdf5::open(dir + "/fluid.h5");
  EXPECT_EQ(file.names().size(), 1U);
  EXPECT_EQ(file.shape("000000/box/p"), (std::vector<std::uint64_t>{10, 10}));
}

}  // namespace
}  // namespace fsi::io
