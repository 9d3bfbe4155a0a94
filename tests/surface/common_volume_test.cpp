// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/common_volume.h"

#include "tests/support/faulty_meshes.h"
#include "tests/support/random_scenes.h"
#include "tests/support/shaped_solid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dismantle {
namespace {

using Solid = scenes::ShapedSolid;

CommonVolume volume_of(const TriangleMesh& a, const TriangleMesh& b, const RigidTransform& b_at = {}) {
  const Solid first(a), second(b);
  return common_volume({&first.shape, {}}, {&second.shape, b_at});
}

void expect_volume(const CommonVolume& found, double truth) {
  EXPECT_NEAR(found.volume, truth, 4 * found.standard_error + 1e-9 * truth);
  EXPECT_LE(found.standard_error, 0.04 * truth);
}

TEST(CommonVolume, OfBoxesIsThatOfTheirCommonBox) {
  const TriangleMesh box = scenes::box({0, 0, 0}, {10, 10, 10});
  expect_volume(volume_of(box, scenes::box({8, 7, 6}, {20, 20, 20})), 2 * 3 * 4);
  expect_volume(volume_of(box, box), 1000);
  EXPECT_EQ(volume_of(box, scenes::box({10, 0, 0}, {20, 10, 10})).volume, 0);
  EXPECT_EQ(volume_of(box, scenes::box({11, 0, 0}, {20, 10, 10})).volume, 0);
}

TEST(CommonVolume, OfAPegInASmallerHoleIsThatOfTheRing) {
  const double sector = std::sin(std::acos(-1.0) / 24) * std::cos(std::acos(-1.0) / 24);  // of a triangle of side 1
  for (const double peg : {4.0, 3.32})
    expect_volume(volume_of(scenes::tube(12, 3.3, 0, 20, 24), scenes::tube(peg, 0, -2, 35, 24)),
                  24 * sector * (peg * peg - 3.3 * 3.3) * 20);
}

TEST(CommonVolume, DoesNotDependOnFaultsAndFrames) {
  std::mt19937_64 random(3);
  const TriangleMesh box = scenes::box({-3, -3, -3}, {3, 3, 3}), rod = scenes::tube(1, 0, -9, 9, 4);
  for (int round = 0; round < 6; ++round) {
    const Pose turn = scenes::random_pose(random, 0, 3);
    const RigidTransform t = transform_from_pose(turn);
    const double truth = volume_of(box, scenes::moved(rod, turn)).volume;
    for (const TriangleMesh& mesh : {box, scenes::inside_out(box), scenes::with_t_junction(box, 4),
                                     scenes::without_face(box, 5), scenes::joined(box, box)})
      EXPECT_NEAR(volume_of(mesh, rod, t).volume, truth, 0.08 * truth);
  }
}

}  // namespace
}  // namespace dismantle
