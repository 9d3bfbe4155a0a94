// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/atomic_file.h"

#include "tests/support/scratch_folder.h"
#include "tests/support/test_data.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace dismantle {

TEST(AtomicFile, AppearsCompleteAndLeavesNothingElse) {
  const ScratchFolder folder;
  const std::string large(3'000'000, 'x');
  ASSERT_TRUE(write_file(folder / "a.txt", large).ok());
  EXPECT_EQ(bytes_of(folder / "a.txt"), large);
  EXPECT_EQ(folder.entry_count(), 1u);
}

TEST(AtomicFile, DoesNotExistBeforeItIsCommitted) {
  const ScratchFolder folder;
  auto file = AtomicFile::create(folder / "a.txt");
  ASSERT_TRUE(file.ok());
  file->write("half");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
}

TEST(AtomicFile, LeavesTheOldFileAloneWhenItIsDropped) {
  const ScratchFolder folder;
  folder.put("a.txt", "old");
  {
    auto file = AtomicFile::create(folder / "a.txt");
    ASSERT_TRUE(file.ok());
    file->write("new");
  }
  EXPECT_EQ(bytes_of(folder / "a.txt"), "old");
  EXPECT_EQ(folder.entry_count(), 1u);
}

/// True if the file system of a folder has files without a name.
bool has_unnamed_files(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_WRONLY, 0600);
  if (descriptor >= 0) ::close(descriptor);
  return descriptor >= 0;
}

TEST(AtomicFile, LeavesNothingWhenItsProcessIsKilled) {
  const ScratchFolder folder;
  if (!has_unnamed_files(folder.path())) GTEST_SKIP() << "the file system has no files without a name";
  folder.put("old.txt", "old");
  const pid_t child = ::fork();
  if (child == 0) {
    auto fresh = AtomicFile::create(folder / "new.txt");
    auto replacing = AtomicFile::create(folder / "old.txt");
    fresh->write(std::string(3'000'000, 'x'));
    replacing->write(std::string(3'000'000, 'x'));
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(folder.entry_count(), 1u);
  EXPECT_EQ(bytes_of(folder / "old.txt"), "old");
}

TEST(AtomicFile, HasTheModeOfOtherNewFiles) {
  const ScratchFolder folder;
  const mode_t mask = ::umask(027);
  ASSERT_TRUE(write_file(folder / "a.txt", "text").ok());
  ::umask(mask);
  EXPECT_EQ(std::filesystem::status(folder / "a.txt").permissions(), std::filesystem::perms(0640));
}

TEST(AtomicFile, ReplacesAndKeepsTheModeOfTheOldFile) {
  const ScratchFolder folder;
  ::chmod(folder.put("a.txt", "old").c_str(), 0640);
  ASSERT_TRUE(write_file(folder / "a.txt", "new").ok());
  EXPECT_EQ(bytes_of(folder / "a.txt"), "new");
  EXPECT_EQ(std::filesystem::status(folder / "a.txt").permissions(), std::filesystem::perms(0640));
}

TEST(AtomicFile, WritesThroughASymbolicLink) {
  const ScratchFolder folder;
  folder.put("real.txt", "old");
  std::filesystem::create_symlink("real.txt", folder / "link.txt");
  ASSERT_TRUE(write_file(folder / "link.txt", "new").ok());
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
  EXPECT_EQ(bytes_of(folder / "real.txt"), "new");
}

TEST(AtomicFile, NeverReplacesADevice) {
  ASSERT_TRUE(write_file("/dev/null", "gone").ok());
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, ReportsAFullDisk) {
  DISMANTLE_NEED("/dev/full");
  const auto result = write_file("/dev/full", "text");
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::Failed);
  EXPECT_NE(result.error().message.find("No space left"), std::string::npos);
}

TEST(AtomicFile, RefusesAFolderAndAMissingFolder) {
  const ScratchFolder folder;
  const auto onto_folder = write_file(folder.path(), "text");
  ASSERT_FALSE(onto_folder.ok());
  EXPECT_NE(onto_folder.error().message.find("it is a folder"), std::string::npos);
  const auto into_nowhere = write_file(folder / "missing/a.txt", "text");
  ASSERT_FALSE(into_nowhere.ok());
  EXPECT_NE(into_nowhere.error().message.find("No such file"), std::string::npos);
}

}  // namespace dismantle
