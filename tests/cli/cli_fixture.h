// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace dismantle {

namespace fs = std::filesystem;

struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

inline std::string read_all(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// A separate folder for each test, with an assembly: a block in front of a wall.
class Cli : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        fs::temp_directory_path() / ("dismantle_cli_" + std::string(info->name()) + "_" + std::to_string(getpid()));
    fs::create_directories(folder_ / "parts");
    write_box("block", 0, 0, 0, 10, 10, 10);
    write_box("wall", 20.5, -50, -50, 21, 50, 50);
    write("pull.motion.json", R"({"format": "dismantle-motion", "version": 1, "response": "touch", "moves": [
      {"components": ["block"], "targets": [
        {"t": 0.0, "position": [0, 0, 0], "rotation": [1, 0, 0, 0]},
        {"t": 0.1, "position": [7, 0, 0], "rotation": [1, 0, 0, 0]},
        {"t": 0.2, "position": [30, 0, 0], "rotation": [1, 0, 0, 0]}]}]})");
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path in(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const { std::ofstream(in(name)) << text; }
  void write_box(const std::string& name, double x0, double y0, double z0, double x1, double y1, double z1) const {
    std::ofstream obj(in("parts/" + name + ".obj"));
    for (int i = 0; i < 8; ++i)
      obj << "v " << (i & 1 ? x1 : x0) << ' ' << (i & 2 ? y1 : y0) << ' ' << (i & 4 ? z1 : z0) << '\n';
    obj << "f 1 3 2\nf 2 3 4\nf 5 6 7\nf 6 8 7\nf 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\nf 1 5 3\nf 3 5 7\nf 2 4 6\nf 4 8 "
           "6\n";
  }

  /// Runs the program in the folder.
  Outcome run(const std::string& arguments) const;

  /// One sentence on stderr, this exit code, nothing on stdout.
  void expect_error(const std::string& arguments, int exit_code, const std::string& part) const {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.exit_code, exit_code) << arguments << '\n' << o.err;
    EXPECT_EQ(o.out, "") << arguments;
    EXPECT_NE(o.err.find(part), std::string::npos) << arguments << '\n' << o.err;
  }

  fs::path folder_;
};

}  // namespace dismantle
