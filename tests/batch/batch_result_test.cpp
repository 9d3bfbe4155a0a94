// SPDX-License-Identifier: Apache-2.0
#include "apps/batch/batch_result.h"

#include "tests/batch/batch_fixture.h"

namespace dismantle::batch {
namespace {

class BatchResults : public BatchFolder {
 protected:
  void SetUp() override {
    BatchFolder::SetUp();
    job_ = job(2, {});
    fs::create_directories(job_.work_folder() / "work");
  }
  void publish(const BatchItem& item, const BatchResult& result) {
    fs::create_directories(job_.work_folder() / "work");
    const Result<Done> done = publish_result(job_, item, job_.work_folder() / "work", result, {1.5, "host"});
    EXPECT_TRUE(done.ok()) << done.error().message;
  }
  BatchJob job_;
};

TEST_F(BatchResults, AreReusedUntilTheirKeyChanges) {
  EXPECT_FALSE(find_result(job_, job_.items[0]));
  publish(job_.items[0], {"", R"({"components": 3})"});
  ASSERT_TRUE(find_result(job_, job_.items[0]));
  EXPECT_FALSE(find_result(job_, job_.items[0])->failed());
  job_.items[0].key = "of other options";
  EXPECT_FALSE(find_result(job_, job_.items[0]));
}

TEST_F(BatchResults, ReplaceOlderOnesEntirely) {
  std::ofstream(job_.work_folder() / "work" / "only-of-the-first.txt") << "x";
  publish(job_.items[0], {"", "{}"});
  EXPECT_TRUE(fs::exists(job_.output / "a" / "only-of-the-first.txt"));
  job_.items[0].key = "of other options";
  publish(job_.items[0], {"it broke (why); do that", "{}"});
  EXPECT_FALSE(fs::exists(job_.output / "a" / "only-of-the-first.txt"));
  ASSERT_TRUE(find_result(job_, job_.items[0]));
  EXPECT_EQ(find_result(job_, job_.items[0])->error, "it broke (why); do that");
}

TEST_F(BatchResults, AreMissingIfTheFileIsBroken) {
  publish(job_.items[0], {"", "{}"});
  std::ofstream(job_.output / "a" / "result.json") << "{\"format\": \"dismantle-batch-re";
  EXPECT_FALSE(find_result(job_, job_.items[0]));
}

TEST_F(BatchResults, MakeATableWithAColumnForEachValue) {
  publish(job_.items[0], {"", R"({"components": 3, "name": "tab\there"})"});
  publish(job_.items[1], {"it broke (why); do that", "{}"});
  const Result<BatchTables> tables = write_tables(job_);
  ASSERT_TRUE(tables.ok()) << tables.error().message;
  EXPECT_EQ(tables->failed, 1u);
  EXPECT_EQ(tables->tsv,
            "assembly\tfolder\tstatus\terror\tcomponents\tname\n"
            "a\ta\tdone\t\t3\ttab here\n"
            "b\tb\tfailed\tit broke (why); do that\t\t\n");
  EXPECT_EQ(read(job_.output / "batch.tsv"), tables->tsv);
  EXPECT_EQ(read(job_.output / "batch.json"), tables->json);
  EXPECT_EQ(read(job_.output / "timing.tsv"), "assembly\tseconds\thost\na\t1.5\thost\nb\t1.5\thost\n");
}

TEST_F(BatchResults, MakeNoTableIfOneIsMissing) {
  publish(job_.items[0], {"", "{}"});
  const Result<BatchTables> tables = write_tables(job_);
  ASSERT_FALSE(tables.ok());
  EXPECT_NE(tables.error().message.find("the result of b is gone"), std::string::npos);
  EXPECT_FALSE(fs::exists(job_.output / "batch.tsv"));
}

}  // namespace
}  // namespace dismantle::batch
