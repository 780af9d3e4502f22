#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/core/input/suggest.hpp"

namespace fsi {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(edit_distance("gamma", "gamma"), 0);
  EXPECT_EQ(edit_distance("gama", "gamma"), 1);
  EXPECT_EQ(edit_distance("gammma", "gamma"), 1);
  EXPECT_EQ(edit_distance("gamna", "gamma"), 1);
  EXPECT_EQ(edit_distance("gxmya", "gamma"), 2);
  EXPECT_EQ(edit_distance("tiem", "time"), 1);
  EXPECT_EQ(edit_distance("", "abc"), 3);
}

TEST(EditDistance, IsTheSameBothWays) {
  EXPECT_EQ(edit_distance("linear", "liner_"), edit_distance("liner_", "linear"));
}

TEST(Suggestion, IsTheNearestWordAndNothingWhenNoneIsNear) {
  const std::vector<std::string> words{"end", "cfl", "growth", "multirate"};
  EXPECT_EQ(closest("ende", words), "end");
  EXPECT_EQ(closest("growht", words), "growth");
  EXPECT_EQ(closest("multi", words), "multirate");
  EXPECT_EQ(closest("zzz", words), "");
  EXPECT_EQ(closest("", words), "");
  EXPECT_EQ(did_you_mean("ende", words), "; did you mean `end`?");
  EXPECT_EQ(did_you_mean("zzz", words), "");
}

TEST(ShownText, StaysOnOneLineAndIsCutWhereItIsLong) {
  EXPECT_EQ(shown("a\nb\tc"), "a?b?c");
  EXPECT_LT(shown(std::string(1000, 'a')).size(), 100U);
}

}  // namespace
}  // namespace fsi
