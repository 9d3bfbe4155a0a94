// SPDX-License-Identifier: Apache-2.0
// One step towards thin walls with known times of contact, from the identity and from other start poses, near the
// origin and far from it.
#include "dismantle/audit/audit_path.h"
#include "dismantle/certificates/certificate_engine.h"
#include "tests/support/random_scenes.h"
#include "tests/support/tunnelling_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using namespace scenes;

/// A tenth of the thinnest wall.
constexpr double kTolerance = 1e-4;

/// The allowed error of a time of contact: the time that the motion takes for the tolerance.
double allowed_error(const OneStep& step) {
  const Screw screw = screw_between(step.start, step.target);
  const double path = length(step.target.position - step.start.position) + screw.angle * 5;
  return 4 * kTolerance / std::min(path, 10.0);
}

std::unique_ptr<CertificateEngine> engine_for(const Assembly& assembly, const OneStep& step) {
  auto engine = std::make_unique<CertificateEngine>(assembly, PairStates{kTolerance, {}});
  const Pose poses[] = {Pose{}, step.start};
  engine->jump({poses, 2});
  const ComponentId moving[] = {ComponentId(1)};
  engine->grab({moving, 1});
  return engine;
}

/// Audits `poses` as a path of the assembly in which the moving component is at its start.
void expect_audited(const OneStep& step, const std::vector<Pose>& poses) {
  OneStep baked = step;
  baked.moving = moved(step.moving, step.start);
  const Assembly assembly = assembly_of(baked);
  Path path;
  path.components = {"fixed", "moving"};
  path.tolerance = kTolerance;
  path.moves.push_back({"step", {"moving"}, {{0, {}}}});
  for (const Pose& pose : poses)
    path.moves[0].frames.push_back({path.moves[0].frames.back().time + 1, pose * inverse(step.start)});
  const AuditReport report = audit_path(assembly, path);
  EXPECT_TRUE(report.holds()) << (report.violations.empty() ? "" : report.violations[0].message);
}

void expect_right(const OneStep& step) {
  SCOPED_TRACE(step.name);
  const Assembly assembly = assembly_of(step);
  const double error = allowed_error(step);
  const FirstContact first = engine_for(assembly, step)->first_contact(step.target);
  EXPECT_EQ(first.free, step.free);
  if (!step.free) {
    EXPECT_NEAR(first.toi, step.toi, error);
    EXPECT_EQ(first.moving, ComponentId(1));
    EXPECT_EQ(first.fixed, ComponentId(0));
  }
  for (const ResponseKind response : {ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide}) {
    SCOPED_TRACE(name_of(response));
    const StepResult result = engine_for(assembly, step)->step(step.target, response);
    EXPECT_EQ(result.reached, step.free);
    if (step.free) {
      EXPECT_EQ(result.pose, step.target);
    } else if (response == ResponseKind::Touch) {
      const Pose exact = pose_between(step.start, step.target, step.toi);
      const Vec3 corner = step.moving.vertices[7];
      const double off = length(transform_from_pose(result.pose) * corner - transform_from_pose(exact) * corner);
      EXPECT_LT(off, 5 * kTolerance)
          << "the corner of a long part moves up to four times as far as the point that touches";
    }
    expect_audited(step, result.poses);
  }
}

TEST(Tunnelling, NeverHappensFromTheIdentity) {
  for (const OneStep& step : tunnelling_suite()) expect_right(step);
}

TEST(Tunnelling, NeverHappensFromBakedInStartPoses) {
  std::mt19937_64 random(20260110);
  for (int k = 0; k < 3; ++k)
    for (const OneStep& step : tunnelling_suite()) {
      expect_right(placed(step, random_pose(random, 20, 3)));
      expect_right(started_from(step, random_pose(random, 20, 3)));
    }
}

TEST(Tunnelling, NeverHappensFarFromTheOrigin) {
  for (const double far : {1e3, 1e4, 1e5}) {
    SCOPED_TRACE(far);
    for (const OneStep& step : tunnelling_suite()) {
      expect_right(placed(step, {{far, -far, 0.7 * far}, {}}));
      expect_right(placed(step, {{far, -far, 0.7 * far}, quat_about(normalized(Vec3{1, -2, 1}), 0.9)}));
    }
  }
}

}  // namespace
}  // namespace dismantle
