// SPDX-License-Identifier: Apache-2.0
#include "dismantle/export/cell_grid.h"

#include "dismantle/geometry/adjacency.h"

#include <gtest/gtest.h>

#include <random>

namespace dismantle {
namespace {

const Aabb kTen{{0, 0, 0}, {10, 10, 10}};

TEST(CellGrid, MarksEveryCellThatATriangleTouchesAndNoneThatIsFarFromIt) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0, 10), share(0, 1);
  for (int round = 0; round < 20; ++round) {
    CellGrid grid = *CellGrid::around(kTen, 0.7, 1'000'000);
    Triangle t;
    for (Vec3& corner : t.corner) corner = {place(random), place(random), place(random)};
    grid.mark(t, 0.1);
    const Vec3 normal = normalized(normal_unscaled(t));
    for (int k = 0; k < 300; ++k) {
      const double a = share(random), b = (1 - a) * share(random);
      const Vec3 on = t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]);
      EXPECT_TRUE(grid.is_marked(on)) << round;
      EXPECT_TRUE(grid.is_marked(on + 0.0999 * normal)) << round << ", in the margin";
      // Farther than the diagonal of an enlarged cell.
      const Vec3 off = on + (std::sqrt(3) * 0.8 + 1e-9) * (share(random) < 0.5 ? normal : -normal);
      const bool is_in = overlaps({off, off}, kTen);
      EXPECT_FALSE(is_in && grid.is_marked(off)) << round;
    }
  }
}

TEST(CellGrid, HasAValidSurfaceAroundAnyMarkedCells) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> place(0, 10);
  for (int round = 0; round < 10; ++round) {
    CellGrid grid = *CellGrid::around(kTen, 0.9, 1'000'000);
    std::vector<Vec3> points;
    for (int k = 0; k < 40; ++k) {
      points.push_back({place(random), place(random), place(random)});
      grid.mark({points.back(), points.back(), points.back()}, 0);
    }
    const TriangleMesh mesh = grid.surface();
    const EdgeFaults faults = edge_faults(mesh);
    EXPECT_EQ(faults.boundary + faults.nonmanifold + faults.misoriented, 0u) << round;
    EXPECT_GT(signed_volume(mesh), 0) << round;
    for (const Vec3& p : mesh.vertices) {
      double minimum = 1e300;
      for (const Vec3& q : points) minimum = std::min(minimum, length(p - q));
      EXPECT_LE(minimum, 1.5 * std::sqrt(3) * 0.9 + 1e-9) << round;
    }
  }
}

TEST(CellGrid, FillsRegionsThatDoNotReachTheBorder) {
  // The walls of a cube.
  CellGrid grid = *CellGrid::around(kTen, 0.5, 1'000'000);
  const auto wall = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    grid.mark({{a, b, c}}, 0);
    grid.mark({{a, c, d}}, 0);
  };
  for (const double s : {2.0, 8.0}) {
    wall({s, 2, 2}, {s, 8, 2}, {s, 8, 8}, {s, 2, 8});
    wall({2, s, 2}, {8, s, 2}, {8, s, 8}, {2, s, 8});
    wall({2, 2, s}, {8, 2, s}, {8, 8, s}, {2, 8, s});
  }
  CellGrid kept = grid;
  kept.mark_regions([](const Vec3&) { return false; });
  EXPECT_FALSE(kept.is_marked({5, 5, 5}));
  grid.mark_regions([](const Vec3&) { return true; });
  EXPECT_TRUE(grid.is_marked({5, 5, 5}));
  EXPECT_FALSE(grid.is_marked({1, 1, 1})) << "outside";
}

TEST(CellGrid, IsNotMadeIfItWouldBeTooLarge) {
  EXPECT_TRUE(CellGrid::around(kTen, 1, 4000).has_value());
  EXPECT_FALSE(CellGrid::around(kTen, 1, 3000).has_value());
  EXPECT_FALSE(CellGrid::around(kTen, 1e-30, 1'000'000'000).has_value());
}

}  // namespace
}  // namespace dismantle
