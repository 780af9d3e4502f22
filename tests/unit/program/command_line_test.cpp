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
  const auto file = line.add_option("--file", r.file, "which file");
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

TEST(CommandLine, MistakesNameTheOption) {
  const auto said = [](const std::vector<const char*>& words, const char* part, bool file_required = false) {
    const std::string text = mistake(words, file_required);
    EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_NE(text.find("--help"), std::string::npos) << text;
  };
  said({"--prot", "1"}, "--prot");
  said({"--port", "80x"}, "80x");
  said({"--port", "99999999999"}, "99999999999");
  said({"--file"}, "--file");
  said({"a", "b"}, "b");
  said({"a"}, "--file", true);
  EXPECT_EQ(mistake({"a", "--file", "b"}, true), "");
}

TEST(CommandLine, HelpNamesEveryOptionAndEndsTheProgramWell) {
  testing::internal::CaptureStdout();
  const Read r = read({"--help"}, true);
  const std::string text = testing::internal::GetCapturedStdout();
  EXPECT_FALSE(r.parsed);
  for (const char* word : {"About", "RUN", "--file", "--set", "--json", "which run", "REQUIRED"}) {
    EXPECT_NE(text.find(word), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace fsi
