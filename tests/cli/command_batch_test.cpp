// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/cli_fixture.h"
#include "tests/support/test_data.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <map>
#include <nlohmann/json.hpp>

namespace dismantle {
namespace {

using Json = nlohmann::json;

/// In products/: assemblies of two or three boxes, and one that cannot be read.
class CliBatch : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    write_box("lid", 0, 0, 10, 10, 10, 12);
    for (const char* name : {"one", "two", "three", "deep/four", "deep/five", "deep/six"}) {
      fs::create_directories(in("products/" + std::string(name)));
      fs::copy(in("parts"), in("products/" + std::string(name)));
    }
    fs::remove(in("products/two/lid.obj"));
    write("products/broken.step", "this is no STEP file");
  }

  /// All results in a folder, without their costs.
  std::map<std::string, std::string> results(const std::string& folder) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(in(folder)))
      // Each rank writes the tables. mpirun kills the others once one has ended with 1, perhaps before its rename.
      if (entry.is_regular_file() && entry.path().stem() != "timing" && entry.path().extension() != ".tmp")
        files[entry.path().lexically_relative(in(folder)).string()] = read_all(entry.path());
    return files;
  }
};

TEST_F(CliBatch, ChecksAndPlansEveryAssemblyAndReportsFailures) {
  const Outcome o = run("batch products -o out --workers 2");
  EXPECT_EQ(o.exit_code, 1) << o.err;
  EXPECT_NE(o.out.find("] one: 3 components; pairs: 1 in contact, 0 overlapping; 2 removed in 2 steps"),
            std::string::npos)
      << o.out;
  EXPECT_NE(o.out.find("] broken.step: failed: "), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("7 assemblies, 1 failed; table: out/batch.tsv"), std::string::npos) << o.out;
  EXPECT_EQ(run("audit products/deep/four out/deep__four/plan.path.json").exit_code, 0);
  EXPECT_EQ(Json::parse(read_all(in("out/one/check.json")))["format"], "dismantle-check");

  const Json table = Json::parse(read_all(in("out/batch.json")));
  ASSERT_EQ(table["assemblies"].size(), 7u);
  EXPECT_EQ(table["assemblies"][0]["assembly"], "broken.step");
  EXPECT_EQ(table["assemblies"][0]["status"], "failed");
  EXPECT_EQ(table["assemblies"][1]["assembly"], "deep/five");
  EXPECT_EQ(table["assemblies"][1]["complete"], true);
}

TEST_F(CliBatch, RedoesOnlyWhatChanged) {
  ASSERT_EQ(run("batch products -o out --quiet --only 'deep/*' --check-only").exit_code, 0);
  const Outcome same = run("batch products -o out --only 'deep/*' --check-only");
  EXPECT_NE(same.out.find("[3/3] "), std::string::npos) << same.out;
  EXPECT_EQ(same.out.find("] deep/five: 3"), std::string::npos) << "it is repeated: " << same.out;
  EXPECT_NE(same.out.find("] deep/five: (done before) 3"), std::string::npos) << same.out;
  fs::remove(in("products/deep/five/lid.obj"));
  const Outcome changed = run("batch products -o out --only 'deep/*' --check-only");
  EXPECT_NE(changed.out.find("] deep/five: 2 components"), std::string::npos) << changed.out;
  EXPECT_NE(changed.out.find("] deep/four: (done before)"), std::string::npos) << changed.out;
  const Outcome options = run("batch products -o out --only 'deep/*' --check-only --tolerance 0.5");
  EXPECT_EQ(options.out.find("(done before)"), std::string::npos) << options.out;
}

TEST_F(CliBatch, PrintsTheTableAsJson) {
  const Outcome o = run("batch products -o out --json --only one");
  EXPECT_EQ(o.exit_code, 0);
  EXPECT_EQ(Json::parse(o.out), Json::parse(read_all(in("out/batch.json"))));
  EXPECT_NE(o.err.find("[1/1] one: "), std::string::npos);
}

TEST_F(CliBatch, RefusesInvalidArguments) {
  expect_error("batch missing -o out", 3, "missing cannot be read");
  fs::create_directories(in("empty"));
  expect_error("batch empty -o out", 3, "empty contains no assembly");
  EXPECT_EQ(run("batch products").exit_code, 2);
  EXPECT_EQ(run("batch products -o out --workers 0").exit_code, 2);
}

/// Under Open MPI's mpirun.
class CliBatchRanks : public CliBatch {
 protected:
  void SetUp() override {
    CliBatch::SetUp();
    if (std::system("command -v mpirun >/dev/null") != 0) DISMANTLE_SKIP_OR_FAIL("there is no mpirun");
    ASSERT_LE(run("batch products -o alone --workers 1 --quiet").exit_code, 1);
  }
  /// Four ranks of one worker each, over what `rank` runs.
  Outcome run_ranks(const std::string& options, const std::string& rank) const {
    const std::string command = "cd '" + folder_.string() +
                                "' && OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun -n 4 "
                                "--oversubscribe " +
                                options + " " + rank + " >stdout 2>stderr </dev/null";
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), read_all(in("stdout")), read_all(in("stderr"))};
  }
};

TEST_F(CliBatchRanks, GiveTheResultsOfOneProcess) {
  const Outcome o = run_ranks("", "'" DISMANTLE_PROGRAM "' batch products -o ranks --workers 1");
  EXPECT_EQ(o.exit_code, 1) << "one assembly cannot be read: " << o.err;
  EXPECT_EQ(results("ranks"), results("alone"));
  EXPECT_NE(o.out.find("7 assemblies, 1 failed"), std::string::npos) << o.out;
  EXPECT_EQ(o.out.find("7 assemblies"), o.out.rfind("7 assemblies")) << "more than one rank prints: " << o.out;
}

TEST_F(CliBatchRanks, GiveTheSameResultsIfOneIsKilled) {
  // The last rank is killed, with its processes, once work has begun.
  write("rank.sh", R"(#!/bin/sh
if [ "$OMPI_COMM_WORLD_RANK" != 3 ]; then exec ")" DISMANTLE_PROGRAM R"(" batch products -o ranks --workers 1; fi
")" DISMANTLE_PROGRAM R"(" batch products -o ranks --workers 1 &
until ls ranks/.batch/*.claim.1 >/dev/null 2>&1 || [ -e ranks/batch.tsv ]; do :; done
kill -KILL $!
kill -KILL $$
)");
  const Outcome o = run_ranks("--enable-recovery", "sh rank.sh");
  EXPECT_EQ(results("ranks"), results("alone")) << o.err;
  EXPECT_NE(o.out.find("7 assemblies, 1 failed"), std::string::npos) << o.out << o.err;
}

}  // namespace
}  // namespace dismantle
