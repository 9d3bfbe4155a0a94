// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/sweep/near_components.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace dismantle {
namespace {

TEST(NearComponents, FindsTheSameAsAllGapsWhereverComponentsWerePlaced) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-500, 500), size(0.1, 20), share(0, 1);
  constexpr std::uint32_t kCount = 300;
  BoundingSpheres spheres;
  for (std::uint32_t c = 0; c < kCount; ++c) spheres.add({place(random), place(random), place(random)}, size(random));
  NearComponents near(spheres);
  std::vector<Pose> poses(kCount);
  const auto random_pose = [&] {
    if (share(random) < 0.3) return Pose{};  // back again
    if (share(random) < 0.5) return Pose{{1e5, 0, 0}, {}};
    return Pose{{place(random), place(random), place(random)}, {}};
  };
  for (int round = 0; round < 200; ++round) {
    for (int moved = 0; moved < 5; ++moved) {
      const auto c = static_cast<std::uint32_t>(random() % kCount);
      poses[c] = random_pose();
      near.place(ComponentId(c), poses[c]);
    }
    if (round % 3 == 0) near.rebuild_if_due();

    const ComponentId moving(static_cast<std::uint32_t>(random() % kCount));
    const RigidTransform from = transform_from_pose(poses[moving.value]);
    RigidTransform to = from;
    to.translation += Vec3{place(random), place(random), place(random)};
    std::set<ComponentId> expected, found;
    for (std::uint32_t c = 0; c < kCount; ++c)
      if (spheres.gap(moving, from, to, 0.5, ComponentId(c), poses[c]) <= 10) expected.insert(ComponentId(c));
    near.for_each(
        spheres.swept(moving, from, to, 0.5), [] { return 10.0; },
        [&](ComponentId c, double gap) {
          EXPECT_EQ(gap, spheres.gap(moving, from, to, 0.5, c, poses[c.value]));
          EXPECT_TRUE(gap > 10 || found.insert(c).second) << "visited twice";
        });
    EXPECT_EQ(found, expected) << "round " << round;
  }
}

}  // namespace
}  // namespace dismantle
