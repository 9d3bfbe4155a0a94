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
  fs::create_directories(folder / "STL");
  fs::create_directories(folder / "jaw 1.5");
  std::ofstream(folder / "vice.step") << "x";
  EXPECT_EQ(display_name(folder / "vice.step"), "vice.step");
  EXPECT_EQ(display_name(folder / "parts"), folder.filename().string() + "/parts");
  EXPECT_EQ(display_name(folder / "parts/"), folder.filename().string() + "/parts");
  EXPECT_EQ(display_name("missing/away.step"), "away.step");
  EXPECT_EQ(display_name("/"), "");
  EXPECT_EQ(product_name(folder / "vice.step"), "vice");
  EXPECT_EQ(product_name("missing/vice.v2.step"), "vice.v2");
  EXPECT_EQ(product_name(folder / "parts"), folder.filename().string());
  EXPECT_EQ(product_name(folder / "STL/"), folder.filename().string());
  EXPECT_EQ(product_name(folder / "jaw 1.5"), "jaw 1.5");
  EXPECT_EQ(product_name("/"), "");
  fs::remove_all(folder);
}

}  // namespace
}  // namespace dismantle
