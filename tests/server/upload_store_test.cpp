// SPDX-License-Identifier: Apache-2.0
#include "apps/server/upload_store.h"

#include "tests/support/scratch_folder.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <unistd.h>

namespace dismantle::server {
namespace {

namespace fs = std::filesystem;

/// Limits without regard to the disk.
UploadLimits limits(std::uint64_t client, std::uint64_t total) {
  return {client, total, 0};
}

/// Has a folder for temporary files of its own.
class UploadStoreTest : public testing::Test {
 protected:
  UploadStoreTest() {
    if (const char* before = getenv("TMPDIR")) before_ = before;
    setenv("TMPDIR", folder_.path().c_str(), 1);
  }
  ~UploadStoreTest() override { before_.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", before_.c_str(), 1); }

  bool is_there(const char* name) const { return fs::exists(fs::symlink_status(folder_ / name)); }
  bool is_empty() const { return fs::is_empty(folder_.path()); }

  ScratchFolder folder_;
  std::string before_;
};

TEST_F(UploadStoreTest, GivesEachUploadAFolderThatGoesWithIt) {
  {
    UploadStore store;
    EXPECT_TRUE(is_empty()) << "nothing is made before it is needed";
    const auto one = store.reserve("a", 10), two = store.reserve("a", 10);
    ASSERT_TRUE(one.ok() && two.ok());
    std::ofstream((*one)->path() / "file") << "x";
    fs::create_directories((*two)->path() / "deep/er");
    EXPECT_EQ(fs::status((*one)->path()).permissions(), fs::perms::owner_all);
    EXPECT_EQ(fs::status((*one)->path().parent_path()).permissions(), fs::perms::owner_all);
  }
  EXPECT_TRUE(is_empty());
}

TEST_F(UploadStoreTest, OutlivedByAFolderLeavesNothing) {
  std::shared_ptr<UploadFolder> folder;
  {
    UploadStore store;
    folder = *store.reserve("a", 10);
  }
  EXPECT_TRUE(fs::exists(folder->path()));
  folder.reset();
  EXPECT_TRUE(is_empty());
}

TEST_F(UploadStoreTest, LimitsEachClientAndAll) {
  UploadStore store(limits(100, 150));
  auto first = store.reserve("a", 60);
  ASSERT_TRUE(first.ok());
  const auto more = store.reserve("a", 41);
  ASSERT_FALSE(more.ok());
  EXPECT_NE(more.error().message.find("the uploads of this page would take more than"), std::string::npos);
  EXPECT_TRUE(store.reserve("a", 40).ok()) << "and is released at once";
  const auto other = store.reserve("b", 90);
  ASSERT_TRUE(other.ok());
  const auto third = store.reserve("c", 1);
  ASSERT_FALSE(third.ok());
  EXPECT_NE(third.error().message.find("all uploads together would take more than"), std::string::npos);
  EXPECT_FALSE(store.reserve("d", ~std::uint64_t{0}).ok());
  *first = nullptr;
  EXPECT_TRUE(store.reserve("c", 60).ok());
}

TEST_F(UploadStoreTest, LeavesSpaceOnTheDisk) {
  UploadLimits limits;
  limits.min_free_bytes = std::uint64_t{1} << 60;
  const auto refused = UploadStore(limits).reserve("a", 1);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("the disk has only"), std::string::npos);

  const std::uint64_t available = fs::space(folder_.path()).available;
  UploadStore store({~std::uint64_t{0}, ~std::uint64_t{0}, 0});
  const auto most = store.reserve("a", available / 2);
  EXPECT_FALSE(store.reserve("a", available / 4 * 3).ok()) << "half of it is reserved";
  (*most)->set_written();
  EXPECT_TRUE(store.reserve("a", available / 4 * 3).ok()) << "what is written no longer counts as free";
}

TEST_F(UploadStoreTest, RemovesWhatProcessesLeftThatHaveEnded) {
  folder_.put("dismantle-uploads-a1B2c3/7/part.stl", "solid");
  folder_.put("outside/kept.stl", "solid");
  fs::create_directory_symlink(folder_ / "outside", folder_ / "dismantle-uploads-a1B2c3/link");
  UploadStore store;
  EXPECT_FALSE(is_there("dismantle-uploads-a1B2c3"));
  EXPECT_TRUE(is_there("outside/kept.stl"));
}

TEST_F(UploadStoreTest, RemovesNothingElse) {
  folder_.put("outside/kept.stl", "solid");
  fs::create_directory_symlink(folder_ / "outside", folder_ / "dismantle-uploads-linked");
  folder_.put("dismantle-uploads-afile1", "a file");
  folder_.put("dismantle-uploads-toolong/part.stl", "solid");
  folder_.put("dismantle-uploads-a.b.c.", "a file");
  folder_.put("dismantle-uploads-locked/part.stl", "solid");
  const int locked = open((folder_ / "dismantle-uploads-locked").c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(flock(locked, LOCK_EX), 0);
  folder_.put("dismantle-uploads-theirs/part.stl", "solid");
  const bool is_root = chown((folder_ / "dismantle-uploads-theirs").c_str(), 4321, 4321) == 0;
  {
    UploadStore store;
    UploadStore beside;
    const auto used = store.reserve("a", 1);
    UploadStore later;
    EXPECT_TRUE(fs::exists((*used)->path())) << "of a store that lives";
  }
  EXPECT_TRUE(is_there("outside/kept.stl"));
  EXPECT_TRUE(is_there("dismantle-uploads-linked"));
  EXPECT_TRUE(is_there("dismantle-uploads-afile1"));
  EXPECT_TRUE(is_there("dismantle-uploads-toolong/part.stl"));
  EXPECT_TRUE(is_there("dismantle-uploads-locked/part.stl"));
  if (is_root) {
    EXPECT_TRUE(is_there("dismantle-uploads-theirs/part.stl"));
  }
  close(locked);
}

}  // namespace
}  // namespace dismantle::server
