// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/file_cache.h"

#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

namespace dismantle {
namespace {

namespace fs = std::filesystem;

class FileCacheTest : public ::testing::Test {
 protected:
  std::vector<fs::path> entries() const {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) files.push_back(entry.path());
    return files;
  }

  ScratchFolder scratch_;
  fs::path folder_ = scratch_ / "of/its/own";
  FileCache cache_{folder_, 1 << 20};
};

TEST_F(FileCacheTest, GivesBackWhatWasKeptForTheSameKeyOnly) {
  const std::string bytes("a\0b\n", 4);
  EXPECT_EQ(cache_.find("key"), std::nullopt);
  EXPECT_FALSE(fs::exists(folder_));
  cache_.keep("key", bytes);
  EXPECT_EQ(cache_.find("key"), bytes);
  EXPECT_EQ(cache_.find("Key"), std::nullopt);
  cache_.keep("key", "");
  EXPECT_EQ(cache_.find("key"), "");
  EXPECT_EQ(fs::status(folder_).permissions(), fs::perms::owner_all);
}

TEST_F(FileCacheTest, TakesDamagedEntriesForMissing) {
  cache_.keep("key", "some bytes that matter");
  const fs::path file = entries().front();
  const std::string whole = bytes_of(file);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    fs::resize_file(file, 0);
    std::ofstream(file, std::ios::binary) << whole.substr(0, length);
    EXPECT_EQ(cache_.find("key"), std::nullopt) << length;
  }
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] ^= 1;
    std::ofstream(file, std::ios::binary) << changed;
    EXPECT_EQ(cache_.find("key"), std::nullopt) << i;
  }
  cache_.keep("key", "again");
  EXPECT_EQ(cache_.find("key"), "again");
}

TEST_F(FileCacheTest, RemovesWhatWasNotUsedForTheLongestTime) {
  const FileCache small(folder_, 4 * 1200);
  const std::string bytes(1000, 'x');
  const auto now = fs::file_time_type::clock::now();
  for (int i = 0; i < 4; ++i) {
    small.keep(std::to_string(i), bytes);
    for (const fs::path& file : entries())
      if (bytes_of(file).size() > 1000 && fs::last_write_time(file) > now - std::chrono::seconds(50))
        fs::last_write_time(file, now - std::chrono::seconds(100 - i));
  }
  EXPECT_TRUE(small.find("0"));  // used now
  small.keep("4", bytes);
  EXPECT_TRUE(small.find("0"));
  EXPECT_FALSE(small.find("1"));
  EXPECT_TRUE(small.find("2"));
  EXPECT_TRUE(small.find("4"));
  small.keep("too large", std::string(5000, 'x'));
  EXPECT_FALSE(small.find("too large"));
  EXPECT_TRUE(small.find("4"));
}

TEST_F(FileCacheTest, RemovesFilesThatWereLeftHalfWritten) {
  cache_.keep("key", "bytes");
  const fs::path old = folder_ / ".dismantle-1-1.tmp", fresh = folder_ / ".dismantle-2-1.tmp";
  std::ofstream(old) << "half";
  std::ofstream(fresh) << "half";
  fs::last_write_time(old, fs::file_time_type::clock::now() - std::chrono::hours(30));
  cache_.keep("other", "bytes");
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(fresh));
  EXPECT_TRUE(cache_.find("key"));
}

TEST_F(FileCacheTest, IsSharedByThreadsThatReadAndWriteTheSameEntries) {
  const FileCache small(folder_, 5 * 20000);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 60; ++i) {
        const std::string key = std::to_string(i % 9), bytes(10000, static_cast<char>('a' + i % 9));
        if (const auto found = small.find(key)) {
          EXPECT_EQ(*found, bytes);
        } else {
          small.keep(key, bytes);
        }
      }
    });
  for (std::thread& thread : threads) thread.join();
}

TEST_F(FileCacheTest, IsWithoutEffectWhereItsFolderCannotBeMade) {
  const FileCache nowhere(scratch_.put("file", "no folder") / "folder", 1 << 20);
  nowhere.keep("key", "bytes");
  EXPECT_EQ(nowhere.find("key"), std::nullopt);
}

}  // namespace
}  // namespace dismantle
