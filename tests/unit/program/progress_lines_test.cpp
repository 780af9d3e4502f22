#include <gtest/gtest.h>

#include <string>

#include "common/program/program.hpp"

namespace fsi {
namespace {

TEST(ProgressLines, GiveTimesToTheLastBit) {
  constexpr double t = 1.4300000000000044e-05, t_end = 0.1 + 0.2;
  testing::internal::CaptureStdout();
  ProgressLines(t_end).show(7, t, 1e-7, "time.growth at first");
  const std::string line = testing::internal::GetCapturedStdout();
  const auto number = [&](const std::string& key) {
    return std::stod(line.substr(line.find(key) + key.size()));
  };
  EXPECT_EQ(line.find("progress step=7 "), 0U) << line;
  EXPECT_EQ(number(" t="), t) << line;
  EXPECT_EQ(number(" t_end="), t_end) << line;
  EXPECT_NE(line.find(" limit=time.growth_at_first "), std::string::npos) << line;
}

}  // namespace
}  // namespace fsi
