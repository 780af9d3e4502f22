#include "common/core/command_line.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/core/failure.hpp"

namespace fsi {
namespace {

struct Read {
  std::string run, file = "none";
  std::vector<std::string> settings;
  int port = -1;
  double speed = 1;
  bool json = false, parsed = false;
};

Read read(const std::vector<const char*>& words, bool file_required = false) {
  Read r;
  CommandLine line("About");
  line.add_option("RUN", r.run, "which run");
  auto& file = line.add_option("--file", r.file, "which file");
  if (file_required) file.required();
  line.add_option("--set", r.settings, "settings");
  line.add_option("--port", r.port, "port");
  line.add_option("--speed", r.speed, "speed");
  line.add_flag("--json", r.json, "as JSON");
  r.parsed = line.parse(words);
  return r;
}

std::string mistake(const std::vector<const char*>& words, bool file_required = false) {
  try {
    read(words, file_required);
  } catch (const UserMistake& mistake) {
    return mistake.what();
  }
  return "";
}

TEST(CommandLine, WhatIsNotThereKeepsItsValue) {
  const Read r = read({});
  EXPECT_TRUE(r.parsed);
  EXPECT_EQ(r.file, "none");
  EXPECT_EQ(r.port, -1);
  EXPECT_FALSE(r.json);
}

TEST(CommandLine, AValueStandsBehindItsNameOrAnEqualsSign) {
  const Read r = read({"--file", "a=b", "--port=8080", "--speed", "-2.5e-1", "--json", "beam"});
  EXPECT_EQ(r.file, "a=b");
  EXPECT_EQ(r.port, 8080);
  EXPECT_EQ(r.speed, -0.25);
  EXPECT_TRUE(r.json);
  EXPECT_EQ(r.run, "beam");
}

TEST(CommandLine, AListTakesEveryValueInItsOrder) {
  EXPECT_EQ(read({"--set", "a=--b", "beam", "--set=c=d=e"}).settings,
            (std::vector<std::string>{"a=--b", "c=d=e"}));
}

TEST(CommandLine, ABareDoubleDashMakesTheRestWords) {
  EXPECT_EQ(read({"--", "--json"}).run, "--json");
}

TEST(CommandLine, MistakesSayWhatIsWrong) {
  EXPECT_EQ(mistake({"--prot", "1"}), "there is no option `--prot`; did you mean `--port`?");
  EXPECT_EQ(mistake({"--wavelength", "1"}), "there is no option `--wavelength`; --help lists them");
  EXPECT_EQ(mistake({"--port", "80x"}), "--port: `80x` is no whole number");
  EXPECT_EQ(mistake({"--port", "99999999999"}), "--port: `99999999999` is no whole number");
  EXPECT_EQ(mistake({"--speed", ""}), "--speed: `` is no number");
  EXPECT_EQ(mistake({"--file"}), "--file needs a value: which file");
  EXPECT_EQ(mistake({"--json=1"}), "--json takes no value");
  EXPECT_EQ(mistake({"a", "b"}), "nothing is known of `b`; --help says what may stand here");
  EXPECT_EQ(mistake({"a"}, true), "--file is missing: which file");
  EXPECT_EQ(mistake({"a", "--file", "b"}, true), "");
}

TEST(CommandLine, HelpNamesEveryOptionAndEndsTheProgramWell) {
  testing::internal::CaptureStdout();
  const Read r = read({"--help"}, true);
  const std::string text = testing::internal::GetCapturedStdout();
  EXPECT_FALSE(r.parsed);
  for (const char* word : {"About", "RUN", "--file VALUE", "--set", "--json", "which run", "must be given"}) {
    EXPECT_NE(text.find(word), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace fsi
