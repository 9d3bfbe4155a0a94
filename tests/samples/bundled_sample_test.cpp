// SPDX-License-Identifier: Apache-2.0
#include "samples/bundled/bundled_sample.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace dismantle {
namespace {

std::string committed(const std::string& file) {
  std::ifstream in(std::string(DISMANTLE_SOURCE_DIR) + "/samples/" + file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(BundledSample, ListsTheFourBenchmarksOfThePaper) {
  std::vector<std::string_view> names;
  for (const BundledSample& sample : bundled_samples()) {
    names.push_back(sample.name);
    EXPECT_FALSE(sample.description.empty());
  }
  EXPECT_EQ(names, (std::vector<std::string_view>{"microscope", "tooling", "lathe", "robot"}));
}

TEST(BundledSample, UnpacksToTheCommittedFiles) {
  for (const BundledSample& sample : bundled_samples()) {
    const std::string name(sample.name);
    const Result<std::string> step = bundled_sample_step(name), motion = bundled_sample_motion(name);
    ASSERT_TRUE(step.ok()) << step.error().message;
    ASSERT_TRUE(motion.ok()) << motion.error().message;
    ASSERT_FALSE(step->empty());
    EXPECT_TRUE(*step == committed(name + ".step")) << name;
    EXPECT_TRUE(*motion == committed(name + ".motion.json")) << name;
  }
}

TEST(BundledSample, ListsTheSamplesIfTheNameIsUnknown) {
  for (const char* name : {"teapot", "", "lathe.step"}) {
    const Result<std::string> step = bundled_sample_step(name);
    ASSERT_FALSE(step.ok());
    EXPECT_EQ(step.error().kind, ErrorKind::Usage);
    EXPECT_NE(step.error().message.find("microscope, tooling, lathe, robot"), std::string::npos);
    EXPECT_FALSE(bundled_sample_motion(name).ok());
  }
}

}  // namespace
}  // namespace dismantle
