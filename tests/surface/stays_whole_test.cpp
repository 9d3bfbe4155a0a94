// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/stays_whole.h"

#include "tests/support/faulty_meshes.h"
#include "tests/support/puzzle_scenes.h"
#include "tests/support/random_scenes.h"
#include "tests/support/shaped_solid.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace dismantle {
namespace {

bool stays_whole(const TriangleMesh& mesh, const TriangleMesh& cutter, double finest = 0.05) {
  return dismantle::stays_whole(mesh.vertices, mesh.faces, scenes::ShapedSolid(cutter).shape, finest);
}

TEST(StaysWhole, IsTrueForAPlateThatAPinGoesThroughAndNotForThePin) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20; ++i) {
    const Pose at = scenes::random_pose(random, 10, 3);
    const TriangleMesh plate = scenes::moved(scenes::box({-10, -8, 0}, {10, 8, 1}), at);
    const double lean = 0.02 * i;
    TriangleMesh pin = scenes::tube(2, 0, -4, 5, 3 + static_cast<std::uint32_t>(i));
    for (Vec3& p : pin.vertices) p.x += lean * p.z + 0.3 * i;
    pin = scenes::moved(pin, at);
    EXPECT_TRUE(stays_whole(plate, pin)) << i;
    EXPECT_FALSE(stays_whole(pin, plate)) << i;
    EXPECT_FALSE(stays_whole(scenes::inside_out(pin), scenes::inside_out(plate))) << i;
  }
}

TEST(StaysWhole, IsTrueForWhatLosesAnEndOrACorner) {
  const TriangleMesh block = scenes::box({-10, -8, -6}, {10, 8, 1});
  const TriangleMesh pin = scenes::tube(2, 0, -4, 5, 24);
  EXPECT_TRUE(stays_whole(pin, block));
  EXPECT_TRUE(stays_whole(block, pin));
  EXPECT_TRUE(stays_whole(block, scenes::box({8, 6, -8}, {12, 12, 3})));
  EXPECT_TRUE(stays_whole(pin, scenes::box({-10, -8, -20}, {10, 8, 20}))) << "all of it is gone";
  EXPECT_TRUE(stays_whole(pin, scenes::box({20, 20, 20}, {21, 21, 21}))) << "nothing is";
}

TEST(StaysWhole, TellsPartsOfASurfaceFromPiecesOfAPart) {
  // A ring is not in two where it is cut once, and is where it is cut twice.
  const TriangleMesh ring = scenes::tube(6, 5, 0, 1, 40);
  EXPECT_TRUE(stays_whole(ring, scenes::box({4, -0.5, -1}, {7, 0.5, 2})));
  EXPECT_FALSE(stays_whole(ring, scenes::box({-7, -0.5, -1}, {7, 0.5, 2})));
  // A hollow box has two parts of its own from the beginning.
  const TriangleMesh hollow =
      scenes::joined(scenes::box({-5, -5, -5}, {5, 5, 5}), scenes::inside_out(scenes::box({-4, -4, -4}, {4, 4, 4})));
  EXPECT_TRUE(stays_whole(hollow, scenes::tube(1, 0, 0, 9, 12)));
  EXPECT_FALSE(stays_whole(hollow, scenes::box({-0.5, -9, -9}, {0.5, 9, 9})));
}

TEST(StaysWhole, OverlooksOnlyWhatIsThinnerThanTheFinestEdge) {
  const TriangleMesh rod = scenes::box({-0.5, -0.5, -10}, {0.5, 0.5, 10});
  for (const double thickness : {0.1, 0.4}) {
    const TriangleMesh slab = scenes::box({-3, -3, 0.123}, {3, 3, 0.123 + thickness});
    EXPECT_FALSE(stays_whole(rod, slab, thickness / 2)) << thickness;
    EXPECT_TRUE(stays_whole(rod, slab, 100)) << thickness;
  }
}

}  // namespace
}  // namespace dismantle
