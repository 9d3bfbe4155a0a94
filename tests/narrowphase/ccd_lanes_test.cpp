// SPDX-License-Identifier: Apache-2.0
#include "dismantle/narrowphase/ccd_lanes.h"

#include "dismantle/narrowphase/ccd_edge_edge.h"
#include "dismantle/narrowphase/ccd_vertex_face.h"
#include "tests/narrowphase/exact_motions.h"
#include "tests/support/exact_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace dismantle {
namespace {

CcdBatchResult in_lanes(const std::vector<VertexFaceMotion>& motions, LaneCount lanes = widest_lanes()) {
  return ccd_vertex_face_lanes(motions, lanes);
}
CcdBatchResult in_lanes(const std::vector<EdgeEdgeMotion>& motions, LaneCount lanes = widest_lanes()) {
  return ccd_edge_edge_lanes(motions, lanes);
}
CcdResult in_double(const VertexFaceMotion& m) {
  return ccd_vertex_face(m);
}
CcdResult in_double(const EdgeEdgeMotion& m) {
  return ccd_edge_edge(m);
}

std::vector<Vec3*> points_of(VertexFaceMotion& m) {
  return {&m.vertex_t0,  &m.vertex_t1,  &m.face_t0[0], &m.face_t0[1],
          &m.face_t0[2], &m.face_t1[0], &m.face_t1[1], &m.face_t1[2]};
}
std::vector<Vec3*> points_of(EdgeEdgeMotion& m) {
  return {&m.a_t0[0], &m.a_t0[1], &m.a_t1[0], &m.a_t1[1], &m.b_t0[0], &m.b_t0[1], &m.b_t1[0], &m.b_t1[1]};
}

bool same(const CcdBatchResult& x, const CcdBatchResult& y) {
  return x.decided_in_double == y.decided_in_double &&
         std::equal(x.contacts.begin(), x.contacts.end(), y.contacts.begin(), y.contacts.end(),
                    [](const CcdBatchContact& a, const CcdBatchContact& b) {
                      return a.query == b.query && a.ccd.status == b.ccd.status && a.ccd.toi == b.ccd.toi &&
                             a.ccd.iterations == b.ccd.iterations;
                    });
}

/// Contacts that are exact by construction, sheared by a matrix of small fractions: this keeps convex combinations and
/// hence the contact exact, but makes coordinate differences that no float represents.
class ShearedHits {
 public:
  explicit ShearedHits(unsigned seed) : generator_(seed), random_(seed) {}

  void next(VertexFaceMotion& m) { shear(m = generator_.vertex_face().motion); }
  void next(EdgeEdgeMotion& m) { shear(m = generator_.edge_edge().motion); }

  template <class Motion>
  std::vector<Motion> some(int count) {
    std::vector<Motion> motions(count);
    for (Motion& m : motions) next(m);
    return motions;
  }

 private:
  template <class Motion>
  void shear(Motion& m) {
    Vec3 row[3];
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        row[i][k] = (i == k ? 1.0 : 0.0) + (static_cast<int>(random_() % 8191) - 4095) * 0x1p-12;
    for (Vec3* p : points_of(m)) *p = {dot(row[0], *p), dot(row[1], *p), dot(row[2], *p)};
  }

  exact::Generator generator_;
  std::mt19937_64 random_;
};

/// Motions across, up to or short of a plane, the truth by the exact signs of the volume at both ends: only one feature
/// moves and without turning, so that the volume is linear in time, and it stays well inside of the other's borders.
class NearlyMeeting {
 public:
  explicit NearlyMeeting(unsigned seed) : random_(seed) {}

  void next(VertexFaceMotion& m, bool& meets) {
    start_scene();
    const Triangle face{{vector(), vector(), vector()}};
    const Vec3 normal = normalized(normal_unscaled(face));
    const auto inside = [&] {
      const double w0 = 0.1 + 0.3 * unit(), w1 = 0.1 + 0.3 * unit();
      return w0 * face[0] + w1 * face[1] + (1 - w0 - w1) * face[2];
    };
    m = {inside() + (scale_ * unit()) * normal, inside() + distance() * normal, face, face};
    place(m);
    meets = sign_changes(m.face_t0[0], m.face_t0[1], m.face_t0[2], m.vertex_t0, m.vertex_t1);
  }

  void next(EdgeEdgeMotion& m, bool& meets) {
    start_scene();
    const Vec3 a[2] = {vector(), vector()}, along_b = vector(), along_a = a[1] - a[0];
    const Vec3 normal = normalized(cross(along_a, along_b));
    const auto start_of_b = [&](double height) {
      return a[0] + (0.2 + 0.6 * unit()) * along_a + height * normal - (0.2 + 0.6 * unit()) * along_b;
    };
    m = {{a[0], a[1]}, {a[0], a[1]}, {start_of_b(scale_ * unit()), {}}, {start_of_b(distance()), {}}};
    place(m);
    // The end points of b are apart by a vector on a coarse grid, so that they are moved alike, exactly.
    const Vec3 grid = on_grid(along_b);
    for (Vec3(*b)[2] : {&m.b_t0, &m.b_t1}) {
      (*b)[0] = on_grid((*b)[0]);
      (*b)[1] = (*b)[0] + grid;
    }
    meets = sign_changes(m.a_t0[0], m.a_t0[1], m.b_t0[0], m.b_t0[1], m.b_t1[0], m.b_t1[1]);
  }

 private:
  void start_scene() {
    scale_ = std::pow(10, -3 + 8 * unit());
    offset_ = random_() % 2 == 0 ? Vec3{} : std::pow(10, 4 * unit()) * scale_ * Vec3{unit(), unit(), unit()};
  }
  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  Vec3 vector() { return scale_ * Vec3{2 * unit() - 1, 2 * unit() - 1, 2 * unit() - 1}; }
  double distance() { return (random_() % 2 == 0 ? 1 : -1) * scale_ * std::pow(10, -17 * unit()); }
  template <class Motion>
  void place(Motion& m) {
    for (Vec3* p : points_of(m)) *p += offset_;
  }
  Vec3 on_grid(Vec3 p) const {
    const double step = std::ldexp(1.0, std::ilogb(scale_) - 36);
    return {step * std::round(p.x / step), step * std::round(p.y / step), step * std::round(p.z / step)};
  }
  static bool sign_changes(Vec3 a, Vec3 b, Vec3 c, Vec3 d_t0, Vec3 d_t1) {
    return exact::orient3d_sign(a, b, c, d_t0) * exact::orient3d_sign(a, b, c, d_t1) <= 0;
  }
  static bool sign_changes(Vec3 a0, Vec3 a1, Vec3 b0_t0, Vec3 b1_t0, Vec3 b0_t1, Vec3 b1_t1) {
    return exact::orient3d_sign(a0, a1, b0_t0, b1_t0) * exact::orient3d_sign(a0, a1, b0_t1, b1_t1) <= 0;
  }

  std::mt19937_64 random_;
  double scale_ = 1;
  Vec3 offset_;
};

template <class Motion>
std::vector<Motion> random_motions(unsigned seed, int count) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<Motion> motions(count);
  for (Motion& m : motions)
    for (Vec3* p : points_of(m)) *p = {coordinate(random), coordinate(random), 4 * coordinate(random)};
  return motions;
}

template <class Motion>
class CcdLanes : public testing::Test {};
using Motions = testing::Types<VertexFaceMotion, EdgeEdgeMotion>;

class MotionNames {
 public:
  template <class Motion>
  static std::string GetName(int) {
    return std::is_same_v<Motion, VertexFaceMotion> ? "VertexFace" : "EdgeEdge";
  }
};
TYPED_TEST_SUITE(CcdLanes, Motions, MotionNames);

TYPED_TEST(CcdLanes, MissNoContactThatIsExactByConstruction) {
  constexpr unsigned kSeed = 5001;
  constexpr int kCount = 200000;
  const auto motions = ShearedHits(kSeed).some<TypeParam>(kCount);
  const CcdBatchResult result = in_lanes(motions);
  ASSERT_EQ(result.contacts.size(), motions.size()) << "seed " << kSeed;
  EXPECT_EQ(result.decided_in_double, motions.size());
}

TYPED_TEST(CcdLanes, CallNothingFreeThatExactArithmeticSeesMeeting) {
  constexpr unsigned kSeed = 5002;
  constexpr int kCount = 30000;
  NearlyMeeting source(kSeed);
  std::vector<TypeParam> motions(kCount);
  std::vector<bool> missed(kCount);
  for (int i = 0; i < kCount; ++i) {
    bool meets = false;
    source.next(motions[i], meets);
    missed[i] = meets;
  }
  const auto meeting = static_cast<std::size_t>(std::count(missed.begin(), missed.end(), true));
  const CcdBatchResult result = in_lanes(motions);
  for (const CcdBatchContact& contact : result.contacts) missed[contact.query] = false;
  for (int i = 0; i < kCount; ++i) ASSERT_FALSE(missed[i]) << "seed " << kSeed << " motion " << i;
  std::printf("seed %u: %zu of %d meet, %zu left to double, %zu contacts\n", kSeed, meeting, kCount,
              result.decided_in_double, result.contacts.size());
  EXPECT_GT(meeting, kCount / 3);
  EXPECT_LT(meeting, kCount * 2 / 3);
  EXPECT_LT(result.decided_in_double, meeting + kCount * 2 / 5) << "float decides all but near contacts";
}

TYPED_TEST(CcdLanes, ReportTheContactsOfTheTestInDouble) {
  constexpr unsigned kSeed = 5003;
  const auto motions = random_motions<TypeParam>(kSeed, 20000);
  const CcdBatchResult result = in_lanes(motions);
  std::size_t contacts = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const CcdResult expected = in_double(motions[i]);
    if (expected.status != CcdStatus::Contact) continue;
    ASSERT_LT(contacts, result.contacts.size()) << "seed " << kSeed;
    ASSERT_EQ(result.contacts[contacts].query, i) << "seed " << kSeed;
    EXPECT_EQ(result.contacts[contacts].ccd.toi, expected.toi);
    ++contacts;
  }
  EXPECT_EQ(contacts, result.contacts.size());
  EXPECT_GT(contacts, 100u);
  EXPECT_LT(result.decided_in_double, motions.size() / 2);
}

TYPED_TEST(CcdLanes, GiveTheSameAtEveryWidthAndWhateverTheLengthOfTheBatch) {
  constexpr unsigned kSeed = 5004;
  std::printf("seed %u\n", kSeed);
  auto motions = random_motions<TypeParam>(kSeed, 3000);
  const auto hits = ShearedHits(kSeed).some<TypeParam>(1000);
  for (std::size_t i = 0; i < hits.size(); ++i) motions.insert(motions.begin() + 2 * i, hits[i]);
  const CcdBatchResult expected = in_lanes(motions, LaneCount::One);
  for (const LaneCount lanes : lane_counts()) {
    EXPECT_TRUE(same(in_lanes(motions, lanes), expected)) << static_cast<int>(lanes) << " lanes";
    for (const int count : {0, 1, 3, 7, 9, 17, 100, 511, 513}) {
      const std::vector<TypeParam> part(motions.begin(), motions.begin() + count);
      EXPECT_TRUE(same(in_lanes(part, lanes), in_lanes(part, LaneCount::One)))
          << count << " motions in " << static_cast<int>(lanes) << " lanes";
    }
  }
}

TYPED_TEST(CcdLanes, DecideAlikeAtEveryScaleAndPlace) {
  constexpr unsigned kSeed = 5005;
  std::printf("seed %u\n", kSeed);
  auto motions = random_motions<TypeParam>(kSeed, 2000);
  for (auto& m : motions)
    for (Vec3* p : points_of(m)) *p = {std::round(p->x * 0x1p22), std::round(p->y * 0x1p22), std::round(p->z * 0x1p22)};
  const CcdBatchResult expected = in_lanes(motions);
  // Scales by powers of two from 1e-3 to 1e5 for coordinates of about 1, and offsets up to 1000 times that: no
  // rounding.
  for (const double scale : {0x1p-32, 0x1p-22, 0x1p-12, 0x1p-5})
    for (const Vec3 place : {Vec3{}, Vec3{0x1p30, -0x1p32, 0x1p31}}) {
      auto placed = motions;
      for (auto& m : placed)
        for (Vec3* p : points_of(m)) *p = scale * (*p + place);
      EXPECT_TRUE(same(in_lanes(placed), expected)) << "scale " << scale;
    }
}

TYPED_TEST(CcdLanes, LeaveToDoubleWhatIsBeyondTheRangeOfFloat) {
  constexpr unsigned kSeed = 5006;
  std::printf("seed %u\n", kSeed);
  const auto hits = ShearedHits(kSeed).some<TypeParam>(2000);
  for (const double scale : {0x1p-180, 0x1p-150, 0x1p-120, 0x1p-60, 0x1p60, 0x1p110, 0x1p130, 0x1p200}) {
    auto scaled = hits;
    for (auto& m : scaled)
      for (Vec3* p : points_of(m)) *p = scale * *p;
    EXPECT_EQ(in_lanes(scaled).contacts.size(), hits.size()) << "scale " << scale;
  }
}

TYPED_TEST(CcdLanes, TakeFeaturesWithoutExtent) {
  std::vector<TypeParam> motions(40);
  for (auto& m : motions)
    for (Vec3* p : points_of(m)) *p = {1, 2, 3};
  const CcdBatchResult result = in_lanes(motions);
  EXPECT_EQ(result.contacts.size(), motions.size());
}

}  // namespace
}  // namespace dismantle
