#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/core/failure.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/csv_writer.hpp"
#include "common/io/part.hpp"
#include "common/io/place_json.hpp"
#include "tests/unit/io/scratch.hpp"

namespace fsi::io {
namespace {

class AtomicFile : public InScratch {};
class Csv : public InScratch {};
class PartFile : public InScratch {};

TEST_F(AtomicFile, ReplacesTheWholeText) {
  write_atomically(dir + "/a.json", "a long first text\n");
  write_atomically(dir + "/a.json", "short\n");
  EXPECT_EQ(content(dir + "/a.json"), "short\n");
  EXPECT_FALSE(std::filesystem::exists(aside(dir + "/a.json")));
}

TEST_F(AtomicFile, KeepsTheOldTextWhenTheNewOneCannotBeWritten) {
  write_atomically(dir + "/a.json", "old\n");
  std::filesystem::create_directories(aside(dir + "/a.json"));  // nothing can be written aside
  EXPECT_THROW(write_atomically(dir + "/a.json", "new\n"), OutputFailed);
  EXPECT_EQ(content(dir + "/a.json"), "old\n");
}

TEST_F(AtomicFile, NamesThePathTheReasonAndTheRemedy) {
  try {
    write_atomically(occupied_place(dir) + "/a.json", "text");
    FAIL() << "must not write";
  } catch (const OutputFailed& failure) {
    const std::string message = failure.what();
    EXPECT_NE(message.find("occupied/a.json"), std::string::npos) << message;
    EXPECT_NE(message.find("Not a directory"), std::string::npos) << message;
    EXPECT_NE(message.find("check"), std::string::npos) << message;
  }
}

TEST_F(Csv, NumbersReadBackExactly) {
  const double third = 1.0 / 3;
  {
    CsvWriter csv(dir + "/probes.csv", {"t [time]", "p [force/area]"});
    csv.row({0.1, third});
  }
  const std::string text = content(dir + "/probes.csv");
  EXPECT_EQ(text.substr(0, text.find('\n')), "t [time],p [force/area]");
  const std::string line = text.substr(text.find('\n') + 1);
  EXPECT_EQ(std::stod(line), 0.1);
  EXPECT_EQ(std::stod(line.substr(line.find(',') + 1)), third);
}

TEST_F(Csv, AKillLosesAtMostOneBatchAndNeverLeavesHalfALine) {
  CsvWriter csv(dir + "/interface.csv", {"step", "gap"}, Opening::fresh, 4);
  for (int k = 0; k < 11; ++k) {
    csv.row({static_cast<double>(k), 0.5});
    const std::string on_disk = content(dir + "/interface.csv");  // what a kill now would leave
    EXPECT_EQ(on_disk.back(), '\n');
    EXPECT_EQ(std::ranges::count(on_disk, '\n'), 1 + (k + 1) / 4 * 4);
  }
  csv.flush();
  EXPECT_EQ(std::ranges::count(content(dir + "/interface.csv"), '\n'), 12);
}

TEST_F(Csv, AWordIsTheLastColumn) {
  CsvWriter csv(dir + "/a.csv", {"t", "x", "who"});
  const std::array values = {1.0, 2.5};
  csv.row(values, "fluid");
  EXPECT_THROW(csv.row(values), std::logic_error);
  csv.flush();
  EXPECT_EQ(content(dir + "/a.csv"), "t,x,who\n1,2.5,fluid\n");
}

TEST_F(Csv, RefusesALineOfTheWrongLength) {
  CsvWriter csv(dir + "/a.csv", {"t", "x"});
  EXPECT_THROW(csv.row({1}), std::logic_error);
}

TEST_F(Csv, SaysWhenTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  try {
    CsvWriter csv("/dev/full", {"t"});
    FAIL() << "a full disk must be noticed";
  } catch (const OutputFailed& failure) {
    EXPECT_NE(std::string(failure.what()).find("space"), std::string::npos);
  }
}

TEST_F(PartFile, HoldsWhatTheProgramKnowsOfTheRun) {
  Part part;
  part.participant = part.role = "fluid";
  part.t = 0.8;
  part.points = 1200;
  part.errors["rho"] = 2e-6;
  part.counters["floors"] = 0;
  write_part(dir, part);
  const std::string text = content(dir + "/parts/fluid.json");
  EXPECT_NE(text.find("\"t\": 0.8"), std::string::npos) << text;
  EXPECT_NE(text.find("\"points\": 1200"), std::string::npos);
  EXPECT_NE(text.find("\"rho\": 2e-06"), std::string::npos);
  EXPECT_EQ(text.find("\"interface\""), std::string::npos) << "only the coupler has one";
}

TEST_F(PartFile, OfAFailureSaysWhyAndKeepsTheJsonValid) {
  Part part;
  part.participant = part.role = "coupler";
  part.status = "failed";
  part.exit_code = ExitCode::diverged;
  part.reason = "step 412, t = 1.37, grid \"beam\", point (14, 3): det F = -0.02";
  part.failure = {.place = {.step = 412,
                            .t = 1.37,
                            .grid = "beam",
                            .point = {14, 3},
                            .position = {0.5, 0.25},
                            .of_reference = true},
                  .what = "det F = -0.02"};
  part.dt_min = std::numeric_limits<double>::quiet_NaN();
  part.interface = InterfaceExtremes{.max_velocity_jump = 1, .max_traction_jump = 2, .max_gap = 3};
  const std::string text = to_json(part);
  EXPECT_NE(text.find("\"exit_code\": 3"), std::string::npos);
  EXPECT_NE(text.find(R"(grid \"beam\")"), std::string::npos) << text;
  EXPECT_NE(text.find("\"reference_position\": ["), std::string::npos) << text;
  EXPECT_NE(text.find("\"dt_min\": null"), std::string::npos);
  EXPECT_NE(text.find("\"max_gap\": 3"), std::string::npos);
}

TEST(FailureWithItsPlace, LearnsWhatWasNotKnownAndKeepsWhatWas) {
  Diverged failure("det F = -0.02", {.t = 1.5, .grid = "beam", .point = {14, 3}});
  failure.know({.step = 412, .t = 9, .position = {0.5, 0.25}, .of_reference = true});
  EXPECT_STREQ(failure.what(),
               "step 412, t = 1.5, grid \"beam\", point (14, 3) of the reference (0.5, 0.25): det F = -0.02");
  failure.advise("a smaller step");
  EXPECT_EQ(failure.cause(), "det F = -0.02; try a smaller step");
}

TEST(FailureWithItsPlace, IsToldInWordsWithoutWhatIsNotKnown) {
  EXPECT_EQ(sentence_of({}, "no more"), "no more");
  EXPECT_EQ(sentence_of({.t = 0.5, .program = "disk", .interface = "disk", .point = {7}}, "p is nan"),
            "t = 0.5, \"disk\" at interface \"disk\", point 7: p is nan");
  EXPECT_EQ(sentence_of({.position = {1, 2}}, "folded"), "at (1, 2): folded");
  const Failure heard(ExitCode::diverged, "p < 0", {.step = 3}, "fluid");
  EXPECT_STREQ(heard.what(), "fluid: step 3: p < 0");
}

TEST(FailureWithItsPlace, ComesBackFromJson) {
  const Place place{.step = 3,
                    .t = 0.5,
                    .program = "disk",
                    .interface = "beam",
                    .grid = "ring",
                    .point = {1, 2},
                    .position = {0.1, 0.2},
                    .of_reference = true};
  const Place again = place_of(nlohmann::json::parse(to_json(place).dump()));
  EXPECT_EQ(sentence_of(again, "x"), sentence_of(place, "x"));
  EXPECT_EQ(again.program, "disk");
  EXPECT_EQ(sentence_of(place_of(nlohmann::json::parse(R"({"step": null, "grid": null})")), "x"), "x");
}

}  // namespace
}  // namespace fsi::io
