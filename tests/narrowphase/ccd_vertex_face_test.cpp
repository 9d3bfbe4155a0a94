// SPDX-License-Identifier: Apache-2.0
#include "dismantle/narrowphase/ccd_vertex_face.h"

#include "tests/narrowphase/exact_motions.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

const Triangle kFace{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};

VertexFaceMotion falling(Vec3 from, Vec3 to) {
  return {from, to, kFace, kFace};
}

bool contact(const VertexFaceMotion& m) {
  return ccd_vertex_face(m).status == CcdStatus::Contact;
}

TEST(CcdVertexFace, StopsJustBeforeTheVertexReachesTheFace) {
  const CcdResult r = ccd_vertex_face(falling({0.25, 0.25, 1}, {0.25, 0.25, -3}));
  EXPECT_EQ(r.status, CcdStatus::Contact);
  EXPECT_LE(r.toi, 0.25);
  EXPECT_NEAR(r.toi, 0.25, 1e-9);
}

TEST(CcdVertexFace, IsFreeIfTheVertexPassesBesideTheFaceOrTurnsAway) {
  EXPECT_FALSE(contact(falling({0.75, 0.75, 1}, {0.75, 0.75, -1})));
  EXPECT_FALSE(contact(falling({0.25, 0.25, 1}, {0.25, 0.25, 2})));
  EXPECT_FALSE(contact(falling({0.25, 0.25, 1}, {0.25, 0.25, 1e-12})));
  EXPECT_FALSE(contact(falling({-1e-12, 0.25, 1}, {-1e-12, 0.25, -1})));
}

TEST(CcdVertexFace, CountsTouchingAtTheStartTheEndTheBorderAndACorner) {
  EXPECT_TRUE(contact(falling({0.25, 0.25, 0}, {0.25, 0.25, 1})));
  EXPECT_TRUE(contact(falling({0.25, 0.25, 1}, {0.25, 0.25, 0})));
  EXPECT_TRUE(contact(falling({0.5, 0.5, 1}, {0.5, 0.5, -1})));
  EXPECT_TRUE(contact(falling({0, 0, 1}, {0, 0, -1})));
}

TEST(CcdVertexFace, FindsAVertexThatSlidesInTheFacesPlaneIntoTheFace) {
  const CcdResult r = ccd_vertex_face(falling({-1, 0.25, 0}, {1, 0.25, 0}));
  EXPECT_EQ(r.status, CcdStatus::Contact);
  EXPECT_LE(r.toi, 0.5);
  EXPECT_NEAR(r.toi, 0.5, 1e-9);
  EXPECT_FALSE(contact(falling({-1, 0.25, 0}, {-1e-12, 0.25, 0})));
  EXPECT_FALSE(contact(falling({-1, 3, 0}, {3, 0, 0})));
}

TEST(CcdVertexFace, TakesAFaceWithoutAreaAsTheSegmentOrPointThatItIs) {
  const Triangle segment{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}, point{{{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}};
  for (const Triangle& t : {segment, point}) {
    EXPECT_TRUE(contact({{1, 0, 1}, {1, 0, -1}, t, t}));
    EXPECT_TRUE(contact({{0, 1, 0}, {2, -1, 0}, t, t}));
    EXPECT_FALSE(contact({{1, 0.1, 1}, {1, 0.1, -1}, t, t}));
    EXPECT_FALSE(contact({{3, 0, 1}, {3, 0, -1}, t, t}));
  }
}

TEST(CcdVertexFace, StartsWithTheAxisThatItIsGivenAndReturnsTheOneItEndedOn) {
  // Turned so that the sign of the volume decides nothing.
  const VertexFaceMotion m{{2, 2, 1}, {2, 2, -1}, kFace, kFace};
  const AxisCcdResult first = ccd_vertex_face(m, {});
  ASSERT_EQ(first.ccd.status, CcdStatus::Free);
  EXPECT_LT(first.axis.x + first.axis.y, 0) << "from the vertex to the face";
  const AxisCcdResult wrong = ccd_vertex_face(m, -first.axis);
  EXPECT_EQ(wrong.ccd.status, CcdStatus::Free) << "a wrong hint costs time, not truth";
}

TEST(CcdVertexFace, MissesNoContactThatIsExactByConstruction) {
  constexpr unsigned kSeed = 1001;
  exact::Generator generator(kSeed);
  int close = 0;
  for (int k = 0; k < 400000; ++k) {
    const exact::Hit<VertexFaceMotion> hit = generator.vertex_face();
    const CcdResult r = ccd_vertex_face(hit.motion);
    ASSERT_EQ(r.status, CcdStatus::Contact) << "seed " << kSeed << " motion " << k;
    ASSERT_LE(r.toi, hit.time) << "seed " << kSeed << " motion " << k;
    close += r.toi > hit.time - 1e-6;
  }
  std::printf("seed %u: %d of 400000 stopped within 1e-6 of the constructed time\n", kSeed, close);
  EXPECT_GT(close, 100000) << "the others have an earlier contact";
}

TEST(CcdVertexFace, MissesNoContactAtTheEndOfTheStepOnAxisAlignedPlanes) {
  constexpr unsigned kSeed = 1002;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> unit(0, 1);
  int checked = 0;
  for (const double scale : {1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4})
    for (const double offset : {0.0, 999.9, -1000.1, 1234.567})
      for (int k = 0; k < 600; ++k) {
        // A face in the plane coordinate[axis] = height; the vertex ends exactly in that plane, inside the face.
        const int axis = k % 3, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double height = offset + scale * unit(random);
        VertexFaceMotion m;
        const double corner[3][2] = {{-1, -1}, {2, -1}, {-1, 2}};
        for (int i = 0; i < 3; ++i) {
          m.face_t0[i][axis] = height;
          m.face_t0[i][u] = offset + scale * corner[i][0];
          m.face_t0[i][v] = offset + scale * corner[i][1];
        }
        m.face_t1 = m.face_t0;
        m.vertex_t1[axis] = height;
        m.vertex_t1[u] = offset + 0.4 * scale * unit(random);
        m.vertex_t1[v] = offset + 0.4 * scale * unit(random);
        m.vertex_t0 = m.vertex_t1;
        m.vertex_t0[axis] += (k % 2 == 0 ? 1 : -1) * scale * std::pow(10, -6 * unit(random));
        m.vertex_t0[u] += scale * (unit(random) - 0.5);
        const CcdResult r = ccd_vertex_face(m);
        ASSERT_EQ(r.status, CcdStatus::Contact) << "scale " << scale << " offset " << offset << " seed " << kSeed;
        ++checked;
      }
  EXPECT_EQ(checked, 8 * 4 * 600);
}

}  // namespace
}  // namespace dismantle
