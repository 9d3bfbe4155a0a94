// SPDX-License-Identifier: Apache-2.0
#include "apps/batch/run_batch.h"

#include "tests/batch/batch_fixture.h"

#include <sys/wait.h>

#include <csignal>
#include <map>
#include <new>
#include <thread>

namespace dismantle::batch {
namespace {

/// Work that writes a file named after its item, and counts its runs in attempts/.
class RunBatch : public BatchFolder {
 protected:
  BatchWork work() const {
    return [root = root_](const BatchItem& item, const fs::path& folder) -> Result<std::string> {
      fs::create_directories(root / "attempts");
      std::ofstream(root / "attempts" / item.name, std::ios::app) << "x";
      std::ofstream(folder / "made.txt") << item.name;
      return "{\"letter\": \"" + item.name + "\"}";
    };
  }
  std::size_t attempts(const std::string& item) const { return read(root_ / "attempts" / item).size(); }

  /// Everything in the output folder but the costs.
  std::map<std::string, std::string> output() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(root_ / "out"))
      if (entry.is_regular_file() && entry.path().stem() != "timing")
        files[entry.path().lexically_relative(root_).string()] = read(entry.path());
    return files;
  }
};

TEST_F(RunBatch, GivesTheSameForAnyNumberOfWorkers) {
  std::map<std::string, std::string> first;
  for (const int workers : {1, 2, 5}) {
    const Result<BatchTables> tables = run_batch(job(9, work()), {workers, false, {}});
    ASSERT_TRUE(tables.ok()) << tables.error().message;
    EXPECT_EQ(tables->failed, 0u);
    if (first.empty()) first = output();
    EXPECT_EQ(output(), first) << workers;
    EXPECT_FALSE(fs::exists(root_ / "out" / ".batch")) << "nothing is left behind";
    fs::remove_all(root_ / "out");
  }
  EXPECT_EQ(first.at("out/c/made.txt"), "c");
  EXPECT_EQ(first.size(), 9 * 2 + 2u);
}

TEST_F(RunBatch, SkipsItemsThatAreDone) {
  BatchJob batch = job(3, work());
  ASSERT_TRUE(run_batch(batch, {2, false, {}}).ok());
  std::map<std::uint32_t, BatchProgress> progress;
  batch.items[1].key = "of changed input";
  ASSERT_TRUE(run_batch(batch, {2, false, [&](std::uint32_t i, BatchProgress p) { progress[i] = p; }}).ok());
  EXPECT_EQ(attempts("a"), 1u);
  EXPECT_EQ(attempts("b"), 2u);
  EXPECT_EQ(attempts("c"), 1u);
  EXPECT_EQ(progress[0], BatchProgress::Found);
  EXPECT_EQ(progress[1], BatchProgress::Made);
}

TEST_F(RunBatch, RecordsACrashAnErrorAndAnExceptionAsFailures) {
  const BatchWork bad = [good = work()](const BatchItem& item, const fs::path& folder) -> Result<std::string> {
    if (item.name == "a") std::abort();
    if (item.name == "b") return Error{ErrorKind::Unreadable, "b cannot be read (why); do that"};
    if (item.name == "c") throw std::bad_alloc();
    return good(item, folder);
  };
  const Result<BatchTables> tables = run_batch(job(4, bad), {2, false, {}});
  ASSERT_TRUE(tables.ok()) << tables.error().message;
  EXPECT_EQ(tables->failed, 3u);
  EXPECT_NE(tables->tsv.find("a\ta\tfailed\ta was given up (the work on it crashed)"), std::string::npos)
      << tables->tsv;
  EXPECT_NE(tables->tsv.find("b\tb\tfailed\tb cannot be read (why); do that"), std::string::npos);
  EXPECT_NE(tables->tsv.find("needs more memory"), std::string::npos);
  EXPECT_NE(tables->tsv.find("d\td\tdone"), std::string::npos);

  ASSERT_TRUE(run_batch(job(4, work()), {2, false, {}}).ok());
  EXPECT_EQ(attempts("a"), 0u) << "failed items are not repeated automatically";
  const Result<BatchTables> again = run_batch(job(4, work()), {2, true, {}});
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->failed, 0u);
  EXPECT_EQ(attempts("d"), 1u);
}

TEST_F(RunBatch, EndsWhereAnOutputCannotBeWrittenAndDoesTheItemAgain) {
  const BatchWork full_disk = [](const BatchItem&, const fs::path& folder) -> Result<std::string> {
    return Error{ErrorKind::Failed, (folder / "check.json").string() + " cannot be written (No space left on device)"};
  };
  EXPECT_FALSE(run_batch(job(2, full_disk), {1, false, {}}).ok());
  EXPECT_TRUE(fs::is_empty(root_ / "out" / ".batch")) << "no claims and no partial results";
  const Result<BatchTables> tables = run_batch(job(2, work()), {2, false, {}});
  ASSERT_TRUE(tables.ok()) << tables.error().message;
  EXPECT_EQ(tables->failed, 0u);
  EXPECT_EQ(attempts("a"), 1u);
}

TEST_F(RunBatch, StopsAnItemThatExceedsItsTime) {
  BatchJob batch = job(2, [good = work()](const BatchItem& item, const fs::path& folder) {
    volatile bool forever = item.name == "a";
    while (forever) {
    }
    return good(item, folder);
  });
  batch.limits.cpu_seconds = 0.1;
  const Result<BatchTables> tables = run_batch(batch, {2, false, {}});
  ASSERT_TRUE(tables.ok()) << tables.error().message;
  EXPECT_EQ(tables->failed, 1u);
  EXPECT_NE(tables->tsv.find("did not finish"), std::string::npos);
}

TEST_F(RunBatch, RedoesTheItemOfAKilledWorker) {
  // On its first run, the item's process kills its worker, which is its parent, and itself.
  const BatchWork murder = [root = root_, good = work()](const BatchItem& item, const fs::path& folder) {
    const fs::path done = root / "murder-done";
    if (item.name == "b" && !fs::exists(done)) {
      std::ofstream{done};
      kill(getppid(), SIGKILL);
      std::this_thread::sleep_for(std::chrono::seconds(10));
    }
    return good(item, folder);
  };
  const Result<BatchTables> tables = run_batch(job(4, murder), {2, false, {}});
  ASSERT_TRUE(tables.ok()) << tables.error().message;
  EXPECT_TRUE(fs::exists(root_ / "murder-done"));
  const auto with_murder = output();
  EXPECT_FALSE(fs::exists(root_ / "out" / ".batch"));
  fs::remove_all(root_ / "out");
  ASSERT_TRUE(run_batch(job(4, work()), {1, false, {}}).ok());
  EXPECT_EQ(output(), with_murder);
}

TEST_F(RunBatch, GivesUpAnItemThatKillsItsWorkerEveryTime) {
  const BatchWork murder = [good = work()](const BatchItem& item, const fs::path& folder) {
    if (item.name == "b") {
      kill(getppid(), SIGKILL);
      std::this_thread::sleep_for(std::chrono::seconds(10));
    }
    return good(item, folder);
  };
  const Result<BatchTables> tables = run_batch(job(3, murder), {2, false, {}});
  ASSERT_TRUE(tables.ok()) << tables.error().message;
  EXPECT_EQ(tables->failed, 1u);
  EXPECT_NE(tables->tsv.find("3 processes died over it"), std::string::npos) << tables->tsv;
}

TEST_F(RunBatch, StopsOnASignalWithoutLossAndResumes) {
  const pid_t child = fork();
  if (child == 0) {
    // Largest items first: d and c are done when b stops the batch.
    const BatchWork stopping = [top = getpid(), good = work()](const BatchItem& item, const fs::path& folder) {
      if (item.name == "b") {
        kill(top, SIGINT);
        std::this_thread::sleep_for(std::chrono::seconds(10));
      }
      return good(item, folder);
    };
    const Result<BatchTables> tables = run_batch(job(4, stopping), {1, false, {}});
    _exit(!tables && tables.error().message.find("cancelled") != std::string::npos ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(fs::is_empty(root_ / "out" / ".batch")) << "no claims and no partial results";
  EXPECT_FALSE(fs::exists(root_ / "out" / "b"));

  ASSERT_TRUE(run_batch(job(4, work()), {2, false, {}}).ok());
  EXPECT_EQ(attempts("d"), 1u);
  EXPECT_EQ(attempts("c"), 1u);
  EXPECT_EQ(attempts("b"), 1u);
}

TEST_F(RunBatch, ReportsAnOutputFolderThatCannotBeCreated) {
  write("out", "a file");
  const Result<BatchTables> tables = run_batch(job(1, work()), {1, false, {}});
  ASSERT_FALSE(tables.ok());
  EXPECT_NE(tables.error().message.find("cannot be written"), std::string::npos);
}

}  // namespace
}  // namespace dismantle::batch
