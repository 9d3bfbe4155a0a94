// SPDX-License-Identifier: Apache-2.0
#include "dismantle/fasteners/hexagon_drives.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

const RevolutionAxis kAxis{{}, {0, 0, 1}, 0};
const double kFlats = std::sqrt(3);  // across flats of a hexagon whose corners are 1 from its axis

/// The surfaces of two meshes.
TriangleMesh both(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Face& f : b.faces) a.faces.push_back({{f.v[0] + first, f.v[1] + first, f.v[2] + first}});
  return a;
}

TriangleMesh inside_out(TriangleMesh mesh) {
  for (Face& f : mesh.faces) std::swap(f.v[0], f.v[1]);
  return mesh;
}

TEST(HexagonDrives, MeasureAHeadAcrossItsFlats) {
  const std::vector<HexagonDrive> drives = hexagon_drives(scenes::tube(5, 0, 0, 4, 6, 3), kAxis);
  ASSERT_EQ(drives.size(), 1u);
  EXPECT_EQ(drives[0].kind, HexagonDrive::Kind::Head);
  EXPECT_NEAR(drives[0].across_flats, 5 * kFlats, 1e-9);
}

TEST(HexagonDrives, FindASocketInARoundHeadOnAnyAxis) {
  const TriangleMesh screw = both(scenes::tube(5, 0, 0, 4, 48), inside_out(scenes::tube(2, 0, 2, 4, 6)));
  const Pose turned{{7, -3, 2}, quat_about(normalized(Vec3{1, 2, 3}), 0.7)};
  const RigidTransform t = transform_from_pose(turned);
  const std::vector<HexagonDrive> drives =
      hexagon_drives(scenes::moved(screw, turned), {t * Vec3{0, 0, 1}, t.rotation * Vec3{0, 0, -1}, 0});
  ASSERT_EQ(drives.size(), 1u);
  EXPECT_EQ(drives[0].kind, HexagonDrive::Kind::Socket);
  EXPECT_NEAR(drives[0].across_flats, 2 * kFlats, 1e-9);
}

TEST(HexagonDrives, AreNoCylindersNoOtherPolygonsAndNoBoxes) {
  for (const std::uint32_t sides : {3u, 4u, 5u, 8u, 12u, 18u, 24u, 64u})
    EXPECT_TRUE(hexagon_drives(scenes::tube(5, 2, 0, 4, sides), kAxis).empty()) << sides;
  EXPECT_TRUE(hexagon_drives(scenes::box({-1, -1, -1}, {1, 1, 1}), kAxis).empty());
}

TEST(HexagonDrives, AreNoSpokesOfAWheel) {
  // The six sides of three spokes lie in the planes of a hexagon's sides, but reach out to the rim.
  const TriangleMesh spoke = scenes::box({1, -1, 0}, {20, 1, 4});
  TriangleMesh wheel = spoke;
  for (const int k : {1, 2})
    wheel = both(wheel, scenes::moved(spoke, {{}, quat_about({0, 0, 1}, k * 2 * std::acos(-1.0) / 3)}));
  EXPECT_TRUE(hexagon_drives(wheel, kAxis).empty());
}

TEST(HexagonDrives, AreNotSeenAboutAnotherAxis) {
  const TriangleMesh head = scenes::tube(5, 0, 0, 4, 6);
  EXPECT_TRUE(hexagon_drives(head, {{1, 0, 0}, {0, 0, 1}, 0}).empty());
  EXPECT_TRUE(hexagon_drives(head, {{}, {1, 0, 0}, 0}).empty());
}

}  // namespace
}  // namespace dismantle
