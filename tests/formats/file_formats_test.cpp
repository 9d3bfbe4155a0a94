// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/import/file_formats.h"

#include <gtest/gtest.h>

#include <set>

namespace dismantle {
namespace {

TEST(FileFormats, AreFoundByExtensionInAnyCase) {
  ASSERT_NE(format_of("a/b.STEP"), nullptr);
  EXPECT_EQ(format_of("a/b.STEP")->format, FileFormat::Step);
  EXPECT_EQ(format_of("c.FCStd")->format, FileFormat::FreeCad);
  EXPECT_EQ(format_of("d.txt"), nullptr);
  EXPECT_EQ(format_of("step"), nullptr);
}

TEST(FileFormats, HaveExtensionsOfTheirOwn) {
  std::set<std::string_view> extensions;
  for (const FormatEntry& entry : file_formats())
    for (const std::string_view extension : entry.extensions) EXPECT_TRUE(extensions.insert(extension).second);
}

TEST(FileFormats, AreListedForASentence) {
  const std::string names = format_names();
  EXPECT_EQ(names.substr(0, 12), "STEP, IGES, ");
  EXPECT_TRUE(names.ends_with(", STL or PLY")) << names;
  EXPECT_TRUE(format_names(", ").ends_with(", STL, PLY"));
}

}  // namespace
}  // namespace dismantle
