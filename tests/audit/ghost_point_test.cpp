// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/ghost_point.h"

#include "dismantle/audit/solid/piece_tests.h"
#include "tests/audit/depth_scenes.h"

#include <gtest/gtest.h>

#include <random>

namespace dismantle::audit {
namespace {

constexpr std::uint64_t kSeed = 83;
constexpr double kStandoff = 1e-3;

class GhostPoints : public testing::Test {
 protected:
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vec3 vector(double size) { return size * Vec3{normal_(random_), normal_(random_), normal_(random_)}; }

  /// Triangles anywhere, large and small.
  TriangleMesh soup(int count) {
    TriangleMesh mesh;
    for (int i = 0; i < count; ++i) {
      const Vec3 middle = vector(1);
      const double size = std::pow(10, number(-1.5, 0));
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (int k = 0; k < 3; ++k) mesh.vertices.push_back(middle + vector(size));
      mesh.faces.push_back({{first, first + 1, first + 2}});
    }
    return mesh;
  }

  std::mt19937_64 random_{kSeed};
  std::normal_distribution<double> normal_;
};

double volume(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  return dot(cross(b - a, c - a), d - a);
}

/// True if a segment meets a triangle, by the signs of five volumes.
bool segment_meets(const Triangle& t, Vec3 from, Vec3 to) {
  if ((volume(t[0], t[1], t[2], from) > 0) == (volume(t[0], t[1], t[2], to) > 0)) return false;
  const bool first = volume(from, to, t[0], t[1]) > 0;
  return (volume(from, to, t[1], t[2]) > 0) == first && (volume(from, to, t[2], t[0]) > 0) == first;
}

bool segment_meets(const AuditBody& surface, Vec3 from, Vec3 to) {
  for (std::uint32_t f = 0; f < surface.face_count(); ++f)
    if (segment_meets(surface.triangle(f), from, to)) return true;
  return false;
}

TEST_F(GhostPoints, ShiftOnlyWhereNoFaceIsOnTheWay) {
  int shifted = 0, met = 0;
  for (int i = 0; i < 200; ++i) {
    const AuditBody surface(scenes::component("soup", soup(20)));
    for (int k = 0; k < 60; ++k) {
      Vec3 from = vector(1), way = std::pow(10, number(-3, 0.5)) * normalized(vector(1));
      if (k % 2 == 0) {
        // Through a point near an edge of a face, at a small angle to it.
        const Triangle t = surface.triangle(static_cast<std::uint32_t>(random_() % surface.face_count()));
        const double along = number(0, 1), off = std::pow(10, number(-4, -0.5));
        const Vec3 at = (1 - off) * ((1 - along) * t[0] + along * t[1]) + off * t[2];
        const Vec3 edge = normalized(t[1] - t[0]), normal = normalized(cross(edge, t[2] - t[0]));
        const Vec3 across = cross(normal, edge);
        way = std::pow(10, number(-2, 0)) *
              normalized(number(-1, 1) * edge + number(-1, 1) * across + std::pow(10, number(-2, 0)) * normal);
        from = at - number(0.1, 0.9) * way;
      }
      if (surface.closest(from).distance < kStandoff) continue;
      GhostPoint ghost(surface, kStandoff, from);
      const bool meets = segment_meets(surface, from, from + way);
      met += meets ? 1 : 0;
      if (ghost.shift(way)) {
        ++shifted;
        EXPECT_FALSE(meets) << "seed " << kSeed << ", surface " << i << ", way " << k;
        EXPECT_LT(length(ghost.position() - from - way), 1e-15);
      } else {
        EXPECT_EQ(length(ghost.position() - from), 0);
      }
    }
  }
  EXPECT_GT(shifted, 1000);
  EXPECT_GT(met, 1000);
}

/// True if a point is inside a convex surface.
bool inside_convex(const AuditBody& surface, Vec3 point) {
  for (std::uint32_t f = 0; f < surface.face_count(); ++f) {
    const Triangle t = surface.triangle(f);
    if (dot(cross(t[1] - t[0], t[2] - t[0]), point - t[0]) > 0) return false;
  }
  return true;
}

TEST_F(GhostPoints, StayOnTheirSideOfAClosedSurface) {
  for (const TriangleMesh& mesh : {scenes::box({-1, -0.5, -0.2}, {1, 0.5, 0.2}), depth_scenes::ball(12, 6, 1, {}),
                                   depth_scenes::pyramid(20, 3, 0)}) {
    const AuditBody surface(scenes::component("convex", scenes::moved(mesh, {{}, quat_about({0.6, 0, 0.8}, 1)})));
    for (const bool inside : {true, false})
      for (int i = 0; i < 20; ++i) {
        Vec3 start;
        do {
          start = vector(inside ? 0.2 : 2);
        } while (inside_convex(surface, start) != inside || surface.closest(start).distance < kStandoff);
        GhostPoint ghost(surface, kStandoff, start);
        for (int k = 0; k < 40; ++k) {
          ghost.approach(k % 3 == 0 ? ghost.position() + vector(0.01) : vector(inside ? 2 : 1.5));
          ASSERT_EQ(inside_convex(surface, ghost.position()), inside) << "seed " << kSeed << ", target " << k;
        }
      }
  }
}

}  // namespace
}  // namespace dismantle::audit
