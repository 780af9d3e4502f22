/// Tables on a full disk: what is lost is what is said.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/core/failure.hpp"
#include "common/core/log.hpp"
#include "common/io/csv_writer.hpp"
#include "common/io/write_each.hpp"
#include "tests/unit/io/full_disk.hpp"
#include "tests/unit/io/scratch.hpp"

namespace fsi::io {
namespace {

class LostLines : public InScratch {
 protected:
  std::string path() const { return dir + "/a.csv"; }
  std::uintmax_t size() const { return std::filesystem::file_size(path()); }
};

/// What `write` says it has lost; 0 where it does not fail.
template <class Write>
std::uint64_t lost_by(const Write& write) {
  try {
    write();
  } catch (const OutputFailed& failure) {
    return failure.lost();
  }
  return 0;
}

TEST_F(LostLines, AreTheMissingOnesOfTheTable) {
  CsvWriter csv(path(), {"step"}, Opening::fresh, 4);
  std::uint64_t lost = 0;
  constexpr int lines = 31;
  for (int k = 0; k < lines; ++k) {
    const FullDisk disk(k < 10 || k >= 25 ? RLIM_INFINITY : size() + 1);
    lost += lost_by([&] { csv.row({static_cast<double>(k)}); });
  }
  const FullDisk disk(size());
  lost += lost_by([&] { csv.flush(); });
  EXPECT_EQ(lost, 16 + 3) << "four batches, and what was left at the end";
  const std::string text = content(path());
  EXPECT_EQ(std::ranges::count(text, '\n'), 1 + lines - static_cast<int>(lost));
  EXPECT_EQ(text.back(), '\n');
}

TEST_F(LostLines, OfATableThatNobodyFlushedAreInTheLog) {
  open_log("", "", LogFile::fresh);
  std::optional<CsvWriter> csv(std::in_place, path(), std::vector<std::string>{"step"});
  for (int k = 0; k < 3; ++k) csv->row({static_cast<double>(k)});
  fill_disk_of(path());
  testing::internal::CaptureStderr();
  csv.reset();
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find(path()), std::string::npos) << said;
  EXPECT_NE(said.find("lines lost: 3"), std::string::npos) << said;
}

TEST(WriteEach, GoesOnAfterWhatFailsAndSaysAllOfIt) {
  bool written = false;
  try {
    write_each([] { throw OutputFailed("no a.csv", 3); }, [&] { written = true; },
               [] { write_each([] { throw OutputFailed("no b.csv", 4); }, [] {}); },
               [] { throw OutputFailed("no c.h5"); });
    FAIL() << "three of them failed";
  } catch (const OutputFailed& failure) {
    EXPECT_STREQ(failure.what(), "no a.csv; no b.csv; no c.h5");
    EXPECT_EQ(failure.lost(), 3 + 4 + 1);
  }
  EXPECT_TRUE(written);
}

TEST(WriteEach, LetsOtherFailuresThrough) {
  EXPECT_THROW(write_each([] { throw Diverged("p < 0"); }), Diverged);
  EXPECT_THROW(write_each([] { throw OutputFailed("full"); }, [] { throw std::logic_error("columns"); }),
               std::logic_error);
}

}  // namespace
}  // namespace fsi::io
