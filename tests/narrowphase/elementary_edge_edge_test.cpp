// SPDX-License-Identifier: Apache-2.0
#include "dismantle/narrowphase/elementary_edge_edge.h"
#include "dismantle/narrowphase/nonpenetration_filter.h"

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

TEST(ElementaryEdgeEdge, FindsTheTimeAtWhichCrossingEdgesMeet) {
  const CcdResult r = elementary_edge_edge(moving({0, 0, 1}, {0, 0, -3}));
  EXPECT_EQ(r.status, CcdStatus::Contact);
  EXPECT_NEAR(r.toi, 0.25, 1e-15);
}

TEST(ElementaryEdgeEdge, MissesIfTheEdgesPassBesideEachOther) {
  EXPECT_EQ(elementary_edge_edge(moving({1.5, 0, 1}, {1.5, 0, -1})).status, CcdStatus::Free);
}

TEST(ElementaryEdgeEdge, CountsTouchingEndPoints) {
  EXPECT_EQ(elementary_edge_edge(moving({1, 1, 1}, {1, 1, -1})).status, CcdStatus::Contact);
  EXPECT_EQ(elementary_edge_edge(moving({0, 0, 1}, {0, 0, 0})).toi, 1);
}

TEST(ElementaryEdgeEdge, FindsParallelEdgesThatMoveOntoEachOther) {
  const EdgeEdgeMotion m{
      {{0, 0, 1}, {1, 0, 1}}, {{0, 0, -1}, {1, 0, -1}}, {{0.5, 0, 0}, {3, 0, 0}}, {{0.5, 0, 0}, {3, 0, 0}}};
  const CcdResult r = elementary_edge_edge(m);
  ASSERT_EQ(r.status, CcdStatus::Contact);
  EXPECT_NEAR(r.toi, 0.5, 1e-15);
}

TEST(ElementaryEdgeEdge, FindsEdgesThatSlideIntoEachOtherWithinOnePlaneAndOnOneLine) {
  const EdgeEdgeMotion plane{
      {{-3, 0, 0}, {-2, 0, 0}}, {{0, 0, 0}, {1, 0, 0}}, {{0, -1, 0}, {0, 1, 0}}, {{0, -1, 0}, {0, 1, 0}}};
  EXPECT_NEAR(elementary_edge_edge(plane).toi, 2.0 / 3, 1e-15);
  const EdgeEdgeMotion line{
      {{-3, 0, 0}, {-2, 0, 0}}, {{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {3, 0, 0}}, {{0, 0, 0}, {3, 0, 0}}};
  EXPECT_NEAR(elementary_edge_edge(line).toi, 2.0 / 3, 1e-15);
}

TEST(NonpenetrationFilter, DropsEdgesThatStayOnOneSideOfEachOtherAndKeepsOnesThatTouch) {
  EXPECT_TRUE(nonpenetration_filter(moving({0, 0, 1}, {0, 0, 0.001})));
  EXPECT_FALSE(nonpenetration_filter(moving({0, 0, 1}, {0, 0, 0})));
}

}  // namespace
}  // namespace dismantle
