// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/motion/motion_span.h"

#include "tests/audit/audit_scenes.h"

#include <gtest/gtest.h>

#include <random>

namespace dismantle::audit {
namespace {

std::vector<Frame> random_frames(std::mt19937_64& random, int count) {
  std::normal_distribution<double> normal;
  std::vector<Frame> frames;
  Pose pose;
  for (int k = 0; k < count; ++k) {
    frames.push_back({0.1 * k, pose});
    const Vec3 axis = normalized(Vec3{normal(random), normal(random), normal(random)});
    pose =
        Pose{0.5 * Vec3{normal(random), normal(random), normal(random)}, quat_about(axis, 0.3 * normal(random))} * pose;
  }
  return frames;
}

TEST(MotionSpan, BoundsEveryPointAtEveryInstant) {
  std::mt19937_64 random(5);
  const AuditBody body(scenes::component("body", scenes::box({10, 20, 30}, {14, 21, 33})));
  for (int i = 0; i < 20; ++i) {
    const std::vector<Frame> frames = random_frames(random, 30);
    const auto segments = motion_segments(frames);
    ASSERT_EQ(segments.size(), 30u);
    for (const MotionSpan& span : motion_spans(segments, 0, 30, body)) {
      const RigidTransform reference = body.world_from_body(segments[span.middle].start);
      for (std::uint32_t k = span.first; k < span.first + span.count; ++k) {
        for (int step = 0; step <= 10; ++step) {
          const RigidTransform moved = transform_from_pose(screw_at(segments[k].screw, step / 10.0));
          for (std::uint32_t v = 0; v < body.vertex_count(); ++v) {
            const Vec3 now = moved * (body.world_from_body(segments[k].start) * body.vertex(v));
            const double bound = span.shift + span.turn * length(body.vertex(v));
            EXPECT_LE(length(now - reference * body.vertex(v)), bound + 1e-9);
          }
        }
      }
    }
  }
}

TEST(MotionSpan, SplitsIntoHalvesDownToSingleSegments) {
  std::mt19937_64 random(6);
  const AuditBody body(scenes::component("body", scenes::box({0, 0, 0}, {1, 1, 1})));
  const auto segments = motion_segments(random_frames(random, 40));
  const auto spans = motion_spans(segments, 8, 32, body);
  EXPECT_EQ(spans.size(), 63u);
  std::uint32_t singles = 0;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    if (spans[i].count == 1) {
      EXPECT_EQ(spans[i].first, 8 + singles++);
      EXPECT_EQ(spans[i].middle, spans[i].first);
      continue;
    }
    EXPECT_EQ(spans[i + 1].first, spans[i].first);
    EXPECT_EQ(spans[i].first + spans[i + 1].count, spans[spans[i].right].first);
    EXPECT_EQ(spans[i + 1].count + spans[spans[i].right].count, spans[i].count);
  }
  EXPECT_EQ(singles, 32u);
}

TEST(MotionSegments, LeaveOutRepeatedFramesAndEndAtTheLast) {
  std::vector<Frame> frames(4);
  frames[1].time = 1;
  frames[2] = {2, {{1, 0, 0}, {}}};
  frames[3] = {3, {{1, 0, 0}, {}}};
  const auto segments = motion_segments(frames);
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0].frame, 1u);
  EXPECT_EQ(segments[1].frame, 3u);
  EXPECT_EQ(segments[1].screw.velocity, Vec3{});
  EXPECT_TRUE(motion_segments({}).empty());
}

}  // namespace
}  // namespace dismantle::audit
