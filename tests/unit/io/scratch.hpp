#pragma once
/// A directory of its own for each test, gone afterwards.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace fsi::io {

class InScratch : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    dir = testing::TempDir() + "fsi_io_" + info->test_suite_name() + "_" + info->name();
    std::filesystem::remove_all(dir);
    std::filesystem::create_directories(dir);
  }
  void TearDown() override { std::filesystem::remove_all(dir); }

  static std::string content(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }

  std::string dir;
};

/// A directory nobody can write into: a plain file stands in its place, which stops root as well.
inline std::string occupied_place(const std::string& dir) {
  std::ofstream(dir + "/occupied") << "not a directory\n";
  return dir + "/occupied";
}

}  // namespace fsi::io
