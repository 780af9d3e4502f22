#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/core/failure.hpp"
#include "common/exact/disk_table.hpp"
#include "common/io/hdf5.hpp"
#include "reference/disk_file.hpp"
#include "tests/unit/reference_disk/disk_samples.hpp"

namespace fsi::reference {
namespace {

class DiskFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    directory = std::filesystem::path(testing::TempDir()) / (std::string("fsi_disk_") + info->name());
    std::filesystem::create_directories(directory);
    fine = solve_disk(papers_disk(1, 0.3, {0, 0.4}), 100);
    errors = estimated_errors(fine, solve_disk(papers_disk(1, 0.3, {0, 0.4}), 50));
    write_disk_table((directory / "reference.h5").string(), {.outputs = fine, .broke = ""}, errors);
  }
  void TearDown() override { std::filesystem::remove_all(directory); }

  std::unique_ptr<exact::Solution> read() const {
    return exact::make_solution(ReferenceKind::rotating_disk, {{"omega_0", 0.3}, {"points", 100}},
                                directory.string());
  }

  std::filesystem::path directory;
  std::vector<DiskOutput> fine;
  std::vector<Difference> errors;
};

TEST_F(DiskFile, StartsAsTheGivenRotationOfAnUnstrainedDisk) {
  const auto solution = read();
  EXPECT_TRUE(solution->only_at_output_times());
  const auto solid = solution->solid(0.3, 0.4, 0);
  const double V = exact::angular_velocity(0.3, 0.5);
  EXPECT_NEAR((solid.v - V * Vec2(-0.4, 0.3)).norm(), 0, 1e-9);  // 0.5 is a point of the table
  EXPECT_NEAR(solid.u.norm() + solid.P.norm(), 0, 1e-12);
  EXPECT_NEAR(solution->gas(1.3, -0.4, 0).rho, 1.4, 1e-13);
}

TEST_F(DiskFile, LooksTheSameFromEveryAngle) {
  const auto solution = read();
  const double c = std::cos(2.2), s = std::sin(2.2);
  Mat2 turn;
  turn << c, -s, s, c;
  for (const double r : {0.003, 0.41, 0.987}) {
    const Vec2 x(0.6 * r, 0.8 * r), y = turn * x;
    const auto here = solution->solid(x[0], x[1], 0.4), there = solution->solid(y[0], y[1], 0.4);
    EXPECT_NEAR((turn * here.u - there.u).norm(), 0, 1e-14);
    EXPECT_NEAR((turn * here.v - there.v).norm(), 0, 1e-14);
    EXPECT_NEAR((turn * here.P * turn.transpose() - there.P).norm(), 0, 1e-13);
  }
  const auto gas = solution->gas(-0.9, 0.9, 0.4), turned = solution->gas(0.9, 0.9, 0.4);
  EXPECT_NEAR(gas.p, turned.p, 1e-14);
  EXPECT_NEAR(gas.v1, -turned.v1, 1e-14);
  EXPECT_NEAR(gas.v2, turned.v2, 1e-14);
}

TEST_F(DiskFile, IsSmoothThroughTheCentre) {
  // A fourth difference across the centre is no larger than the smooth field makes it, h^4 times a
  // derivative; a kink would leave h.
  const auto solution = read();
  const double h = 0.004;
  const auto line = [&](int k) { return solution->solid(0.8 * h * k, 0.6 * h * k, 0.4); };
  for (int k = -3; k <= 3; ++k) {
    const Vec2 u = line(k - 2).u - 4 * line(k - 1).u + 6 * line(k).u - 4 * line(k + 1).u + line(k + 2).u;
    const Mat2 P = line(k - 2).P - 4 * line(k - 1).P + 6 * line(k).P - 4 * line(k + 1).P + line(k + 2).P;
    EXPECT_LT(u.norm(), 1e-7);
    EXPECT_LT(P.norm(), 1e-4);
  }
  EXPECT_EQ(line(0).u.norm() + line(0).v.norm(), 0);
}

TEST_F(DiskFile, GasRestsBeyondTheReachOfAnyWave) {
  const auto solution = read();
  const auto gas = solution->gas(-20, 20, 0.4);
  EXPECT_NEAR(gas.rho, 1.4, 1e-12);
  EXPECT_NEAR(gas.p, 1, 1e-12);
  EXPECT_NEAR(std::hypot(gas.v1, gas.v2), 0, 1e-14);
}

TEST_F(DiskFile, SaysWhichTimesItHas) {
  const auto solution = read();
  try {
    solution->gas(1.5, 0, 0.3);
    FAIL() << "a time that is not tabulated must be refused";
  } catch (const UserMistake& mistake) {
    EXPECT_NE(std::string(mistake.what()).find("0, 0.4"), std::string::npos) << mistake.what();
  }
}

TEST_F(DiskFile, TellsItsErrorsAndWhatIsConserved) {
  const io::Hdf5 file = io::Hdf5::open((directory / "reference.h5").string());
  const io::Hdf5 first = file.group("000000"), last = file.group("000001");
  EXPECT_NEAR(last.number_attribute("angular_momentum") / first.number_attribute("angular_momentum"), 1,
              1e-12);
  EXPECT_NEAR(last.number_attribute("energy") / first.number_attribute("energy"), 1, 1e-4);  // some h^2
  EXPECT_EQ(last.number_attribute("estimated_error_P_bar"), errors[1].P_bar);
  EXPECT_GT(errors[1].P_bar, 0);
  EXPECT_EQ(file.number_attribute("estimated_error_v_bar"), std::max(errors[0].v_bar, errors[1].v_bar));
}

TEST_F(DiskFile, EstimatedErrorIsTheDistanceToAMuchFinerRun) {
  const auto exact = solve_disk(papers_disk(1, 0.3, {0, 0.4}), 1600);
  const Difference error = compare(exact[1], fine[1]);
  EXPECT_NEAR(errors[1].u_bar / error.u_bar, 1, 0.15);  // exact in the limit of many points
  EXPECT_NEAR(errors[1].P_bar / error.P_bar, 1, 0.3);
}

TEST(DiskTable, SaysWhichFileIsMissing) {
  try {
    exact::make_solution(ReferenceKind::rotating_disk, {}, "/nowhere");
    FAIL() << "a missing table must be refused";
  } catch (const OutputFailed& failure) {
    EXPECT_NE(std::string(failure.what()).find("/nowhere/reference.h5"), std::string::npos);
  }
}

}  // namespace
}  // namespace fsi::reference
