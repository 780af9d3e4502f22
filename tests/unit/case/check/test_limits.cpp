// What no case needs is refused with its place, before it costs time, memory, or a folder.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "common/case/report/memory.hpp"
#include "common/core/failure.hpp"
#include "common/core/input/suggest.hpp"
#include "common/core/input/text_file.hpp"
#include "tests/unit/case/cases.hpp"
#include "tests/unit/case/odd_files.hpp"

namespace fsi {
namespace {

const std::string gas_alone =
    "time: {end: 1}\n"
    "fluid:\n"
    "  grid: {x: [0, 1], y: [0, 1], points: [5, 5]}\n"
    "  boundary: {left: outflow, right: outflow, bottom: symmetry, top: symmetry}\n"
    "  initial: {rho: 1, v: [0, 0], p: 1}\n";

std::string lines(const std::string& first, int count, const std::string& format) {
  std::string text = first;
  for (int k = 1; k < count; ++k) text += fmt::format(fmt::runtime(format), k, k - 1);
  return text;
}

void expect_mistake(const std::string& text, const std::string& place, const std::string& what) {
  const std::string mistake = tests::mistake_in(text);
  EXPECT_TRUE(mistake.starts_with(place)) << mistake;
  EXPECT_NE(mistake.find(what), std::string::npos) << mistake;
  EXPECT_LT(mistake.size(), 500U);
}

TEST(CaseLimits, LongChainsOfParametersAndDefinitionsAreRefused) {
  EXPECT_EQ(tests::mistake_in(gas_alone + lines("parameters:\n  a0: 1\n", 900, "  a{}: a{} + 1\n")), "");
  // written the other way round, every one needs all below it first
  std::string down = gas_alone + "parameters:\n";
  for (int k = 20'000; k > 0; --k) down += fmt::format("  a{}: a{} + 1\n", k, k - 1);
  expect_mistake(down + "  a0: 1\n", "case.yaml:1007:3: ", "more than 1000 keys in one section");
  std::string shorter = gas_alone + "parameters:\n";
  for (int k = 900; k > 0; --k) shorter += fmt::format("  a{}: a{} + 1\n", k, k - 1);
  expect_mistake(shorter + "  a0: 1\n",
                 "case.yaml:107:", "parameters need each other more than 100 deep: a900 ->");
  expect_mistake(gas_alone + lines("definitions:\n  a0: x\n", 200, "  a{}: a{} + 1\n"),
                 "case.yaml:", "more than 100");
}

TEST(CaseLimits, DefinitionsThatDoubleEachOtherCostNoMoreThanTheyAre) {
  EXPECT_EQ(tests::mistake_in(gas_alone + lines("definitions:\n  a0: x\n", 90, "  a{0}: a{1} + a{1}\n")), "");
}

TEST(CaseLimits, ManyParametersAreRefusedAndAThousandAreFine) {
  expect_mistake(gas_alone + lines("parameters:\n  a0: 1\n", 200'000, "  a{}: 1\n"),
                 "case.yaml:1007:3: ", "more than 1000 keys in one section");
  EXPECT_EQ(tests::mistake_in(gas_alone + lines("parameters:\n  a0: 1\n", 1000, "  a{}: 1 + 1\n")), "");
}

TEST(CaseLimits, DepthLengthAndAliasesAreRefusedWithTheirPlace) {
  expect_mistake("title: " + std::string(30, '[') + std::string(30, ']') + "\n", "case.yaml:1:3",
                 "more than 24 sections and lists");
  expect_mistake("title: " + std::string(1'000'000, '[') + "\n",
                 "case.yaml:1:1008: ", "more than 1000 brackets");
  std::string nested = gas_alone + "deep:";
  for (int k = 1; k < 1000; ++k) nested += "\n" + std::string(static_cast<std::size_t>(k), ' ') + "a:";
  expect_mistake(nested + " 1\n", "case.yaml:", "more than 24 sections and lists");
  expect_mistake(gas_alone + "title: " + std::string(100'000, 'x') + "\n",
                 "case.yaml:6:8: ", "more than 16384 characters in one value");
  expect_mistake("a: &a [x, x]\nb: [*a, *a]\n", "case.yaml:2:5: ", "aliases");
  std::string list = "output: {times: [";
  for (int k = 0; k < 30'000; ++k) list += "1, ";
  expect_mistake(gas_alone + list + "1]}\n", "case.yaml:6:", "more than 20000 entries in one list");
  expect_mistake(gas_alone + "# " + std::string(5'000'000, 'x'),
                 "case.yaml:1:1: ", "is longer than 4194304 bytes");
}

TEST(CaseLimits, BytesThatAreNoTextAreNamedWithTheirPlace) {
  expect_mistake(gas_alone + "title: caf\xe9\n", "case.yaml:6:11: ", "byte 0xe9 is not UTF-8");
  expect_mistake(gas_alone + "title: a" + std::string(1, '\0') + "b\n", "case.yaml:6:9: ", "byte 0x00");
  EXPECT_EQ(tests::mistake_in(gas_alone + "title: \"caf\xc3\xa9, \xe2\x82\xac, \xf0\x9f\x8c\x8a\"\n"), "");
  for (const char* bad : {"\xc0\x80", "\xe0\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80",
                          "\x80", "\xe2\x82"})
    EXPECT_EQ(first_bad_byte(std::string("ab") + bad), 2U);
}

TEST(CaseLimits, NamesFitFilesAndCommandLines) {
  expect_mistake("name: " + std::string(300, 'n') + "\n" + gas_alone, "case.yaml:1:7: name: ",
                 "has 300 characters; it becomes part of the names of files, at most 100 fit");
  expect_mistake("name: -rf\n" + gas_alone, "case.yaml:1:7: name: ", "these two not first");
  expect_mistake(
      gas_alone + "output: {probes: [{name: " + std::string(300, 'p') + ", in: fluid, x: 0.5, y: 0.5}]}\n",
      "case.yaml:6:", "has 300 characters");
  const tests::TemporaryFolder folder;
  EXPECT_EQ(load_case(folder.write("-rf.yaml", gas_alone)).name, "_rf");
  EXPECT_EQ(load_case(folder.write(std::string(200, 'n') + ".yaml", gas_alone)).name, std::string(100, 'n'));
}

TEST(CaseLimits, StepsThatWouldNeverReachTheEndAreRefused) {
  const std::string rest = gas_alone.substr(gas_alone.find("fluid:"));
  expect_mistake("time: {end: 1, dt: 1e-300}\n" + rest,
                 "case.yaml:1:20: time.dt: ", "at most 1e+09 are possible");
  expect_mistake("time: {end: 1, cfl: 1e-300}\n" + rest, "case.yaml:1:21: time.cfl: ", "must be >= 0.0001");
  EXPECT_EQ(tests::mistake_in("time: {end: 1, dt: 1e-8}\n" + rest), "");
}

/// The mistake that a path is.
std::string mistake_of_path(const std::string& path) {
  try {
    load_case(path);
    return "";
  } catch (const UserMistake& mistake) {
    return mistake.what();
  }
}

TEST(CaseLookup, NamesTheNearestFileOfTheSameFolder) {
  const tests::TemporaryFolder folder;
  const std::string file = tests::path_in(folder, "guitar.yaml");
  std::ofstream(file) << "title: none\n";
  for (const char* name : {"guitr.yaml", "guitar"}) {
    const std::string meant = tests::path_in(folder, name);
    EXPECT_EQ(mistake_of_path(meant),
              in_ticks(meant) + ": no such case; did you mean " + in_ticks(file) + "?");
  }
}

TEST(CaseLimits, WhatIsNoFileIsCalledWhatItIs) {
  const tests::TemporaryFolder folder;
  EXPECT_EQ(mistake_of_path(tests::make_pipe(folder, "pipe.yaml")),
            tests::path_in(folder, "pipe.yaml") + ": is a pipe, not a case file");
  EXPECT_EQ(mistake_of_path(tests::make_loop(folder, "loop.yaml")),
            tests::path_in(folder, "loop.yaml") + ": is a link that leads nowhere, not a case file");
  EXPECT_EQ(mistake_of_path(tests::path_in(folder, "")),
            tests::path_in(folder, "") + ": is a folder, not a case file");
  EXPECT_EQ(mistake_of_path("/dev/zero"), "/dev/zero: is a device, not a case file");
  EXPECT_NE(mistake_of_path(tests::path_in(folder, "nothing.yaml")).find("no such case"), std::string::npos);
  EXPECT_EQ(read_text_file(tests::path_in(folder, "nothing.yaml"), 10).trouble,
            "cannot be read: No such file or directory");
}

/// A wall through the points of a file.
std::string wall_of(const std::string& file) {
  return "time: {end: 1}\nfluid:\n  grid: {name: box, x: [-2, 2], y: [-2, 2], spacing: 0.1}\n"
         "  body_fitted: [{name: wall, shape: {kind: spline, file: " +
         file +
         "}}]\n"
         "  boundary: {left: outflow, right: outflow, bottom: symmetry, top: symmetry}\n"
         "  initial: {rho: 1, v: [0, 0], p: 1}\n";
}

TEST(CaseLimits, FilesOfPointsThatAreNoneOrEndlessAreRefusedWhereTheyAreNamed) {
  const tests::TemporaryFolder folder;
  std::string million;
  for (int k = 0; k < 1'000'000; ++k) million += "1,2\n";
  folder.write("million.csv", million);
  folder.write("many.csv", million.substr(0, std::size_t{4} * 30'000));
  tests::make_pipe(folder, "pipe.csv");
  tests::make_loop(folder, "loop.csv");
  const std::string place = "/case.yaml:4:58: fluid.body_fitted[0].shape.file: ";
  const auto expect = [&](const std::string& file, const std::string& what) {
    const std::string mistake = mistake_of_path(folder.write("case.yaml", wall_of(file)));
    EXPECT_NE(mistake.find(place), std::string::npos) << mistake;
    EXPECT_NE(mistake.find(what), std::string::npos) << mistake;
  };
  expect("/dev/zero", "is a device");
  expect("pipe.csv", "is a pipe");
  expect("loop.csv", "is a link that leads nowhere");
  expect(".", "is a folder");
  expect("many.csv", "has 30000 points; at most 20000 are possible: keep one in 2");
  expect("million.csv", "has 1000000 points; at most 20000 are possible: keep one in 50");
}

TEST(CaseMemory, IsRefusedByNameWithWhatWouldFit) {
  const std::string text =
      "time: {end: 1}\n"
      "fluid:\n"
      "  grid: {x: [0, 1], y: [0, 1], points: [100000, 100000]}\n" +
      gas_alone.substr(gas_alone.find("  boundary"));
  const tests::TemporaryFolder folder;
  const std::string path = folder.write("case.yaml", text);
  try {
    load_case_within(16e9, path);
    FAIL() << "10 billion points fit nowhere";
  } catch (const UserMistake& mistake) {
    const std::string message = mistake.what();
    EXPECT_NE(message.find("/case.yaml:3:9: fluid.grid: 1e+10 points need about "), std::string::npos)
        << message;
    EXPECT_NE(message.find("(fluid "), std::string::npos) << message;
    EXPECT_NE(message.find("16.0 GB are free, which is enough for about "), std::string::npos) << message;
  }
}

TEST(CaseMemory, OfASolidIsNamedWithTheSolid) {
  try {
    load_case_within(16e9, "elastic_piston", {"solids.solid.grid.spacing=2e-5"});
    FAIL() << "too many points";
  } catch (const UserMistake& mistake) {
    EXPECT_NE(std::string(mistake.what()).find("solids.solid.grid: "), std::string::npos) << mistake.what();
  }
}

TEST(CaseMemory, WhatWouldFitDoes) {
  const double all = total_memory(load_case("shock_ellipse"));
  EXPECT_NO_THROW(load_case_within(1.001 * all, "shock_ellipse"));
  EXPECT_THROW(load_case_within(0.999 * all, "shock_ellipse"), UserMistake);
  EXPECT_GT(available_memory(), 1e6);
}

TEST(CasePeriodic, SidesBesideAnInterfaceArePeriodicInGasAndSolidOrInNeither) {
  const std::vector<std::string> gas = {"fluid.boundary.bottom=periodic", "fluid.boundary.top=periodic"};
  std::vector<std::string> both = gas;
  both.insert(both.end(), {"solids.solid.boundary.bottom=periodic", "solids.solid.boundary.top=periodic"});
  EXPECT_NO_THROW(load_case("elastic_piston", both));
  try {
    load_case("elastic_piston", gas);
    FAIL() << "the solid ends where the gas goes on";
  } catch (const UserMistake& mistake) {
    EXPECT_NE(std::string(mistake.what())
                  .find("solids.solid.boundary: the sides beside the interface are not periodic, "
                        "those of the gas are"),
              std::string::npos)
        << mistake.what();
  }
}

}  // namespace
}  // namespace fsi
