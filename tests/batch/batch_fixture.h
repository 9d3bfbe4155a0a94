// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/batch/batch_job.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace dismantle::batch {

namespace fs = std::filesystem;

/// A separate folder for each test.
class BatchFolder : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::temp_directory_path() /
            ("dismantle_" + std::string(info->test_suite_name()) + "_" + info->name() + "_" + std::to_string(getpid()));
    fs::create_directories(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name) << text;
  }
  static std::string read(const fs::path& file) {
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  /// Items a, b, c, ... whose work the test defines; results are in out/.
  BatchJob job(std::size_t count, BatchWork work) const {
    BatchJob job;
    for (std::size_t i = 0; i < count; ++i) {
      const std::string name(1, static_cast<char>('a' + i));
      job.items.push_back({name, root_ / name, name, "key of " + name, i});
    }
    job.output = root_ / "out";
    job.work = std::move(work);
    return job;
  }

  fs::path root_;
};

}  // namespace dismantle::batch
