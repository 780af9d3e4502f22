#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "common/core/input/expression.hpp"

namespace fsi {
namespace {

using Constants = std::map<std::string, double>;
using Definitions = std::map<std::string, std::string>;

std::string mistake_of(const std::string& text, const Constants& constants = {},
                       const Definitions& definitions = {}) {
  try {
    const Expression expression(text, constants, definitions);
    return "";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(Expression, KnowsThePlaceAndTheTime) {
  const Expression e("x + 10 * y + 100 * t", {});
  EXPECT_DOUBLE_EQ(e(1, 2, 3), 321);
  EXPECT_DOUBLE_EQ(Expression("r", {})(3, 4, 0), 5);
}

TEST(Expression, OfAGridMappingKnowsItsParameters) {
  const Expression e("2 * r + 3 * s + t", {});
  EXPECT_DOUBLE_EQ(e.at_parameters(0.5, 0.25, 10), 11.75);
}

TEST(Expression, RespectsPrecedence) {
  EXPECT_DOUBLE_EQ(Expression("-2^2", {})(0, 0, 0), -4);
  EXPECT_DOUBLE_EQ(Expression("2^3^2", {})(0, 0, 0), 512);
  EXPECT_DOUBLE_EQ(Expression("6 / 2 * 3", {})(0, 0, 0), 9);
  EXPECT_DOUBLE_EQ(Expression("1 - 2 - 3", {})(0, 0, 0), -4);
  EXPECT_DOUBLE_EQ(Expression("x < 1 ? 5 : 7", {})(0, 0, 0), 5);
}

TEST(Expression, KnowsPiParametersAndRounding) {
  EXPECT_NEAR(Expression("sin(pi / 6)", {})(0, 0, 0), 0.5, 1e-15);  // round-off of one sine
  EXPECT_DOUBLE_EQ(Expression("gamma / delta", {{"gamma", 1.4}, {"delta", 0.1}})(0, 0, 0), 14);
  EXPECT_DOUBLE_EQ(Expression("round(2.6) + floor(2.6) + ceil(2.2)", {})(0, 0, 0), 8);
}

TEST(Expression, MayUseDefinitionsOfDefinitions) {
  const Definitions definitions{
      {"speed", "2 * factor * radius"}, {"radius", "x^2 + y^2"}, {"unused", "nonsense("}};
  const Expression e("speed + radius", {{"factor", 3}}, definitions);
  EXPECT_DOUBLE_EQ(e(1, 2, 0), 35);
  EXPECT_TRUE(e.uses("x"));
  EXPECT_FALSE(e.uses("t"));
}

TEST(Expression, FollowsEveryVariableThroughDefinitionsThatAreKept) {
  const Definitions definitions = {{"beat", "3 + t"}, {"wave", "beat * x"}, {"far", "wave + r"}};
  const Expression e("far + 7 * y", {}, definitions);
  for (const double t : {0.0, 1.0, 1.0, 0.0}) {
    for (const double x : {3.0, 5.0, 3.0}) {
      for (const double y : {4.0, 12.0}) {
        EXPECT_DOUBLE_EQ(e(x, y, t), (3 + t) * x + std::hypot(x, y) + 7 * y);
      }
    }
  }
  EXPECT_TRUE(e.uses("t") && e.uses("x") && e.uses("y") && e.uses("r"));
  EXPECT_FALSE(e.uses("s") || e.uses("beat"));
}

TEST(Expression, RefusesDefinitionsThatGoRoundInACircle) {
  const Definitions definitions{{"a", "b + 1"}, {"b", "2 * c"}, {"c", "a"}};
  EXPECT_EQ(mistake_of("1 + b", {}, definitions), "definitions go round in a circle: b -> c -> a -> b");
  EXPECT_NE(mistake_of("self", {}, {{"self", "self"}}), "");
}

TEST(Expression, NamesWhatItDoesNotKnow) {
  EXPECT_EQ(mistake_of("2 * gama", {{"gamma", 1.4}}),
            "unknown name `gama` at position 5 of `2 * gama`; did you mean `gamma`?");
  EXPECT_EQ(mistake_of("sine(x)", {}), "unknown name `sine` at position 1 of `sine(x)`; did you mean `sin`?");
  EXPECT_EQ(mistake_of("w", {}, {{"wave", "x"}}), "unknown name `w` at position 1 of `w`");
  EXPECT_EQ(mistake_of("f", {}, {{"f", "1 + zz"}}),
            "in definition `f`: unknown name `zz` at position 5 of `1 + zz`");
}

TEST(Expression, SaysHowWordsOfOtherLanguagesAreWrittenHere) {
  EXPECT_EQ(mistake_of("x < 0 and y > 0", {}),
            "unknown name `and` at position 7 of `x < 0 and y > 0`; write `&&`");
  EXPECT_NE(mistake_of("x < y or y > 0", {}).find("; write `||`"), std::string::npos);
  EXPECT_NE(mistake_of("pow(x, 2)", {}).find("; write `x^2` for pow(x, 2)"), std::string::npos);
  EXPECT_EQ(mistake_of("1 + abs x", {}), "`abs` at position 5 of `1 + abs x` is a function: write `abs(..)`");
}

TEST(Expression, TakesAWordBehindANumberForAUnit) {
  EXPECT_EQ(
      mistake_of("1ms", {}),
      "unknown name `ms` at position 2 of `1ms`; numbers have no units here: in m, kg and s it is 0.001");
  EXPECT_NE(mistake_of("2 MPa", {}).find("it is 2000000"), std::string::npos);
  EXPECT_NE(mistake_of("x < 0 ? 5 bar : 1e5", {}).find("it is 500000"), std::string::npos);
  EXPECT_NE(mistake_of("1.1 g/cm^3", {}).find("write the number in the units of the others"),
            std::string::npos);
  EXPECT_EQ(
      mistake_of("2 * 1.5e-3 mm", {{"m2", 1}}),
      "unknown name `mm` at position 12 of `2 * 1.5e-3 mm`; numbers have no units here: in m, kg and s it is "
      "1.5e-06");
  EXPECT_EQ(mistake_of("m2 + rr", {{"m2", 1}}),
            "unknown name `rr` at position 6 of `m2 + rr`; did you mean `r`?");
}

TEST(Expression, SaysWhatIsWrongWithAFormula) {
  for (const std::string text :
       {"",      " ",    "1 +",   "* 2",   "(1 + 2", "1 + 2)", "2 x", "sin()", "sin(1, 2)", "1, 2",
        "x = 3", "1..2", "\"a\"", "1 ? 2", "max()",  "#",      "x y", "2(3)",  ")(",        "sin"}) {
    EXPECT_NE(mistake_of(text), "") << text;
  }
  EXPECT_EQ(mistake_of("(1 + 2"), "`(1 + 2` has an open parenthesis that is never closed");
  EXPECT_EQ(mistake_of("x = 3"),
            "`=` at position 3 of `x = 3`: a formula cannot assign; to compare write ==");
}

TEST(Expression, ComparesWithoutAssigning) {
  EXPECT_DOUBLE_EQ(Expression("x == 1 ? 2 : 3", {})(1, 0, 0), 2);
  EXPECT_DOUBLE_EQ(Expression("x <= 1 && y >= 0 ? 2 : 3", {})(1, 0, 0), 2);
  EXPECT_DOUBLE_EQ(Expression("x != 1 ? 2 : 3", {})(1, 0, 0), 3);
}

TEST(Expression, CopiesShareNothing) {
  const Expression original("x * a + w", {{"a", 2}}, {{"w", "t^2"}});
  std::vector<double> results(4);
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k) {
    threads.emplace_back([copy = original, k, &results] {
      double sum = 0;
      for (int n = 0; n < 1000; ++n) sum += copy(k, 0, 1);
      results[static_cast<std::size_t>(k)] = sum / 1000;
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (int k = 0; k < 4; ++k) EXPECT_DOUBLE_EQ(results[static_cast<std::size_t>(k)], 2 * k + 1);
  Expression assigned;
  assigned = original;
  EXPECT_EQ(assigned.text(), original.text());
  EXPECT_DOUBLE_EQ(assigned(3, 0, 2), 10);
}

TEST(NamesOfAnExpression, LeaveNumbersWithExponentsOut) {
  const std::set<std::string> names = names_in("1e-3 * a_1 + 2.5E+4 / sin(x1) - .5e2 + 3e");
  EXPECT_EQ(names, (std::set<std::string>{"a_1", "sin", "x1", "e"}));
}

}  // namespace
}  // namespace fsi
