// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/faults/folder_contents.h"
#include "tests/faults/killed_command.h"
#include "tests/faults/run_command.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace dismantle::faults {

using server::testing_client::SpawnOptions;

/// A folder with stack.dasm, an assembly, stack.path.json, which takes it apart, and an empty folder `out`.
class FaultScene : public testing::Test {
 protected:
  void SetUp() override {
    fault_commands(folder_.path(), "export");
    std::filesystem::create_directories(folder_ / "out");
  }

  CommandEnd run(const std::vector<std::string>& arguments, const SpawnOptions& limits = {}) const {
    return run_command(arguments, in_folder(folder_.path(), limits));
  }
  FolderContents outputs() const { return contents_of(folder_ / "out"); }

  /// Exit code 4, one sentence with `part`.
  static void expect_failure(const CommandEnd& end, const std::string& part) {
    EXPECT_EQ(end.exit_code, 4) << end.err;
    EXPECT_EQ(end.err.compare(0, 11, "dismantle: "), 0) << end.err;
    EXPECT_EQ(std::count(end.err.begin(), end.err.end(), '\n'), 1) << end.err;
    EXPECT_NE(end.err.find(part), std::string::npos) << end.err;
    EXPECT_NE(end.err.find("; "), std::string::npos) << "what to do: " << end.err;
  }

  ScratchFolder folder_;
};

}  // namespace dismantle::faults
