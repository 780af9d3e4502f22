// A case file as a rotating disk.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/core/failure.hpp"
#include "reference/disk_case.hpp"

namespace fsi::reference {
namespace {

class DiskCase : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    path = testing::TempDir() + "fsi_disk_case_" + info->name() + ".yaml";
  }
  void TearDown() override { std::filesystem::remove(path); }

  /// The pieces a test varies; of the grids the reference takes no notice, but for the outline.
  Case read(const std::string& v, const std::string& reference, const std::string& rho = "14",
            const std::string& rim = "interface", const std::string& circle = "radius: 1",
            const std::string& more = "}") {
    std::ofstream(path) << R"(
title: rotating disk
parameters: {omega_0: 0.2}
grid: {factor: 2}
time: {end: 1}
fluid:
  gamma: 1.4
  p_e: 10
  grid: {name: background, x: [-2, 2], y: [-2, 2], spacing: h}
  body_fitted:
    - {name: ring, solid: disk, lines: 8}
  boundary: {left: outflow, right: outflow, bottom: outflow, top: outflow}
  initial: {rho: )" << rho
                        << R"(, v: [0, 0], p: 10}
solids:
  disk:
    law: neo_hookean
    rho: 2
    lambda: 3
    mu: 4
    shape: {kind: circle, )"
                        << circle << R"(}
    grid: {name: core, x: [-1.5, 1.5], y: [-1.5, 1.5], spacing: h}
    body_fitted: {lines: 8, boundary: )"
                        << rim << R"(}
    initial: {v: )" << v << more
                        << R"(
reference: {kind: rotating_disk, )"
                        << reference << R"(}
output: {times: [0.5]}
)";
    return load_case(path);
  }

  template <class Read>
  void expect_mistake(const Read& read_case, const std::string& word) {
    try {
      read_case();
      FAIL() << "must be refused";
    } catch (const UserMistake& mistake) {
      const std::string words = mistake.what();
      EXPECT_NE(words.find(word), std::string::npos) << words;
      EXPECT_EQ(words.find(path), 0U) << words;
    }
  }

  std::string path;
  const std::string rotation =
      R"(["-y * omega_0 * (4 * r * (1 - r))^4", "x * omega_0 * (4 * r * (1 - r))^4"])";
};

TEST_F(DiskCase, TakesMaterialGasMotionAndTimesFromTheFile) {
  const Case problem = read(rotation, "omega_0: omega_0, b: 1.75, points: 400");
  const DiskProblem disk = disk_from_case(problem);
  EXPECT_EQ(disk.material.law, "neo_hookean");
  EXPECT_EQ(disk.material.rho_bar, 2);
  EXPECT_EQ(disk.material.lambda, 3);
  EXPECT_EQ(disk.material.mu, 4);
  EXPECT_EQ(disk.gamma, 1.4);
  EXPECT_EQ(disk.rho_0, 14);
  EXPECT_EQ(disk.p_0, 10);
  EXPECT_EQ(disk.p_e, 10);
  EXPECT_EQ(disk.b, 1.75);
  EXPECT_DOUBLE_EQ(disk.v_theta(0.5), 0.1);  // V = omega_0 at half the radius
  EXPECT_EQ(disk.times, (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(disk_points_from_case(problem), 400);
}

TEST_F(DiskCase, WithoutAWallTheGasHasNoEnd) {
  const Case problem = read(rotation, "omega_0: omega_0");
  EXPECT_EQ(disk_from_case(problem).b, 0);
  EXPECT_EQ(disk_points_from_case(problem), 3200);
}

TEST_F(DiskCase, TheGasPressesOnTheConfigurationTheCaseNames) {
  EXPECT_FALSE(disk_from_case(read(rotation, "omega_0: omega_0")).load_on_reference);
  const Case problem = read(rotation, "omega_0: omega_0", "14", "{kind: interface, load: reference}");
  EXPECT_TRUE(disk_from_case(problem).load_on_reference);
}

TEST_F(DiskCase, AnotherMotionOfTheSolidIsRefused) {
  expect_mistake([this] { return read(R"(["-y", x])", "omega_0: omega_0"); }, "solids.disk.initial.v: ");
  expect_mistake([this] { return read(rotation, "omega_0: 0.3"); }, "solids.disk.initial.v: ");
}

TEST_F(DiskCase, ADiskAtRestIsNotTheOneThatTurns) {
  expect_mistake([this] { return read("[0, 0]", "omega_0: omega_0"); }, "solids.disk.initial.v: ");
  EXPECT_NO_THROW(read("[0, 0]", "omega_0: 0"));
}

TEST_F(DiskCase, AnOutlineThatIsNotTheUnitCircleIsRefused) {
  const auto with = [this](const std::string& circle) {
    return read(rotation, "omega_0: omega_0", "14", "interface", circle);
  };
  expect_mistake([&] { return with("radius: 1.1"); }, "solids.disk.shape: ");
  expect_mistake([&] { return with("radius: 1, centre: [0.1, 0]"); }, "solids.disk.shape: ");
}

TEST_F(DiskCase, AForceOrADisplacementAtTheStartIsRefused) {
  const auto with = [this](const std::string& more) {
    return read(rotation, "omega_0: omega_0", "14", "interface", "radius: 1", more);
  };
  EXPECT_NO_THROW(disk_from_case(with(", u: [0, 0]}")));
  expect_mistake([&] { return with(", u: [0, 0.01 * (1 - x^2 - y^2)]}"); }, "solids.disk.initial.u: ");
  expect_mistake([&] { return with("}\n    body_force: [0, 0.2]"); }, "solids.disk.body_force: ");
}

TEST_F(DiskCase, AGasThatIsNotUniformIsRefused) {
  expect_mistake([this] { return read(rotation, "omega_0: omega_0", "14 + x"); }, "fluid.initial: ");
}

TEST_F(DiskCase, AWallInsideTheDiskIsRefused) {
  EXPECT_THROW(read(rotation, "omega_0: omega_0, b: 0.9"), UserMistake);
}

}  // namespace
}  // namespace fsi::reference
