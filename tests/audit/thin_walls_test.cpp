// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/thin_walls.h"

#include "tests/audit/depth_scenes.h"
#include "tests/support/faulty_meshes.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <random>

namespace dismantle {
namespace {

using audit::SolidBody;
using depth_scenes::along;
using depth_scenes::audit_pair;
using depth_scenes::messages;
using depth_scenes::steps;

SolidBody body_of(const TriangleMesh& mesh) {
  return SolidBody(scenes::component("body", mesh));
}

bool in_one_piece(const TriangleMesh& mesh, const TriangleMesh& cutter, double finest = 0.05) {
  return stays_in_one_piece(body_of(mesh), body_of(cutter), finest);
}

bool is_thin(const TriangleMesh& mesh, double thickness) {
  return has_thin_wall(body_of(mesh), thickness, 0.5);
}

TEST(ThinWalls, AreFoundByTheirThickness) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 10; ++i) {
    const Pose at = scenes::random_pose(random, 20, 3);
    const TriangleMesh plate = scenes::moved(scenes::box({-5, -4, 0}, {5, 4, 1}), at);
    const TriangleMesh pipe = scenes::moved(scenes::tube(5, 4, 0, 8, 40), at);
    for (const TriangleMesh& mesh : {plate, scenes::inside_out(plate), pipe}) {
      EXPECT_FALSE(is_thin(mesh, 0.98)) << i;
      EXPECT_TRUE(is_thin(mesh, 1.02)) << i;
    }
  }
}

TEST(ThinWalls, AreOnlyWhereFacesAreOpposite) {
  const TriangleMesh flange = scenes::joined(scenes::box({-3, -3, 0}, {3, 3, 6}), scenes::box({3, -3, 0}, {9, 3, 1}));
  EXPECT_TRUE(is_thin(flange, 1.02));
  EXPECT_FALSE(is_thin(scenes::box({-3, -3, 0}, {3, 3, 6}), 5)) << "near its edges, faces are across each other";
  EXPECT_TRUE(is_thin(depth_scenes::wedge(40, 3, 6, 0), 1)) << "a blade is thin at its edge";
  EXPECT_FALSE(is_thin(depth_scenes::wedge(60, 3, 6, 0), 1));
  EXPECT_FALSE(is_thin(depth_scenes::sheet(3, 0), 1)) << "a sheet bounds no volume";
}

TEST(StaysInOnePiece, IsTrueForAPlateThatAPinGoesThroughAndNotForThePin) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20; ++i) {
    const Pose at = scenes::random_pose(random, 10, 3);
    const TriangleMesh plate = scenes::moved(scenes::box({-10, -8, 0}, {10, 8, 1}), at);
    TriangleMesh pin = scenes::tube(2, 0, -4, 5, 3 + static_cast<std::uint32_t>(i));
    for (Vec3& p : pin.vertices) p.x += 0.02 * i * p.z + 0.3 * i;
    pin = scenes::moved(pin, at);
    EXPECT_TRUE(in_one_piece(plate, pin)) << i;
    EXPECT_FALSE(in_one_piece(pin, plate)) << i;
    EXPECT_FALSE(in_one_piece(scenes::inside_out(pin), scenes::inside_out(plate))) << i;
  }
}

TEST(StaysInOnePiece, IsTrueForWhatLosesAnEndOrACorner) {
  const TriangleMesh block = scenes::box({-10, -8, -6}, {10, 8, 1}), pin = scenes::tube(2, 0, -4, 5, 24);
  EXPECT_TRUE(in_one_piece(pin, block));
  EXPECT_TRUE(in_one_piece(block, pin));
  EXPECT_TRUE(in_one_piece(block, scenes::box({8, 6, -8}, {12, 12, 3})));
  EXPECT_TRUE(in_one_piece(pin, scenes::box({-10, -8, -20}, {10, 8, 20}))) << "all of it is gone";
  EXPECT_TRUE(in_one_piece(pin, scenes::box({20, 20, 20}, {21, 21, 21}))) << "nothing is";
}

TEST(StaysInOnePiece, TellsARingThatIsCutOnceFromOneThatIsCutTwice) {
  const TriangleMesh ring = scenes::tube(6, 5, 0, 1, 40);
  EXPECT_TRUE(in_one_piece(ring, scenes::box({4, -0.5, -1}, {7, 0.5, 2})));
  EXPECT_FALSE(in_one_piece(ring, scenes::box({-7, -0.5, -1}, {7, 0.5, 2})));
}

TEST(StaysInOnePiece, IsAskedOfSolidsAndNotOfTheirSurfaces) {
  // A pin in a hole that is too small by 0.06: the skin of the pin is gone, and the rest holds together.
  const TriangleMesh plate = scenes::tube(12, 2, 0, 5, 30);
  EXPECT_TRUE(in_one_piece(scenes::tube(2.06, 0, -4, 8, 24), plate));
  EXPECT_TRUE(in_one_piece(plate, scenes::tube(2.06, 0, -4, 8, 24)));
  // A cup in a block: its wall makes a groove around what stays.
  const TriangleMesh block = scenes::box({-10, -8, -6}, {10, 8, 1});
  EXPECT_TRUE(in_one_piece(block, scenes::tube(4, 3, -3, 5, 24)));
  EXPECT_FALSE(in_one_piece(block, scenes::tube(4, 3, -8, 5, 24)));
}

TEST(StaysInOnePiece, OverlooksOnlyWhatIsThinnerThanTheFinestEdge) {
  const TriangleMesh rod = scenes::box({-0.5, -0.5, -10}, {0.5, 0.5, 10});
  for (const double thickness : {0.1, 0.4}) {
    const TriangleMesh slab = scenes::box({-3, -3, 0.123}, {3, 3, 0.123 + thickness});
    EXPECT_FALSE(in_one_piece(rod, slab, thickness / 2)) << thickness;
    EXPECT_TRUE(in_one_piece(rod, slab, 100)) << thickness;
  }
}

bool crosses(const AuditReport& audit) {
  return audit_scenes::count(audit, AuditViolationKind::Crossing) == 1 &&
         audit_scenes::count(audit, AuditViolationKind::Depth) == 0;
}

/// A blade through a plate without a slot is as deep as half of either: their depth lets it go anywhere.
class BladeThroughAPlate : public ::testing::Test {
 protected:
  const TriangleMesh blade_ = scenes::box({-1, -5, -4}, {1, 5, 6});
  const TriangleMesh plate_ = scenes::box({-20, -20, 0}, {20, 20, 2});
  const TriangleMesh strip_ = scenes::box({-20, -3, 0}, {20, 3, 2});
};

TEST_F(BladeThroughAPlate, ComesOutAlongItself) {
  for (const double side : {1.0, -1.0})
    for (const auto& [fixed, moving] : {std::pair{plate_, blade_}, std::pair{blade_, plate_}}) {
      const AuditReport audit = audit_pair(fixed, moving, along({0, 0, side}, steps(12, 3)));
      EXPECT_TRUE(audit.holds()) << side << messages(audit);
    }
}

TEST_F(BladeThroughAPlate, IsRejectedWhereItGoesAcrossItself) {
  for (const auto& [fixed, moving] : {std::pair{plate_, blade_}, std::pair{blade_, plate_}}) {
    const AuditReport audit = audit_pair(fixed, moving, along({1, 0, 0}, steps(8, 3)));
    EXPECT_TRUE(crosses(audit)) << messages(audit);
  }
  EXPECT_TRUE(audit_pair(plate_, blade_, along({1, 0, 0}, {0, 0.9})).holds());
}

TEST_F(BladeThroughAPlate, HasNoHoleInWhatWouldBeInTwo) {
  for (const double side : {1.0, -1.0}) {
    const AuditReport audit = audit_pair(strip_, blade_, along({0, 0, side}, steps(12, 3)));
    EXPECT_TRUE(crosses(audit)) << messages(audit);
  }
  // The strip comes out along itself, through the slot in the blade.
  const AuditReport slot = audit_pair(blade_, strip_, along({1, 0, 0}, steps(15, 3)));
  EXPECT_TRUE(slot.holds()) << messages(slot);
}

TEST_F(BladeThroughAPlate, IsRejectedInALaterMoveToo) {
  const Assembly a = scenes::assembly({scenes::component("plate", plate_), scenes::component("blade", blade_)});
  Path path = audit_scenes::path_of(a, 0.01);
  path.moves = {audit_scenes::move_through({"blade"}, along({0, 0, 1}, {0, 2})),
                audit_scenes::move_through({"blade"}, {{{0, 0, 2}, {}}, {{6, 0, 2}, {}}})};
  const AuditReport audit = audit_path(a, path);
  ASSERT_TRUE(crosses(audit)) << messages(audit);
  EXPECT_EQ(audit.violations[0].move, 1u);
}

}  // namespace
}  // namespace dismantle
