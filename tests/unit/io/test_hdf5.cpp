#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/core/failure.hpp"
#include "common/io/hdf5.hpp"
#include "tests/unit/io/scratch.hpp"

namespace fsi::io {
namespace {

class Hdf5File : public InScratch {};

TEST_F(Hdf5File, GivesBackEveryBitAndTheShape) {
  std::vector<double> values(12);
  std::iota(values.begin(), values.end(), 0.1);
  {
    Hdf5 file = Hdf5::create(dir + "/a.h5");
    Hdf5 group = file.make_group("grid");
    group.write("rho", values, std::vector<std::uint64_t>{3, 4});
    group.write_attribute("t", 0.1 + 0.2);
    group.write_attribute("step", std::uint64_t{412});
    group.write_attribute("law", std::string("neo_hookean"));
    file.close();
  }
  const Hdf5 file = Hdf5::open(dir + "/a.h5");
  const Hdf5 group = file.group("grid");
  EXPECT_EQ(group.read("rho").values, values);
  EXPECT_EQ(group.shape("rho"), (std::vector<std::uint64_t>{3, 4}));
  EXPECT_EQ(file.read("grid/rho").shape, group.shape("rho"));
  EXPECT_EQ(group.number_attribute("t"), 0.1 + 0.2);
  EXPECT_EQ(group.number_attribute("step"), 412);
  EXPECT_EQ(group.text_attribute("law"), "neo_hookean");
  EXPECT_EQ(file.names(), std::vector<std::string>{"grid"});
  EXPECT_TRUE(file.has("grid/rho"));
  EXPECT_FALSE(file.has("grid/p"));
  EXPECT_FALSE(file.has("other/rho"));
}

TEST_F(Hdf5File, OfRowsThatAreMadeWhileTheyAreWrittenIsTheSameToTheBit) {
  constexpr std::uint64_t rows = 75, width = 7;  // no multiple of what is written at a time
  std::vector<double> values(rows * width);
  std::iota(values.begin(), values.end(), 0.1);
  const std::vector<std::uint64_t> shape{rows, width};
  for (const Packing packing : {Packing::plain, Packing::deflated}) {
    std::uint64_t most = 0, next = 0;
    Hdf5 file = Hdf5::create(dir + "/rows.h5");
    file.write("at_once", values, shape, packing);
    file.write("by_rows", shape, packing, [&](std::uint64_t first, std::uint64_t end) {
      EXPECT_EQ(first, std::exchange(next, end));
      most = std::max(most, end - first);
      return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(first * width),
                                 values.begin() + static_cast<std::ptrdiff_t>(end * width));
    });
    EXPECT_LT(most, rows / 2);
    EXPECT_EQ(file.read("by_rows").values, values);
    EXPECT_EQ(file.read("by_rows").shape, file.read("at_once").shape);
  }
}

TEST_F(Hdf5File, RefusesRowsOfAnotherWidth) {
  Hdf5 file = Hdf5::create(dir + "/rows.h5");
  const auto narrow = [](std::uint64_t first, std::uint64_t end) {
    return std::vector<double>(2 * (end - first));
  };
  EXPECT_THROW(file.write("x", std::vector<std::uint64_t>{4, 3}, Packing::plain, narrow), std::logic_error);
}

TEST_F(Hdf5File, FollowsALinkIntoAnotherFileFromAnyWorkingDirectory) {
  std::filesystem::create_directories(dir + "/fields");
  Hdf5 part = Hdf5::create(dir + "/fields/part.h5");
  part.make_group("grid").write("p", std::vector<double>{1, 2, 3});
  part.close();
  Hdf5 master = Hdf5::create(dir + "/master.h5");
  master.link("000000", "fields/part.h5", "/");
  master.link("000001", "fields/gone.h5", "/");
  master.close();
  const Hdf5 opened = Hdf5::open(dir + "/master.h5");
  EXPECT_EQ(opened.group("000000").read("grid/p").values, (std::vector<double>{1, 2, 3}));
  EXPECT_TRUE(opened.has("000000"));
  EXPECT_FALSE(opened.has("000001"));
}

TEST_F(Hdf5File, NamesTheFileThatIsMissingOrForeign) {
  std::ofstream(dir + "/text.h5") << "this is no HDF5 file\n";
  for (const auto& path : {dir + "/none.h5", dir + "/text.h5"}) {
    try {
      Hdf5::open(path);
      FAIL() << "must not open " << path;
    } catch (const OutputFailed& failure) {
      EXPECT_NE(std::string(failure.what()).find(path), std::string::npos);
      EXPECT_EQ(failure.code(), ExitCode::output_failed);
    }
  }
}

TEST_F(Hdf5File, NamesTheDatasetThatIsMissing) {
  Hdf5 file = Hdf5::create(dir + "/a.h5");
  try {
    file.read("rho");
    FAIL() << "there is no rho";
  } catch (const OutputFailed& failure) {
    EXPECT_NE(std::string(failure.what()).find("'rho'"), std::string::npos);
  }
}

TEST_F(Hdf5File, CannotBeCreatedWhereNoDirectoryIs) {
  try {
    Hdf5::create(occupied_place(dir) + "/a.h5");
    FAIL() << "must not create";
  } catch (const OutputFailed& failure) {
    EXPECT_NE(std::string(failure.what()).find("permissions"), std::string::npos);
  }
}

TEST_F(Hdf5File, PrintsNothingOfItsOwnWhenItFails) {
  testing::internal::CaptureStderr();
  EXPECT_THROW(Hdf5::open(dir + "/none.h5"), OutputFailed);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(Hdf5File, RefusesValuesThatDoNotFillTheShape) {
  Hdf5 file = Hdf5::create(dir + "/a.h5");
  EXPECT_THROW(file.write("x", std::vector<double>{1, 2}, std::vector<std::uint64_t>{3}), std::logic_error);
}

}  // namespace
}  // namespace fsi::io
