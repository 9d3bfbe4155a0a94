// SPDX-License-Identifier: Apache-2.0
#include "apps/batch/claim_folder.h"

#include "tests/batch/batch_fixture.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <csignal>
#include <thread>

namespace dismantle::batch {
namespace {

constexpr double kLongLease = 1000;  // [s]: longer than any test, so that expiry plays no part

class Claims : public BatchFolder {
 protected:
  /// Starts a process that claims the item, does `work`, and is killed. @return its id, which is still to be waited for
  template <class Work>
  pid_t killed_after(const Work& work) const {
    const pid_t child = fork();
    if (child == 0) {
      const std::optional<Claim> claim = ClaimFolder(root_, kLongLease).try_claim("item");
      work(*claim);
      kill(getpid(), SIGKILL);
    }
    return child;
  }
  /// The link of the first attempt, as a process on another machine would have made it.
  void claim_from_elsewhere() const { fs::create_symlink("another-machine 1 1", root_ / "item.claim.1"); }
};

TEST_F(Claims, BelongToOneProcessOnly) {
  ClaimFolder folder(root_, kLongLease);
  std::optional<Claim> claim = folder.try_claim("item");
  ASSERT_TRUE(claim);
  EXPECT_EQ(claim->attempt(), 1);
  EXPECT_TRUE(claim->is_held());
  EXPECT_FALSE(ClaimFolder(root_, kLongLease).try_claim("item")) << "its owner is alive";
  EXPECT_TRUE(folder.try_claim("another"));
  claim->release();
  EXPECT_FALSE(claim->is_held());
  EXPECT_TRUE(ClaimFolder(root_, kLongLease).try_claim("item"));
}

TEST_F(Claims, OfAKilledProcessAreTakenOverAtOnceWithItsFiles) {
  const auto make_scratch_folder = [](const Claim& claim) { fs::create_directories(claim.scratch_folder()); };
  waitpid(killed_after(make_scratch_folder), nullptr, 0);
  std::optional<Claim> claim = ClaimFolder(root_, kLongLease).try_claim("item");
  ASSERT_TRUE(claim);
  EXPECT_EQ(claim->attempt(), 2);
  EXPECT_TRUE(fs::exists(claim->scratch_folder(1)));
  claim->release();
  EXPECT_TRUE(fs::is_empty(root_));
}

TEST_F(Claims, OfAKilledProcessThatNobodyHasWaitedForAreTakenOver) {
  const pid_t child = killed_after([](const Claim&) {});
  siginfo_t ended{};
  waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT);  // it stays a zombie
  const std::optional<Claim> claim = ClaimFolder(root_, kLongLease).try_claim("item");
  waitpid(child, nullptr, 0);
  ASSERT_TRUE(claim);
  EXPECT_EQ(claim->attempt(), 2);
}

TEST_F(Claims, AreHeldWhereOnlyALaterOneOfAKilledProcessIsLeft) {
  // As if killed in release(), after the first of two claims was removed.
  const auto rename_claim = [&](const Claim&) { fs::rename(root_ / "item.claim.1", root_ / "item.claim.2"); };
  waitpid(killed_after(rename_claim), nullptr, 0);
  std::optional<Claim> claim = ClaimFolder(root_, kLongLease).try_claim("item");
  ASSERT_TRUE(claim);
  EXPECT_EQ(claim->attempt(), 3);
  EXPECT_TRUE(claim->is_held());
  claim->release();
  EXPECT_TRUE(fs::is_empty(root_));
}

TEST_F(Claims, AreRemovedWhereTheirProcessesHaveEnded) {
  const auto make_scratch_folder = [](const Claim& claim) { fs::create_directories(claim.scratch_folder()); };
  waitpid(killed_after(make_scratch_folder), nullptr, 0);
  fs::create_directories(root_ / "item.old.12.34");
  ClaimFolder folder(root_, kLongLease);
  const std::optional<Claim> living = folder.try_claim("a.old.1.2");
  ASSERT_TRUE(living);
  fs::create_directories(living->scratch_folder());
  folder.remove_abandoned();
  EXPECT_TRUE(living->is_held());
  EXPECT_TRUE(fs::exists(living->scratch_folder()));
  EXPECT_EQ(std::distance(fs::directory_iterator(root_), fs::directory_iterator()), 2);
}

TEST_F(Claims, OfAnotherMachineExpireWithoutRenewal) {
  claim_from_elsewhere();
  ClaimFolder folder(root_, 0.05);
  EXPECT_FALSE(folder.try_claim("item")) << "it has not been silent long enough";
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const std::optional<Claim> claim = folder.try_claim("item");
  ASSERT_TRUE(claim);
  EXPECT_EQ(claim->attempt(), 2);
}

TEST_F(Claims, OfAnotherMachineLastWhileItRenewsThem) {
  claim_from_elsewhere();
  ClaimFolder folder(root_, 0.05);
  for (int k = 1; k <= 3; ++k) {
    EXPECT_FALSE(folder.try_claim("item"));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const timespec times[2] = {{k, 0}, {k, 0}};  // its clock may be wrong
    utimensat(AT_FDCWD, (root_ / "item.claim.1").c_str(), times, AT_SYMLINK_NOFOLLOW);
  }
  EXPECT_FALSE(folder.try_claim("item"));
}

TEST_F(Claims, AreRenewedByTheirOwner) {
  Claim claim = *ClaimFolder(root_, kLongLease).try_claim("item");
  const timespec long_ago[2] = {{1, 0}, {1, 0}};
  const std::string link = (root_ / "item.claim.1").string();
  utimensat(AT_FDCWD, link.c_str(), long_ago, AT_SYMLINK_NOFOLLOW);
  claim.renew(kLongLease);
  struct stat status {};
  lstat(link.c_str(), &status);
  EXPECT_EQ(status.st_mtim.tv_sec, 1) << "not again so soon";
  claim.renew(0);
  lstat(link.c_str(), &status);
  EXPECT_GT(status.st_mtim.tv_sec, 1);
}

TEST_F(Claims, AreReportedLostToTheirFormerOwner) {
  Claim claim = *ClaimFolder(root_, kLongLease).try_claim("item");
  fs::create_symlink("another-machine 1 1", root_ / "item.claim.2");
  EXPECT_FALSE(claim.is_held());
  claim.release();
  EXPECT_TRUE(fs::is_symlink(root_ / "item.claim.2")) << "that is not its own";
}

}  // namespace
}  // namespace dismantle::batch
