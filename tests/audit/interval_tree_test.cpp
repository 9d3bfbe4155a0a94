// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/interval_tree.h"

#include "tests/audit/audit_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dismantle::audit {
namespace {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double normal() { return normal_(random_); }
  /// Between 10^low and 1.
  double magnitude(double low) { return std::pow(10, low * uniform_(random_)); }
  double coin() { return random_() % 2 == 0 ? -1 : 1; }
  Vec3 vector() { return {normal(), normal(), normal()}; }
  RigidTransform pose() { return transform_from_pose({vector(), quat_about(normalized(vector()), normal())}); }
  Screw screw() { return {{}, magnitude(-2) * 3 * vector(), normalized(vector()), magnitude(-3)}; }
  /// Often long and thin, like the boxes of a cylinder's facets.
  BoxNode box() {
    BoxNode node;
    node.center = vector();
    node.half = {magnitude(-3), magnitude(-3), magnitude(-3)};
    node.radius = length(node.half);
    node.reach = length(node.center) + node.radius;
    return node;
  }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
};

Vec3 corner(const BoxNode& box, int index) {
  const Vec3 signs{(index & 1) != 0 ? 1.0 : -1.0, (index & 2) != 0 ? 1.0 : -1.0, (index & 4) != 0 ? 1.0 : -1.0};
  return box.center + Vec3{signs.x * box.half.x, signs.y * box.half.y, signs.z * box.half.z};
}

double distance_to_box(const BoxNode& box, Vec3 point) {
  const Vec3 offset = point - box.center;
  return length(max(max(offset, -offset) - box.half, Vec3{}));
}

/// The minimum distance of a corner of one box from the other box, at 41 instants.
double sampled_distance(const RelativeMotion& motion, const BoxNode& a, const BoxNode& b) {
  double minimum = 1e300;
  for (int step = 0; step <= 40; ++step) {
    const RigidTransform a_from_b = motion.at(step / 40.0);
    const RigidTransform b_from_a = inverse(a_from_b);
    for (int k = 0; k < 8; ++k) {
      minimum = std::min(minimum, distance_to_box(a, a_from_b * corner(b, k)));
      minimum = std::min(minimum, distance_to_box(b, b_from_a * corner(a, k)));
    }
  }
  return minimum;
}

/// True if the two boxes are found to be further apart than `distance`. Starting from the box of a must give the same
/// answer as starting from the box of b.
bool are_clear(const Interval& time, const BoxNode& a, const BoxNode& b, double distance) {
  const bool from_b = BoxInInterval(time, b, true).is_clear_of(a, distance);
  EXPECT_EQ(BoxInInterval(time, a, false).is_clear_of(b, distance), from_b);
  return from_b;
}

TEST(BoxInInterval, IsClearOfNothingThatComesNearer) {
  Draw draw(11);
  int positive = 0, half_way = 0;
  for (int i = 0; i < 20000; ++i) {
    const RelativeMotion motion{draw.pose(), draw.screw()};
    const BoxNode a = draw.box(), b = draw.box();
    const Interval time = interval_of(motion);
    const double distance = sampled_distance(motion, a, b);
    ASSERT_FALSE(are_clear(time, a, b, distance + 1e-9)) << "scene " << i;
    positive += are_clear(time, a, b, 0) ? 1 : 0;
    half_way += are_clear(time, a, b, 0.5 * distance) ? 1 : 0;
  }
  EXPECT_GT(positive, 4000) << "it must not be trivially false";
  EXPECT_GT(half_way, 2000);
}

TEST(BoxInInterval, IsNotClearOfAPointThatARodSwingsPast) {
  // The rod lies along x, turns about its own middle, and its tip passes the point from below.
  RelativeMotion motion;
  motion.screw.axis = {0, 0, 1};
  motion.screw.angle = 0.1;
  BoxNode rod, point;
  rod.half = {10, 0, 0};
  rod.radius = rod.reach = 10;
  point.center = {9.9, 0.9, 0};
  EXPECT_FALSE(are_clear(interval_of(motion), point, rod, 0));
  point.center.y = 1.2;
  EXPECT_TRUE(are_clear(interval_of(motion), point, rod, 0));
}

TEST(Interval, ReachBoundsTheTravelOfAPoint) {
  Draw draw(12);
  for (int i = 0; i < 2000; ++i) {
    const RelativeMotion motion{draw.pose(), draw.screw()};
    const BoxNode b = draw.box();
    const double reach = interval_of(motion).reach(b);
    for (int k = 0; k < 8; ++k)
      ASSERT_LE(length(motion.at(1) * corner(b, k) - motion.start * corner(b, k)), reach + 1e-9);
  }
}

/// A pair whose second body makes `count` random screw motions.
struct Scene {
  AuditBody a{scenes::component("a", scenes::box({0, 0, 0}, {2, 2, 2}))};
  AuditBody b{scenes::component("b", scenes::box({3, 0, 0}, {4, 1, 2}))};
  PairMotion pair;
  std::vector<MotionSpan> spans;

  explicit Scene(int count) {
    Draw draw(13);
    std::vector<Frame> frames(1);
    while (static_cast<int>(frames.size()) < count) {
      const Pose step{0.3 * draw.vector(), quat_about(normalized(draw.vector()), 0.2 * draw.normal())};
      frames.push_back({0.1 * static_cast<double>(frames.size()), step * frames.back().pose});
    }
    const auto segments = motion_segments(frames);
    pair.a = &a;
    pair.b = &b;
    for (const MotionSegment& segment : segments)
      pair.motions.push_back(relative_motion(a.world_from_body({}), b.world_from_body(segment.start), segment.screw));
    spans = motion_spans(segments, 0, static_cast<std::uint32_t>(segments.size()), b);
  }
};

TEST(IntervalTree, BoundsEveryInstantOfEveryInterval) {
  const Scene scene(20);
  IntervalTree tree(scene.pair, scene.spans);
  const BoxNode& a = scene.a.node(0);
  const BoxNode& b = scene.b.node(0);
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const std::uint32_t i = stack.back();
    stack.pop_back();
    const Interval& time = tree[i];
    for (std::uint32_t k = time.first; k < time.first + time.count; ++k) {
      RelativeMotion part = scene.pair.motions[k];
      if (time.one_segment()) {
        part.start = part.at(time.s);
        part.screw.velocity = time.duration * part.screw.velocity;
        part.screw.angle *= time.duration;
      }
      ASSERT_FALSE(are_clear(time, a, b, sampled_distance(part, a, b) + 1e-9)) << "segment " << k;
    }
    if (!tree.can_split(i)) continue;
    for (const std::uint32_t half : tree.halves(i)) stack.push_back(half);
  }
}

TEST(IntervalTree, BisectsTimeInOrderWithoutGaps) {
  const Scene scene(5);
  IntervalTree tree(scene.pair, scene.spans);
  double reached = 0;
  const auto walk = [&](const auto& self, std::uint32_t i) -> void {
    if (tree.can_split(i)) {
      const auto& halves = tree.halves(i);
      EXPECT_EQ(&halves, &tree.halves(i)) << "made once";
      for (const std::uint32_t half : halves) self(self, half);
      return;
    }
    const Interval& time = tree[i];
    EXPECT_EQ(time.first + time.s, reached);
    EXPECT_EQ(time.duration, std::ldexp(1.0, -IntervalTree::kMaxHalvings));
    const RigidTransform expected = scene.pair.motions[time.first].at(time.s + time.duration);
    EXPECT_LT(length(time.motion.at(1) * Vec3{1, 2, 3} - expected * Vec3{1, 2, 3}), 1e-12);
    reached = time.first + time.s + time.duration;
  };
  walk(walk, 0);
  EXPECT_EQ(reached, 5);
}

}  // namespace
}  // namespace dismantle::audit
