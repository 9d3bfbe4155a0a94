// SPDX-License-Identifier: Apache-2.0
#include "dismantle/narrowphase/elementary_vertex_face.h"
#include "dismantle/narrowphase/nonpenetration_filter.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

const Triangle kFace{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};

VertexFaceMotion falling(Vec3 from, Vec3 to) {
  return {from, to, kFace, kFace};
}

TEST(ElementaryVertexFace, FindsTheTimeAtWhichTheVertexFallsOnTheFace) {
  const CcdResult r = elementary_vertex_face(falling({0.25, 0.25, 1}, {0.25, 0.25, -3}));
  EXPECT_EQ(r.status, CcdStatus::Contact);
  EXPECT_NEAR(r.toi, 0.25, 1e-15);
}

TEST(ElementaryVertexFace, MissesIfTheVertexPassesBesideTheFace) {
  EXPECT_EQ(elementary_vertex_face(falling({0.75, 0.75, 1}, {0.75, 0.75, -1})).status, CcdStatus::Free);
}

TEST(ElementaryVertexFace, CountsTouchingACornerAndAnEdge) {
  EXPECT_EQ(elementary_vertex_face(falling({0, 0, 1}, {0, 0, -1})).status, CcdStatus::Contact);
  EXPECT_EQ(elementary_vertex_face(falling({0.5, 0.5, 1}, {0.5, 0.5, -1})).status, CcdStatus::Contact);
}

TEST(ElementaryVertexFace, CountsTouchingAtTheVeryEndAndAtTheStart) {
  EXPECT_EQ(elementary_vertex_face(falling({0.25, 0.25, 1}, {0.25, 0.25, 0})).toi, 1);
  EXPECT_EQ(elementary_vertex_face(falling({0.25, 0.25, 0}, {0.25, 0.25, 1})).toi, 0);
}

TEST(ElementaryVertexFace, FindsAVertexThatSlidesInTheFacesPlaneIntoTheFace) {
  const CcdResult r = elementary_vertex_face(falling({-1, 0.25, 0}, {1, 0.25, 0}));
  EXPECT_EQ(r.status, CcdStatus::Contact);
  EXPECT_NEAR(r.toi, 0.5, 1e-15);
  EXPECT_EQ(elementary_vertex_face(falling({-1, 0.25, 0}, {-0.25, 0.25, 0})).status, CcdStatus::Free);
}

TEST(ElementaryVertexFace, TakesTheFirstRootAtWhichTheVertexIsInside) {
  // Through the plane outside the face at 1/4, back through it inside at 3/4: the face rises and sinks linearly.
  const VertexFaceMotion m{{-1.25, 0.25, 0.5},
                           {0.75, 0.25, -0.5},
                           {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                           {{{0, 0, -0.25}, {1, 0, -0.25}, {0, 1, -0.25}}}};
  const CcdResult r = elementary_vertex_face(m);
  ASSERT_EQ(r.status, CcdStatus::Contact);
  EXPECT_NEAR(r.toi, 2.0 / 3, 1e-14);
}

TEST(NonpenetrationFilter, DropsAVertexThatStaysOnOneSideAndKeepsOneThatTouches) {
  EXPECT_TRUE(nonpenetration_filter(falling({0.25, 0.25, 1}, {0.25, 0.25, 0.001})));
  EXPECT_FALSE(nonpenetration_filter(falling({0.25, 0.25, 1}, {0.25, 0.25, 0})));
  EXPECT_FALSE(nonpenetration_filter(falling({0.25, 0.25, 1e-18}, {0.25, 0.25, 1e-18})));
}

}  // namespace
}  // namespace dismantle
