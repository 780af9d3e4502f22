#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "common/core/failure.hpp"
#include "common/io/checkpoint.hpp"
#include "common/io/checksum.hpp"
#include "common/io/csv_writer.hpp"
#include "tests/unit/io/scratch.hpp"

namespace fsi::io {
namespace {

const CheckpointOrigin gas{
    .participant = "fluid", .case_digest = "c0ffee", .build = "b1", .processor = "avx2 fma"};
const std::vector<std::string> everybody{"fluid"};

/// A state with numbers that only exact copies keep.
struct State {
  std::vector<double> field{1.0 / 3, -0.0, std::numeric_limits<double>::denorm_min(),
                            std::numeric_limits<double>::infinity()};
  std::vector<double> none = {}, history{1, 2};
  std::uint64_t steps = 0;
  bool begun = false;

  void archive(Archive& archive) {
    archive.inside("grid", [&] { archive.values("field", field); });
    archive.values("none", none);
    archive.list("history", history);
    archive.number("steps", steps);
    archive.number("begun", begun);
  }
};

class Checkpoint : public InScratch {
 protected:
  std::string write(std::uint64_t step, const std::vector<std::string>& participants = everybody) {
    State state{.steps = step, .begun = true};
    Archive archive;
    state.archive(archive);
    const Standing at{.step = step, .t = 0.1, .dt = 0.01};
    write_checkpoint(dir, gas, at, archive);
    missing = complete_checkpoint(dir, at, participants, gas.case_digest);
    return checkpoint_folder(dir, step);
  }

  std::vector<std::string> missing;

  static std::string refusal(const std::string& folder, const CheckpointOrigin& reader) {
    try {
      read_checkpoint(folder, reader);
      return "";
    } catch (const UserMistake& mistake) {
      return mistake.what();
    }
  }
};

TEST_F(Checkpoint, GivesBackTheStateToTheBit) {
  LoadedCheckpoint loaded = read_checkpoint(write(400), gas);
  EXPECT_EQ(loaded.at.step, 400U);
  EXPECT_EQ(loaded.at.t, 0.1);
  EXPECT_EQ(loaded.at.dt, 0.01);
  State state{.field = {0, 0, 0, 0}, .history = {}};
  state.archive(loaded.state);
  loaded.state.check_all_loaded();
  const State saved;
  for (std::size_t k = 0; k < saved.field.size(); ++k)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(state.field[k]), std::bit_cast<std::uint64_t>(saved.field[k]));
  EXPECT_EQ(state.history, saved.history);
  EXPECT_EQ(state.steps, 400U);
  EXPECT_TRUE(state.begun);
}

TEST_F(Checkpoint, IsRefusedByAnotherCaseBuildOrProcessorWhichIsNamed) {
  const std::string folder = write(1);
  EXPECT_EQ(refusal(folder, gas), "");
  CheckpointOrigin other = gas;
  other.case_digest = "decaf";
  EXPECT_NE(refusal(folder, other).find("another case (c0ffee, now decaf)"), std::string::npos);
  other = gas;
  other.build = "b2";
  EXPECT_NE(refusal(folder, other).find("another build of this program (b1, now b2)"), std::string::npos);
  other = gas;
  other.processor = "avx512f";
  EXPECT_NE(refusal(folder, other).find("another kind of processor"), std::string::npos);
}

TEST_F(Checkpoint, OneWrongByteOrAMissingEndIsNoticed) {
  const std::string folder = write(1), path = folder + "/fluid.h5";
  const std::string whole = content(path);
  std::string damaged = whole;
  damaged[whole.size() / 2] = static_cast<char>(damaged[whole.size() / 2] ^ 1);
  for (const std::string& text : {damaged, whole.substr(0, whole.size() - 1), std::string()}) {
    std::ofstream(path, std::ios::binary) << text;
    EXPECT_THROW(read_checkpoint(folder, gas), OutputFailed);
  }
  std::ofstream(path, std::ios::binary) << whole;
  EXPECT_NO_THROW(read_checkpoint(folder, gas));
}

TEST_F(Checkpoint, IsNotUsedBeforeEverybodyHasWritten) {
  write(1, {"fluid", "beam"});
  EXPECT_EQ(missing, std::vector<std::string>{"beam"});
  EXPECT_THROW(read_checkpoint(checkpoint_folder(dir, 1), gas), OutputFailed);
}

TEST_F(Checkpoint, FileOfAnotherProgramsOwnFormatMakesTheSetWholeToo) {
  const std::string folder = checkpoint_folder(dir, 1);
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/beam.state") << "q = 0.5\n";
  write(1, {"fluid", "beam"});
  EXPECT_TRUE(missing.empty());
  EXPECT_NO_THROW(read_checkpoint(folder, gas));
  std::ifstream manifest(folder + "/manifest.json");
  const std::string text{std::istreambuf_iterator<char>(manifest), {}};
  EXPECT_NE(text.find("\"beam.state\""), std::string::npos) << text;
}

TEST_F(Checkpoint, TheLastTwoCompleteSetsAreKept) {
  for (const std::uint64_t step : {10U, 20U}) write(step);
  write(25, {"fluid", "beam"});
  write(30);
  const auto kept = [&](std::uint64_t step) { return std::filesystem::exists(checkpoint_folder(dir, step)); };
  EXPECT_FALSE(kept(10));
  EXPECT_TRUE(kept(20));
  EXPECT_FALSE(kept(25));
  EXPECT_TRUE(kept(30));
  write(15);  // the run went on from an older one: what was later is of another past
  EXPECT_TRUE(kept(15));
  EXPECT_FALSE(kept(20));
}

TEST_F(Checkpoint, SetsAreInTheOrderOfTheirStepsHoweverManyDigitsTheseHave) {
  for (const std::uint64_t step : {99'999'900U, 99'999'950U, 100'000'000U}) write(step);
  const auto kept = [&](std::uint64_t step) { return std::filesystem::exists(checkpoint_folder(dir, step)); };
  EXPECT_FALSE(kept(99'999'900));
  EXPECT_TRUE(kept(99'999'950));
  EXPECT_TRUE(kept(100'000'000));
}

TEST_F(Checkpoint, WhatSomebodyElseKeepsBesideTheSetsStays) {
  namespace files = std::filesystem;
  const files::path sets = files::path(dir) / "checkpoints", elsewhere = files::path(dir) / "elsewhere";
  const std::string too_large(25, '9');  // digits, but no step
  for (const std::string name : {"keep", "10_old", "notes", "-5", "+5", too_large.c_str()}) {
    files::create_directories(sets / name / "x");
    std::ofstream(sets / name / "manifest.json") << "{}";
  }
  files::create_directories(elsewhere);
  std::ofstream(elsewhere / "manifest.json") << "{}";
  files::create_directory_symlink(elsewhere, sets / "00000005");
  files::create_directory_symlink(elsewhere, sets / "00000099");
  for (const std::uint64_t step : {10U, 20U, 30U}) write(step);
  for (const std::string name : {"keep", "10_old", "notes", "-5", "+5", too_large.c_str()}) {
    EXPECT_TRUE(files::exists(sets / name / "x")) << name;
    EXPECT_TRUE(files::exists(sets / name / "manifest.json")) << name;
  }
  for (const char* link : {"00000005", "00000099"}) EXPECT_TRUE(files::is_symlink(sets / link)) << link;
  EXPECT_TRUE(files::exists(elsewhere / "manifest.json")) << "not through a link either";
  EXPECT_FALSE(files::exists(checkpoint_folder(dir, 10))) << "what is not a set takes no set's place";
  for (const std::uint64_t step : {20U, 30U})
    EXPECT_NO_THROW(read_checkpoint(checkpoint_folder(dir, step), gas)) << step;
}

TEST_F(Checkpoint, ArchiveOfAnotherProgramIsRefused) {
  State state;
  Archive saved;
  state.archive(saved);
  Archive larger(saved.entries());
  state.field.resize(5);
  EXPECT_THROW(state.archive(larger), UserMistake);
  Archive unread(saved.entries());
  EXPECT_THROW(unread.check_all_loaded(), UserMistake);
  Archive empty(Archive::Entries{});
  EXPECT_THROW(state.archive(empty), UserMistake);
}

TEST_F(Checkpoint, ChecksumIsThatOfItsStandard) {
  std::ofstream(dir + "/digits") << "123456789";
  EXPECT_EQ(checksum_of(dir + "/digits"), (Checksum{.bytes = 9, .crc32 = 0xCBF43926U}));
}

TEST_F(Checkpoint, TableGoesOnWhereItWas) {
  const std::vector<std::string> columns{"t", "x"};
  Archive saved;
  {
    CsvWriter csv(dir + "/a.csv", columns);
    csv.row({1, 10});
    csv.archive(saved);
    csv.row({2, 20});
  }
  {
    CsvWriter csv(dir + "/a.csv", columns, Opening::continued);
    Archive loaded(saved.entries());
    csv.archive(loaded);
    csv.row({2, 30});
  }
  EXPECT_EQ(content(dir + "/a.csv"), "t,x\n1,10\n2,30\n");
  EXPECT_THROW(CsvWriter(dir + "/a.csv", {"t", "y"}, Opening::continued), OutputFailed);
  EXPECT_THROW(CsvWriter(dir + "/b.csv", columns, Opening::continued), OutputFailed);
  std::ofstream(dir + "/a.csv") << "t,x\n";
  CsvWriter shortened(dir + "/a.csv", columns, Opening::continued);
  Archive loaded(saved.entries());
  EXPECT_THROW(shortened.archive(loaded), OutputFailed);
}

}  // namespace
}  // namespace fsi::io
