// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/shallow_region.h"

#include "dismantle/exec/executor.h"
#include "dismantle/surface/depth/solid_depth.h"
#include "tests/support/depth_oracle.h"
#include "tests/support/faulty_meshes.h"
#include "tests/support/random_scenes.h"
#include "tests/support/shaped_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace dismantle {
namespace {

using Solid = scenes::ShapedSolid;

/// A region of its own for each test, as regions keep what they were asked.
struct Region {
  Solid solid;
  ShallowRegion region;
  Region(const TriangleMesh& mesh, double limit)
      : solid(mesh), region(solid.shape.surface(), solid.shape.winding(), limit) {}
};

std::vector<TriangleMesh> meshes_with_and_without_faults() {
  const TriangleMesh tube = scenes::tube(5, 3, -4, 4, 17, 3);
  return {tube, scenes::inside_out(tube), scenes::without_face(tube, 7), scenes::with_t_junction(tube, 20),
          scenes::torn_apart(scenes::box({-4, -3, -2}, {4, 3, 2}))};
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine_); }
  Vec3 point(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
  Aabb box(double reach, double size) {
    Aabb box;
    const Vec3 corner = point(reach);
    box.extend(corner);
    box.extend(corner + point(size));
    return box;
  }
  /// A part that moves, by more than its size or less.
  MovingPart part(double reach, double size) {
    MovingPart part;
    const Vec3 place = point(reach), way = point(size);
    for (int i = 0; i < 3; ++i) {
      part.begin[i] = place + point(size / 2);
      part.end[i] = part.begin[i] + way + point(size / 10);
    }
    return part;
  }

 private:
  std::mt19937 engine_;
};

bool is_shallow(const TriangleMesh& mesh, Vec3 p, double limit) {
  return std::abs(oracle::winding_number(mesh, p)) <= 0.5 + kUndecidedWinding ||
         oracle::distance(mesh, p) <= limit + 1e-9;
}

TEST(ShallowRegion, HoldsNoPointThatIsDeeper) {
  Random random(1);
  int held = 0;
  for (const TriangleMesh& mesh : meshes_with_and_without_faults())
    for (const double limit : {0.05, 0.4, 0.9}) {
      const Region r(mesh, limit);
      for (int i = 0; i < 400; ++i) {
        const Aabb box = random.box(6, 1.5);
        if (r.region.contains(box)) {
          ++held;
          for (int k = 0; k < 20; ++k) {
            const Vec3 p{random.number(box.lower.x, box.upper.x), random.number(box.lower.y, box.upper.y),
                         random.number(box.lower.z, box.upper.z)};
            EXPECT_TRUE(is_shallow(mesh, p, limit)) << p.x << " " << p.y << " " << p.z << " limit " << limit;
          }
        }
        const MovingPart part = random.part(6, 1.5);
        if (r.region.contains(PartHull(part))) {
          ++held;
          for (int k = 0; k < 20; ++k) {
            const double t = random.number(0, 1), u = random.number(0, 1), v = random.number(0, 1 - u);
            Vec3 p;
            const double share[] = {1 - u - v, u, v};
            for (int c = 0; c < 3; ++c) p += share[c] * ((1 - t) * part.begin[c] + t * part.end[c]);
            EXPECT_TRUE(is_shallow(mesh, p, limit)) << p.x << " " << p.y << " " << p.z << " limit " << limit;
          }
        }
      }
    }
  EXPECT_GT(held, 3000);
}

TEST(ShallowRegion, HoldsWhatIsClearlyOutsideOrClearlyShallow) {
  Random random(2);
  int clear = 0;
  for (const TriangleMesh& mesh :
       {scenes::tube(5, 3, -4, 4, 17, 3), scenes::torn_apart(scenes::box({-4, -3, -2}, {4, 3, 2}))})
    for (const double limit : {0.3, 0.8}) {
      const Region r(mesh, limit);
      for (int i = 0; i < 2000; ++i) {
        const Aabb box = random.box(7, 0.2);
        const double distance = oracle::distance(mesh, box.center()), reach = diagonal(box) / 2;
        const bool inside = std::abs(oracle::winding_number(mesh, box.center())) > 0.5;
        // Cells at the surface of the region are cubes of a sixteenth of the limit, or an eighth of the box.
        const double cell = 2 * std::max(limit / 16, 7.0 / 256) + 0.05;
        if (inside ? distance + reach + cell > limit : distance < reach + cell) continue;
        ++clear;
        EXPECT_TRUE(r.region.contains(box)) << distance << " " << reach << " " << inside;
      }
    }
  EXPECT_GT(clear, 2000);
}

TEST(ShallowRegion, AnswersAlikeInAnyOrderAndOnSeveralThreads) {
  Random random(3);
  std::vector<MovingPart> parts;
  for (int i = 0; i < 3000; ++i) parts.push_back(random.part(6, i % 2 ? 2 : 0.3));
  const TriangleMesh mesh = scenes::tube(5, 3, -4, 4, 17, 3);
  const Region forward(mesh, 0.4), backward(mesh, 0.4), together(mesh, 0.4);
  std::vector<std::uint8_t> first(parts.size()), second(parts.size()), third(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) first[i] = forward.region.contains(PartHull(parts[i]));
  for (std::size_t i = parts.size(); i-- > 0;) second[i] = backward.region.contains(PartHull(parts[i]));
  Executor(ExecutorKind::Threads, 4).for_each(parts.size(), [&](std::size_t i) {
    third[i] = together.region.contains(PartHull(parts[i]));
  });
  EXPECT_EQ(first, second);
  EXPECT_EQ(first, third);
  EXPECT_NE(std::count(first.begin(), first.end(), 0), 0);
  EXPECT_NE(std::count(first.begin(), first.end(), 1), 0);
}

}  // namespace
}  // namespace dismantle
