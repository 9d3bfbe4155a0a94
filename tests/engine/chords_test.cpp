// SPDX-License-Identifier: Apache-2.0
#include "dismantle/engine/chords.h"

#include "dismantle/math/screw.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dismantle {
namespace {

constexpr std::uint64_t kSeed = 85;

TEST(ChordCount, MakesChordsAsNearToTheArcsAsWantedAndNoMoreThanThat) {
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> uniform;
  double closest = 0;
  for (int i = 0; i < 400; ++i) {
    const Pose start = scenes::random_pose(random, 10, 3), end = scenes::random_pose(random, 10, 3);
    const Vec3 center = scenes::random_vector(random, 20);
    const double radius = 5 * uniform(random);
    const ScrewMotion whole = screw_motion(start, end, center, radius);
    const double wanted = whole.deviation * std::pow(10, 1 - 4 * uniform(random));
    const int count = chord_count(whole.deviation, wanted);
    ASSERT_GE(count, 1);
    EXPECT_LE((count - 1.0) * (count - 1.0) * wanted, whole.deviation * (1 + 1e-9));
    const RigidTransform back = inverse(transform_from_pose(start));
    for (int k = 0; k < 60; ++k) {
      const Vec3 at_start = center + radius * normalized(scenes::random_vector(random, 1));
      const auto place = [&](double s) { return transform_from_pose(whole.at(s)) * (back * at_start); };
      const double part = std::floor(uniform(random) * count), share = k % 2 == 0 ? 0.5 : uniform(random);
      const Vec3 chord = (1 - share) * place(part / count) + share * place((part + 1) / count);
      const double off = length(place((part + share) / count) - chord);
      EXPECT_LE(off, wanted * (1 + 1e-9) + 1e-12) << "seed " << kSeed << ", motion " << i;
      closest = std::max(closest, off / wanted);
    }
  }
  EXPECT_GT(closest, 0.8);
}

}  // namespace
}  // namespace dismantle
