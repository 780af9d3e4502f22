#include <gtest/gtest.h>

#include <set>
#include <string>

#include "common/case/case.hpp"
#include "common/core/choices.hpp"
#include "common/core/failure.hpp"

namespace fsi {
namespace {

Case with(const std::string& setting) {
  return load_case(FSI_ROOT "/configs/plate.yaml", {setting});
}

/// Every name of a table, written into a case, arrives as its value; another word is refused.
template <Choice E, class Chosen>
void arrives(const std::string& key, const Chosen& chosen) {
  std::set<std::string_view> names;
  std::set<E> values;
  for (const auto& [value, name] : names_of<E>) {
    EXPECT_EQ(chosen(with(key + "=" + std::string(name))), value) << name;
    EXPECT_EQ(name_of(value), name);
    EXPECT_EQ(named<E>(name), value);
    names.insert(name);
    values.insert(value);
  }
  EXPECT_EQ(names.size(), names_of<E>.size());
  EXPECT_EQ(values.size(), names_of<E>.size());
  EXPECT_FALSE(named<E>("nothing_like_that"));
  EXPECT_THROW(with(key + "=nothing_like_that"), UserMistake);
}

TEST(Choices, ArriveAsTheyAreWritten) {
  arrives<RiemannSolver>("fluid.scheme.riemann",
                         [](const Case& c) { return c.fluids.front().scheme.riemann; });
  arrives<GasLimiter>("fluid.scheme.limiter", [](const Case& c) { return c.fluids.front().scheme.limiter; });
  arrives<SolidLimiter>("solids.plate.scheme.limiter",
                        [](const Case& c) { return c.solids.front().scheme.limiter; });
  arrives<GasResponse>("interface.riemann", [](const Case& c) { return c.interface.riemann; });
}

TEST(Choices, OfAProjectionArriveWhereASolidDeforms) {
  for (const auto& [value, name] : names_of<Projection>) {
    const Case problem =
        load_case(FSI_ROOT "/configs/elastic_piston.yaml", {"interface.projection=" + std::string(name)});
    EXPECT_EQ(problem.interface.projection, value) << name;
  }
}

TEST(Choices, OfABeamsEndsArrive) {
  for (const auto& [value, name] : names_of<BeamEnd>) {
    const Case problem = with("solids.plate.beam.ends=[guided, " + std::string(name) + "]");
    EXPECT_EQ(problem.solids.front().beam->ends[1], value) << name;
    EXPECT_EQ(problem.solids.front().beam->ends[0], BeamEnd::guided);
  }
}

}  // namespace
}  // namespace fsi
