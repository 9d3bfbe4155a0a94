// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/display_name.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <fstream>

namespace dismantle {
namespace {

namespace fs = std::filesystem;

TEST(DisplayName, IsThatOfAFileAndOfAFolderWithItsParent) {
  const fs::path folder = fs::temp_directory_path() / ("vice_" + std::to_string(getpid()));
  fs::create_directories(folder / "parts");
  std::ofstream(folder / "vice.step") << "x";
  EXPECT_EQ(display_name(folder / "vice.step"), "vice.step");
  EXPECT_EQ(display_name(folder / "parts"), folder.filename().string() + "/parts");
  EXPECT_EQ(display_name(folder / "parts/"), folder.filename().string() + "/parts");
  EXPECT_EQ(display_name("missing/away.step"), "away.step");
  EXPECT_EQ(display_name("/"), "");
  fs::remove_all(folder);
}

}  // namespace
}  // namespace dismantle
