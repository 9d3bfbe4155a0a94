// SPDX-License-Identifier: Apache-2.0
#include "dismantle/export/swept_volume.h"

#include "dismantle/geometry/adjacency.h"
#include "dismantle/math/screw.h"
#include "dismantle/surface/solid_tree_query.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

constexpr int kPoses = 24;

TimelineMove move_of(std::vector<ComponentId> components, const std::vector<Pose>& poses) {
  TimelineMove move;
  move.components = std::move(components);
  for (std::size_t i = 0; i < poses.size(); ++i) move.frames.push_back({static_cast<double>(i), poses[i]});
  return move;
}

/// Closely spaced poses of a move.
std::vector<Pose> poses_of(const TimelineMove& move) {
  std::vector<Pose> poses;
  for (std::size_t i = 1; i < move.frames.size(); ++i)
    for (int k = 0; k <= kPoses; ++k)
      poses.push_back(pose_between(move.frames[i - 1].pose, move.frames[i].pose, static_cast<double>(k) / kPoses));
  return poses;
}

/// The mesh as a solid for inside queries.
struct Solid {
  explicit Solid(TriangleMesh mesh) : component(scenes::component("solid", std::move(mesh))) {}
  Component component;
  SolidTree tree = make_solid_tree(component, Executor());
};

void expect_closed(const TriangleMesh& mesh) {
  const EdgeFaults faults = edge_faults(mesh);
  EXPECT_EQ(faults.boundary + faults.nonmanifold + faults.misoriented, 0u);
  EXPECT_GT(signed_volume(mesh), 0);
}

/// Expects that it contains all vertices at all times, and that each of its own is within the tolerance of the set at
/// some time.
void expect_swept(const Assembly& assembly, const TimelineMove& move, double tolerance) {
  const Result<SweptVolume> swept = swept_volume(assembly, move, {tolerance, {}});
  ASSERT_TRUE(swept.ok()) << swept.error().message;
  expect_closed(swept->mesh);
  const Solid all(swept->mesh);
  std::vector<Solid> parts;
  for (const ComponentId c : move.components) parts.emplace_back(assembled_mesh(assembly[c]));
  const std::vector<Pose> poses = poses_of(move);
  for (const Pose& pose : poses)
    for (const Solid& part : parts)
      for (const Vec3& p : part.component.mesh->vertices)
        ASSERT_TRUE(point_in_solid(all.tree, transform_from_pose(pose) * p));

  // It moves by less than this between two poses.
  const double between = screw_path_length(screw_between(poses[0], poses[1]), diagonal(bounds(swept->mesh)));
  for (std::size_t i = 0; i < swept->mesh.vertices.size(); i += 7) {
    const Vec3& p = swept->mesh.vertices[i];
    double minimum = 1e300;
    for (const Pose& pose : poses)
      for (const Solid& part : parts)
        minimum = std::min(
            minimum, nearest_face(part.tree, inverse(transform_from_pose(pose)) * p, NearestFace::kNone).distance);
    ASSERT_LE(minimum, swept->tolerance + between);
  }
}

TEST(SweptVolume, ContainsTheSweptSpaceAndLittleMore) {
  const Assembly a = scenes::assembly({scenes::component("bar", scenes::box({-1, -1, -4}, {1, 1, 4})),
                                       scenes::component("knob", scenes::tube(2, 0.8, 4, 6, 12))});
  const Pose out{{0, 3, 9}, {}};
  expect_swept(a, move_of({ComponentId(0)}, {{}, out}), 3);
  expect_swept(a, move_of({ComponentId(1)}, {{}, {{0, 0, 4}, quat_about({0, 0, 1}, 2)}}), 2);
  expect_swept(a, move_of({ComponentId(0), ComponentId(1)}, {{}, {{2, 0, 0}, quat_about({0, 1, 0}, 1.2)}, out}), 3.5);
}

TEST(SweptVolume, ContainsTheInsideOfSolidsAndKeepsCavitiesOpen) {
  // A block is filled; a hollow box that hardly moves stays hollow.
  const Assembly block = scenes::assembly({scenes::component("block", scenes::box({-5, -5, -5}, {5, 5, 5}))});
  const TimelineMove nudge = move_of({ComponentId(0)}, {{}, {{0.5, 0, 0}, {}}});
  const Result<SweptVolume> full = swept_volume(block, nudge, {1.8, {}});
  const double t = 2 * full->tolerance;
  EXPECT_GE(signed_volume(full->mesh), 10.5 * 100);
  EXPECT_LE(signed_volume(full->mesh), (10.5 + t) * (10 + t) * (10 + t));

  TriangleMesh shell = scenes::box({-5, -5, -5}, {5, 5, 5});
  const TriangleMesh hollow = scenes::box({-3, -3, -3}, {3, 3, 3});
  for (const Vec3& p : hollow.vertices) shell.vertices.push_back(p);
  for (const Face& f : hollow.faces) shell.faces.push_back({{f.v[0] + 8, f.v[2] + 8, f.v[1] + 8}});
  const Assembly hollow_box = scenes::assembly({scenes::component("shell", shell)});
  const Result<SweptVolume> swept = swept_volume(hollow_box, nudge, {1.8, {}});
  expect_closed(swept->mesh);
  EXPECT_LT(signed_volume(swept->mesh), signed_volume(full->mesh) - 1.8 * 1.8 * 1.8);
  EXPECT_FALSE(point_in_solid(Solid(swept->mesh).tree, {0.25, 0.01, 0.02}));
}

TEST(SweptVolume, HasADefaultToleranceAndRefusesOnesThatAreTooFine) {
  const Assembly a = scenes::assembly({scenes::component("block", scenes::box({0, 0, 0}, {2, 2, 2}))});
  const TimelineMove move = move_of({ComponentId(0)}, {{}, {{0, 0, 4}, {}}});
  const Result<SweptVolume> usual = swept_volume(a, move);
  ASSERT_TRUE(usual.ok());
  EXPECT_NEAR(usual->tolerance, kSweptShare * std::sqrt(4.0 + 4 + 36), 0.2 * usual->tolerance);
  const Result<SweptVolume> fine = swept_volume(a, move, {1e-4, {}});
  ASSERT_FALSE(fine.ok());
  EXPECT_EQ(fine.error().kind, ErrorKind::Usage);
  const Result<SweptVolume> cancelled = swept_volume(a, move, {0, [](std::string_view, double) { return false; }});
  ASSERT_FALSE(cancelled.ok());
  EXPECT_EQ(cancelled.error().kind, ErrorKind::Failed);
}

}  // namespace
}  // namespace dismantle
