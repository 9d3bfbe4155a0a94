// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/gltf/glb_keys.h"

#include "dismantle/math/screw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dismantle {
namespace {

const RigidTransform kPlacement = transform_from_pose({{120, -40, 7.5}, quat_about(normalized(Vec3{1, 2, 3}), 1.1)});

/// The mesh's frame at a key, in mm.
RigidTransform at_key(const GlbKeys& keys, std::size_t key) {
  const auto t = [&](std::size_t k) { return 1e3 * static_cast<double>(keys.translations[3 * key + k]); };
  const auto q = [&](std::size_t k) { return static_cast<double>(keys.rotations[4 * key + k]); };
  return {mat3_from_quat({q(3), q(0), q(1), q(2)}), {t(0), t(1), t(2)}};
}

/// The interpolation of a glTF player: linear, and along the shorter great circle.
RigidTransform at_time(const GlbKeys& keys, double time) {
  std::size_t next = 0;
  while (next < keys.times.size() && static_cast<double>(keys.times[next]) < time) ++next;
  if (next == 0) return at_key(keys, 0);
  if (next == keys.times.size()) return at_key(keys, next - 1);
  const double before = static_cast<double>(keys.times[next - 1]);
  const double share = (time - before) / (static_cast<double>(keys.times[next]) - before);
  const RigidTransform a = at_key(keys, next - 1), b = at_key(keys, next);
  const Pose turn = pose_between({{}, quat_from_mat3(a.rotation)}, {{}, quat_from_mat3(b.rotation)}, share);
  return {mat3_from_quat(turn.rotation), (1 - share) * a.translation + share * b.translation};
}

/// The largest distance of a point of a 50 mm mesh.
double apart(const RigidTransform& a, const RigidTransform& b) {
  double maximum = 0;
  for (const Vec3& p : {Vec3{}, Vec3{50, 0, 0}, Vec3{0, 50, 0}, Vec3{0, 0, -50}})
    maximum = std::max(maximum, length(a * p - b * p));
  return maximum;
}

TEST(GlbKeys, StoreEachFrameAsTheNearestFloats) {
  const std::vector<Frame> frames{{0, {}},
                                  {0.1, {{1.0 / 3, -2e3 / 7, 1e-4}, quat_about({0, 1, 0}, 0.01)}},
                                  {0.35, {{512.3, -2e3 / 7, 1e-4}, quat_about({0, 1, 0}, 0.013)}}};
  const GlbKeys keys = glb_keys({}, frames);
  for (const Frame& frame : frames) {
    const auto place = std::find(keys.times.begin(), keys.times.end(), static_cast<float>(frame.time));
    ASSERT_NE(place, keys.times.end());
    const auto k = static_cast<std::size_t>(place - keys.times.begin());
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(keys.translations[3 * k + static_cast<std::size_t>(axis)],
                static_cast<float>(1e-3 * frame.pose.position[axis]));
    const Quat& q = frame.pose.rotation;
    EXPECT_EQ((std::vector<float>{keys.rotations.begin() + static_cast<long>(4 * k),
                                  keys.rotations.begin() + static_cast<long>(4 * k + 4)}),
              (std::vector<float>{static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z),
                                  static_cast<float>(q.w)}));
  }
}

TEST(GlbKeys, FollowACurvedScrew) {
  const std::uint32_t seed = 20261122;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const auto pose = [&] {
      const Vec3 axis = normalized(Vec3{unit(random), unit(random), 1.5 + unit(random)});
      return Pose{{300 * unit(random), 300 * unit(random), 300 * unit(random)}, quat_about(axis, 3 * unit(random))};
    };
    const Pose start = pose(), end = pose();
    const GlbKeys keys = glb_keys(kPlacement, std::vector<Frame>{{0, start}, {2, end}});
    for (double s = 0; s <= 1; s += 0.037) {
      const RigidTransform truth = transform_from_pose(pose_between(start, end, s)) * kPlacement;
      // The deviation, and rounding of floats: of coordinates of 0.5 m, of a rotation at 50 mm, of the time at this
      // speed.
      ASSERT_LT(apart(at_time(keys, 2 * s), truth), kGlbDeviation + 3e-4) << i << " at " << s;
    }
  }
}

TEST(GlbKeys, StayOnOneHemisphereOfQuaternions) {
  std::vector<Frame> frames;
  for (int i = 0; i <= 40; ++i) {
    const Quat q = quat_about({0, 0, 1}, 0.4 * i);
    frames.push_back({0.1 * i, {{}, i % 2 == 0 ? q : -q}});
  }
  const GlbKeys keys = glb_keys({}, frames);
  ASSERT_EQ(keys.times.size(), frames.size());
  for (std::size_t k = 4; k < keys.rotations.size(); k += 4) {
    float side = 0;
    for (std::size_t j = 0; j < 4; ++j) side += keys.rotations[k + j] * keys.rotations[k - 4 + j];
    EXPECT_GT(side, 0.9f);
  }
}

TEST(GlbKeys, AscendEvenIfFloatsCannotDistinguishTimes) {
  std::vector<Frame> frames;
  for (int i = 0; i < 8; ++i) frames.push_back({1000 + 1e-6 * i, {{1.0 * i, 0, 0}, {}}});
  frames.push_back({frames.back().time, {{9, 0, 0}, {}}});
  const GlbKeys keys = glb_keys({}, frames);
  ASSERT_EQ(keys.times.size(), frames.size());
  for (std::size_t k = 1; k < keys.times.size(); ++k) EXPECT_GT(keys.times[k], keys.times[k - 1]);
}

TEST(GlbKeys, OmitTheMiddleOfARest) {
  std::vector<Frame> frames{{0, {}}};
  for (int i = 1; i < 100; ++i) frames.push_back({0.01 * i, {{5, 0, 0}, {}}});
  frames.push_back({1, {{6, 0, 0}, {}}});
  const GlbKeys keys = glb_keys({}, frames);
  EXPECT_EQ(keys.times, (std::vector<float>{0, 0.01f, 0.99f, 1}));
}

TEST(GlbKeys, OmitRepeatedFrames) {
  const std::vector<Frame> frames{{0, {}}, {1, {{3, 0, 0}, {}}}, {1, {{3, 0, 0}, {}}}, {2, {{4, 0, 0}, {}}}};
  EXPECT_EQ(glb_keys({}, frames).times, (std::vector<float>{0, 1, 2}));
}

}  // namespace
}  // namespace dismantle
