#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "common/core/failure.hpp"
#include "common/exact/table.hpp"
#include "common/io/hdf5.hpp"

namespace fsi::exact {
namespace {

std::vector<double> uneven_points(int n) {
  std::vector<double> x;
  for (int k = 0; k < n; ++k) x.push_back(k / (n - 1.0) + 0.02 * std::sin(3.0 * k));
  return x;
}

TEST(CubicTable, GivesACubicBackExactlyOnUnevenPoints) {
  const auto cubic = [](double x) { return 1 - 2 * x + 3 * x * x - 4 * x * x * x; };
  const auto x = uneven_points(12);
  std::vector<double> y;
  for (const double at : x) y.push_back(cubic(at));
  const CubicTable table(x, {y});
  for (double at = -0.1; at < 1.1; at += 0.037) EXPECT_NEAR(table(at)[0], cubic(at), 1e-13) << at;
}

TEST(CubicTable, ErrorFallsWithTheFourthPowerOfTheSpacing) {
  const auto largest_error = [](int n) {
    std::vector<double> x, y;
    for (int k = 0; k < n; ++k) {
      x.push_back(k / (n - 1.0));
      y.push_back(std::sin(7 * x.back()));
    }
    const CubicTable table(x, {y});
    double error = 0;
    for (double at = 0.1; at < 0.9; at += 1e-3)
      error = std::max(error, std::abs(table(at)[0] - std::sin(7 * at)));
    return error;
  };
  EXPECT_GT(std::log2(largest_error(21) / largest_error(41)), 3.8);  // 4 in the limit of small spacings
}

TEST(CubicTable, RefusesPointsThatDoNotIncrease) {
  EXPECT_THROW(CubicTable({0, 1, 1, 2}, {{0, 0, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(CubicTable({0, 1, 2}, {{0, 0, 0}}), std::invalid_argument);
}

/// A body of a micrometre is passed by a wave in nanoseconds.
TEST(TimesOfATable, AreToldApartInAnyUnit) {
  for (const double unit : {1e-12, 1.0, 1e12}) {
    const std::vector<double> times{0, unit, 2 * unit};
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(index_of_time(times, times[k] * (1 + 1e-12)), k) << unit;
    EXPECT_THROW(static_cast<void>(index_of_time(times, 1.5 * unit)), UserMistake);
    EXPECT_EQ(reason_beyond(times, "why", 2 * unit), "");
    EXPECT_NE(reason_beyond(times, "why", 2.1 * unit), "");
  }
}

class PistonTableFile : public testing::Test {
 protected:
  void SetUp() override {
    directory =
        std::filesystem::path(testing::TempDir()) / ("fsi_piston_table_" + std::to_string(::getpid()));
    std::filesystem::create_directories(directory);
    io::Hdf5 file = io::Hdf5::create(directory / "reference.h5");
    for (const double t : {0.0, 0.5}) {
      io::Hdf5 output = file.make_group(t == 0 ? "000000" : "000001");
      output.write_attribute("t", t);
      io::Hdf5 gas = output.make_group("gas");
      for (const char* name : {"x", "rho", "v", "p"}) gas.write(name, std::vector<double>{0, 1, 2, 3});
      io::Hdf5 solid = output.make_group("solid");
      for (const char* name : {"x_bar", "u", "v", "P11", "P22"})
        solid.write(name, std::vector<double>{-3, -2, -1, 0});
    }
    file.close();
  }
  void TearDown() override { std::filesystem::remove_all(directory); }

  std::filesystem::path directory;
};

TEST_F(PistonTableFile, IsTheSolutionNamedPiston1d) {
  const auto solution = make_solution(ReferenceKind::piston_1d, {}, directory);
  EXPECT_TRUE(solution->only_at_output_times());
  EXPECT_NEAR(solution->gas(1.25, 7, 0.5).rho, 1.25, 1e-14);
  const SolidState solid = solution->solid(-0.5, 7, 0.5);
  EXPECT_NEAR(solid.u[0], -0.5, 1e-14);
  EXPECT_EQ(solid.u[1], 0);
  EXPECT_NEAR(solid.P(1, 1), -0.5, 1e-14);
}

TEST_F(PistonTableFile, SaysWhichTimesItHas) {
  const PistonTable table((directory / "reference.h5").string());
  try {
    table.gas(0, 0, 0.3);
    FAIL() << "a time that is not tabulated must be refused";
  } catch (const UserMistake& mistake) {
    EXPECT_NE(std::string(mistake.what()).find("0, 0.5"), std::string::npos) << mistake.what();
  }
}

TEST_F(PistonTableFile, OfARunThatBrokeSaysWhyNothingIsKnownBeyond) {
  {
    const PistonTable whole((directory / "reference.h5").string());
    EXPECT_EQ(whole.missing_at(0.5), "");
    EXPECT_EQ(whole.missing_at(2), "") << "a time nobody asked for is a mistake, not an end";
  }
  io::Hdf5 file = io::Hdf5::create((directory / "broken.h5").string());
  file.write_attribute("broke", std::string("t = 0.7, gas is folded"));
  io::Hdf5 output = file.make_group("000000");
  output.write_attribute("t", 0.5);
  io::Hdf5 gas = output.make_group("gas");
  for (const char* name : {"x", "rho", "v", "p"}) gas.write(name, std::vector<double>{0, 1, 2, 3});
  io::Hdf5 solid = output.make_group("solid");
  for (const char* name : {"x_bar", "u", "v", "P11", "P22"})
    solid.write(name, std::vector<double>{-3, -2, -1, 0});
  file.close();
  const PistonTable table((directory / "broken.h5").string());
  EXPECT_EQ(table.missing_at(0.5), "");
  EXPECT_EQ(table.missing_at(0.8), "the reference solution ends before: t = 0.7, gas is folded");
}

TEST(PistonTable, SaysWhichFileIsMissing) {
  try {
    make_solution(ReferenceKind::piston_1d, {}, "/nowhere");
    FAIL() << "a missing table must be refused";
  } catch (const OutputFailed& failure) {
    EXPECT_NE(std::string(failure.what()).find("/nowhere/reference.h5"), std::string::npos);
  }
}

}  // namespace
}  // namespace fsi::exact
