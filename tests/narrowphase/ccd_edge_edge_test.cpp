// SPDX-License-Identifier: Apache-2.0
#include "dismantle/narrowphase/ccd_edge_edge.h"

#include "tests/narrowphase/exact_motions.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

/// An edge along x that moves towards one along y through the origin.
EdgeEdgeMotion moving(Vec3 from, Vec3 to) {
  return {{from + Vec3{-1, 0, 0}, from + Vec3{1, 0, 0}},
          {to + Vec3{-1, 0, 0}, to + Vec3{1, 0, 0}},
          {{0, -1, 0}, {0, 1, 0}},
          {{0, -1, 0}, {0, 1, 0}}};
}

bool contact(const EdgeEdgeMotion& m) {
  return ccd_edge_edge(m).status == CcdStatus::Contact;
}

TEST(CcdEdgeEdge, StopsJustBeforeTheEdgesMeet) {
  const CcdResult r = ccd_edge_edge(moving({0, 0, 1}, {0, 0, -3}));
  EXPECT_EQ(r.status, CcdStatus::Contact);
  EXPECT_LE(r.toi, 0.25);
  EXPECT_NEAR(r.toi, 0.25, 1e-9);
}

TEST(CcdEdgeEdge, IsFreeIfTheEdgesPassBesideEachOtherOrStayApart) {
  EXPECT_FALSE(contact(moving({1.5, 0, 1}, {1.5, 0, -1})));
  EXPECT_FALSE(contact(moving({1 + 1e-12, 0, 1}, {1 + 1e-12, 0, -1})));
  EXPECT_FALSE(contact(moving({0, 0, 1}, {0, 0, 1e-12})));
}

TEST(CcdEdgeEdge, CountsTouchingAtTheStartTheEndAndEndPoints) {
  EXPECT_TRUE(contact(moving({0, 0, 0}, {0, 0, 1})));
  EXPECT_TRUE(contact(moving({0, 0, 1}, {0, 0, 0})));
  EXPECT_TRUE(contact(moving({1, 1, 1}, {1, 1, -1})));
}

TEST(CcdEdgeEdge, DecidesParallelCollinearAndPointLikeEdges) {
  const Vec3 x{1, 0, 0}, z{0, 0, 1}, zero{};
  const auto pair = [](Vec3 a0, Vec3 a1, Vec3 displacement, Vec3 b0, Vec3 b1) {
    return EdgeEdgeMotion{{a0, a1}, {a0 + displacement, a1 + displacement}, {b0, b1}, {b0, b1}};
  };
  EXPECT_TRUE(contact(pair(z, z + x, -2.0 * z, 0.5 * x, 3.0 * x)));
  EXPECT_FALSE(contact(pair(z, z + x, -0.9 * z, 0.5 * x, 3.0 * x)));
  EXPECT_FALSE(contact(pair(z, z + x, -2.0 * z, 1.1 * x, 3.0 * x)));
  EXPECT_TRUE(contact(pair(-3.0 * x, -2.0 * x, 3.0 * x, zero, 3.0 * x)));
  EXPECT_FALSE(contact(pair(-3.0 * x, -2.0 * x, 1.9 * x, zero, 3.0 * x)));
  EXPECT_TRUE(contact(pair(z, z, -2.0 * z, -1.0 * x, x)));
  EXPECT_TRUE(contact(pair(z, z, -2.0 * z, zero, zero)));
  EXPECT_FALSE(contact(pair(z, z, -0.9 * z, zero, zero)));
}

TEST(CcdEdgeEdge, ReturnsTheAxisThatItEndedOn) {
  const AxisCcdResult r = ccd_edge_edge(moving({3, 0, 1}, {3, 0, -1}), {});
  ASSERT_EQ(r.ccd.status, CcdStatus::Free);
  EXPECT_LT(r.axis.x, 0) << "from a to b";
}

TEST(CcdEdgeEdge, MissesNoContactThatIsExactByConstruction) {
  constexpr unsigned kSeed = 2001;
  exact::Generator generator(kSeed);
  int close = 0;
  for (int k = 0; k < 400000; ++k) {
    const exact::Hit<EdgeEdgeMotion> hit = generator.edge_edge();
    const CcdResult r = ccd_edge_edge(hit.motion);
    ASSERT_EQ(r.status, CcdStatus::Contact) << "seed " << kSeed << " motion " << k;
    ASSERT_LE(r.toi, hit.time) << "seed " << kSeed << " motion " << k;
    close += r.toi > hit.time - 1e-6;
  }
  std::printf("seed %u: %d of 400000 stopped within 1e-6 of the constructed time\n", kSeed, close);
  EXPECT_GT(close, 100000) << "the others have an earlier contact";
}

TEST(CcdEdgeEdge, MissesNoContactAtTheEndOfTheStepOnAxisAlignedPlanes) {
  constexpr unsigned kSeed = 2002;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double scale : {1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4})
    for (const double offset : {0.0, 999.9, -1000.1, 1234.567})
      for (int k = 0; k < 600; ++k) {
        // Two edges that cross inside, both in the plane coordinate[axis] = height at the end of the step.
        const int axis = k % 3, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double height = offset + scale * unit(random);
        EdgeEdgeMotion m;
        for (int i = 0; i < 2; ++i) {
          m.a_t1[i][axis] = m.b_t1[i][axis] = height;
          m.a_t1[i][u] = offset + (i == 0 ? -1 : 1) * scale * (0.5 + unit(random));
          m.a_t1[i][v] = offset + 0.4 * scale * (unit(random) - 0.5);
          m.b_t1[i][u] = offset + 0.4 * scale * (unit(random) - 0.5);
          m.b_t1[i][v] = offset + (i == 0 ? -1 : 1) * scale * (0.5 + unit(random));
          m.a_t0[i] = m.a_t1[i];
          m.b_t0[i] = m.b_t1[i];
          m.a_t0[i][axis] += (k % 2 == 0 ? 1 : -1) * scale * std::pow(10, -6 * unit(random));
        }
        ASSERT_TRUE(contact(m)) << "scale " << scale << " offset " << offset << " seed " << kSeed;
      }
}

}  // namespace
}  // namespace dismantle
