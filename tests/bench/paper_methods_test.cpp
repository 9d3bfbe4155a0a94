// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/paper_methods.h"

#include "bench/paper/paper_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

constexpr PaperMethod kElementary[] = {PaperMethod::FrontBased, PaperMethod::FrontBasedRigid,
                                       PaperMethod::StreamsElementary};

// The whole disassembly motion of an assembly at the paper's size: touching, fitting and embedded pairs.
TEST(PaperMethods, StopAtTheSamePosesWithElementaryTests) {
  const Result<PaperScene> scene = make_paper_scene(paper_table().front(), DISMANTLE_SOURCE_DIR "/samples");
  ASSERT_TRUE(scene.ok());
  const MethodRun expected = run_method(PaperMethod::StreamsElementary, scene->simplified, 1, 1);
  EXPECT_GT(expected.poses.size(), 1000u);
  EXPECT_EQ(expected.times.size(), expected.poses.size());
  EXPECT_GT(expected.reached, 500u);
  EXPECT_LT(expected.reached, expected.poses.size());
  for (const PaperMethod method : kElementary) {
    const MethodRun run = run_method(method, scene->simplified, 2, 1);
    EXPECT_EQ(run.poses, expected.poses) << name_of(method);
    EXPECT_EQ(run.reached, expected.reached);
  }
}

TEST(PaperMethods, KeepTheShortestTimeOfEachStepWhenTheyRepeat) {
  const Result<std::vector<BenchScene>> made = make_bench_scenes("shaft_100um", {1000, 20}, "");
  ASSERT_TRUE(made.ok());
  for (const PaperMethod method :
       {PaperMethod::StreamsCertified, PaperMethod::Certificates, PaperMethod::ObbDiscrete}) {
    const MethodRun run = run_method(method, made->front(), 1, 3);
    EXPECT_EQ(run.times.size(), 20u);
    EXPECT_EQ(run.reached, 20u);
    EXPECT_GT(mean_times(run).overall, 0);
    EXPECT_LE(overall_quantile(run, 0), overall_quantile(run, 0.5));
    EXPECT_LE(overall_quantile(run, 0.5), overall_quantile(run, 1));
  }
}

}  // namespace
}  // namespace dismantle
