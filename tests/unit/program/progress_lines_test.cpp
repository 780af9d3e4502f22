#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
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

/// As that of a launcher whose own terminal takes nothing.
TEST(ProgressLines, AreLostWhereAFullPipeWouldHoldTheProgramUp) {
  std::array<int, 2> pipe_ends{};
  ASSERT_EQ(pipe(pipe_ends.data()), 0);
  const int before = dup(STDOUT_FILENO);
  dup2(pipe_ends[1], STDOUT_FILENO);
  const int flags = fcntl(STDOUT_FILENO, F_GETFL);
  fcntl(STDOUT_FILENO, F_SETFL, flags | O_NONBLOCK);
  const std::string filling(4096, '.');
  while (write(STDOUT_FILENO, filling.data(), filling.size()) > 0) continue;
  fcntl(STDOUT_FILENO, F_SETFL, flags);
  ProgressLines(1).show(1, 0.1, 0.1, "fluid");  // comes back
  dup2(before, STDOUT_FILENO);
  for (const int end : {before, pipe_ends[0], pipe_ends[1]}) close(end);
}

}  // namespace
}  // namespace fsi
