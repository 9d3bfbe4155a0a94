// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/zip_archive.h"

#include "tests/support/scratch_folder.h"
#include "tests/support/zip_writer.h"

#include <gtest/gtest.h>

#include <random>

namespace dismantle {
namespace {

TEST(ZipArchive, GivesTheFilesInIt) {
  const ScratchFolder folder;
  std::string long_text;
  for (int i = 0; i < 300'000; ++i) long_text += std::to_string(i);
  write_zip(folder / "a.zip", {{"one.txt", "first"}, {"in/two.txt", long_text}, {"empty", ""}});
  const std::string bytes = bytes_of(folder / "a.zip");
  Result<ZipArchive> archive = ZipArchive::open(bytes);
  ASSERT_TRUE(archive.ok());
  EXPECT_EQ(archive->names(), (std::vector<std::string>{"one.txt", "in/two.txt", "empty"}));
  EXPECT_TRUE(archive->contains("in/two.txt"));
  EXPECT_FALSE(archive->contains("two.txt"));
  EXPECT_EQ(*archive->read("one.txt"), "first");
  EXPECT_EQ(*archive->read("in/two.txt"), long_text);
  EXPECT_EQ(*archive->read("empty"), "");
  EXPECT_NE(archive->read("three").error().message.find("\"three\" is missing"), std::string::npos);
}

TEST(ZipArchive, RefusesToUnpackABomb) {
  const ScratchFolder folder;
  write_zip(folder / "bomb.zip", {{"zeros", std::string(200 << 20, '\0')}, {"small", "x"}});
  const std::string bytes = bytes_of(folder / "bomb.zip");
  ASSERT_LT(bytes.size(), 1u << 20);
  Result<ZipArchive> archive = ZipArchive::open(bytes);
  ASSERT_TRUE(archive.ok());
  const Result<std::string> zeros = archive->read("zeros");
  ASSERT_FALSE(zeros.ok());
  EXPECT_NE(zeros.error().message.find("unpacks to more than"), std::string::npos);
}

TEST(ZipArchive, CountsAllThatItUnpacks) {
  const ScratchFolder folder;
  const std::string half(50 << 20, '\0');
  write_zip(folder / "bomb.zip", {{"a", half}, {"b", half}});
  const std::string bytes = bytes_of(folder / "bomb.zip");
  Result<ZipArchive> archive = ZipArchive::open(bytes);
  ASSERT_TRUE(archive.ok());
  EXPECT_TRUE(archive->read("a").ok());
  EXPECT_FALSE(archive->read("b").ok());
}

TEST(ZipArchive, SurvivesCutAndChangedBytes) {
  const ScratchFolder folder;
  write_zip(folder / "a.zip", {{"one", std::string(5000, 'a') + "end"}, {"two", "abc"}});
  const std::string whole = bytes_of(folder / "a.zip");
  EXPECT_FALSE(ZipArchive::open("").ok());
  EXPECT_FALSE(ZipArchive::open("no archive").ok());
  EXPECT_FALSE(ZipArchive::open(std::string_view(whole).substr(0, whole.size() / 2)).ok());
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    std::string changed = whole;
    for (int k = 0; k < 1 + round % 4; ++k) changed[random() % changed.size()] = static_cast<char>(random());
    Result<ZipArchive> archive = ZipArchive::open(changed);
    if (!archive) continue;
    for (const std::string& name : archive->names()) {
      const Result<std::string> read = archive->read(name);
      EXPECT_TRUE(read.ok() || !read.error().message.empty());
    }
  }
}

}  // namespace
}  // namespace dismantle
