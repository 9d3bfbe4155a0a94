// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/paper_methods.h"

#include "bench/paper/paper_scenes.h"
#include "bench/timing.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dismantle {
namespace {

constexpr PaperMethod kElementary[] = {PaperMethod::FrontBased, PaperMethod::FrontBasedRigid,
                                       PaperMethod::StreamsElementary, PaperMethod::StreamsGlobalLock};

/// An assembly of the paper at the paper's size.
const BenchScene& simplified_sample() {
  static const BenchScene kScene =
      make_paper_scene(paper_assemblies().front(), DISMANTLE_SOURCE_DIR "/samples").value().simplified;
  return kScene;
}

// The beginning of the disassembly motion of an assembly at the paper's size: some of its steps are blocked.
TEST(PaperMethods, StopAtTheSamePosesWithElementaryTests) {
  const MethodRun expected = run_method(PaperMethod::StreamsElementary, simplified_sample(), {.moves = 2});
  EXPECT_GT(expected.poses.size(), 200u);
  EXPECT_EQ(expected.times.size(), expected.poses.size());
  EXPECT_GT(expected.reached, 200u);
  EXPECT_LT(expected.reached, expected.poses.size());
  for (const PaperMethod method : kElementary) {
    const MethodRun run = run_method(method, simplified_sample(), {.cores = 2, .moves = 2});
    EXPECT_EQ(run.poses, expected.poses) << name_of(method);
    EXPECT_EQ(run.reached, expected.reached);
  }
}

TEST(PaperMethods, StopAtTheSamePosesWithThePapersPairsOfWhichSomeMoveEmbedded) {
  const Result<BenchScene> paper = with_paper_pairs(simplified_sample());
  ASSERT_TRUE(paper.ok());
  const MethodRun expected = run_method(PaperMethod::StreamsElementary, *paper, {.moves = 2});
  const auto embedded = std::count(expected.embedded.begin(), expected.embedded.end(), 1);
  EXPECT_GT(embedded, 0);
  EXPECT_LT(static_cast<std::size_t>(embedded), expected.embedded.size());
  for (const PaperMethod method : kElementary) {
    const MethodRun run = run_method(method, *paper, {.cores = 2, .moves = 2});
    EXPECT_EQ(run.poses, expected.poses) << name_of(method);
    EXPECT_EQ(run.embedded, expected.embedded);
  }
}

TEST(PaperMethods, KeepTheMedianTimeOfEachStepWhenTheyRepeat) {
  const Result<std::vector<BenchScene>> made = make_bench_scenes("shaft_100um", {1000, 20}, "");
  ASSERT_TRUE(made.ok());
  for (const PaperMethod method :
       {PaperMethod::StreamsCertified, PaperMethod::Certificates, PaperMethod::ObbDiscrete, PaperMethod::ObbBoxes}) {
    const MethodRun run = run_method(method, made->front(), {.repeats = 3});
    EXPECT_EQ(run.times.size(), 20u);
    EXPECT_EQ(run.poses.size(), 20u);
    EXPECT_EQ(run.reached, method == PaperMethod::ObbBoxes ? 0u : 20u) << "the box of the hole is filled";
    ASSERT_EQ(run.play_means.size(), 3u);
    // A median is at least the shortest of three, and at most their sum.
    const double mean = mean_times(run).overall;
    EXPECT_GT(mean, 0);
    EXPECT_LE(mean, run.play_means[0] + run.play_means[1] + run.play_means[2]);
    const std::vector<double> ms = overall_times(run);
    EXPECT_LE(bench::quantile(ms, 0), mean);
    EXPECT_GE(bench::quantile(ms, 1), mean);
  }
}

TEST(PaperMethods, PlayTheFirstMovesAlone) {
  const MethodRun run = run_method(PaperMethod::StreamsElementary, simplified_sample(), {.moves = 1});
  EXPECT_EQ(run.times.size(), simplified_sample().moves.front().targets.size() - 1);
}

}  // namespace
}  // namespace dismantle
