// SPDX-License-Identifier: Apache-2.0
// Components that are drawn in each other, lifted until they are hardly apart, or hardly not, and pressed back. The
// audit says whether they may be as deep again.
#include "dismantle/audit/audit_path.h"
#include "dismantle/session/play_motion.h"
#include "tests/certificates/grabbed_component.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace dismantle {
namespace {

using namespace grabbed;

/// A plate that is drawn into a block, either of them thick, thin or a foil.
struct SunkenPlate {
  SunkenPlate(std::mt19937_64& random, const Pose& place)
      : uniform(0, 1), depth(kTolerance * (1.2 + 7 * uniform(random))), scene(scene_of(random, place)) {}

  Assembly scene_of(std::mt19937_64& random, const Pose& place) {
    const auto thickness = [&] { return kTolerance * std::pow(10, 3 * uniform(random)); };
    const double half = 0.5 + 4 * uniform(random), above = std::max(0.05 * kTolerance, thickness() - depth);
    const TriangleMesh plate = scenes::box({-half, -half, -depth}, {half, 0.7 * half, above});
    const TriangleMesh block = scenes::box({-6, -6, -std::max(1.5 * depth, thickness())}, {6, 6, 0});
    return scenes::assembly({scenes::component("plate", scenes::moved(plate, place)),
                             scenes::component("block", scenes::moved(block, place))});
  }

  std::uniform_real_distribution<double> uniform;
  double depth;
  Assembly scene;
};

TEST(RandomParting, LetsNothingBackWhereTheAuditDoesNot) {
  std::mt19937_64 random(20261128);
  std::uniform_real_distribution<double> any(0, 1), side(-1, 1);
  int parted = 0, kept = 0;
  for (int round = 0; round < 150; ++round) {
    const Pose place = round % 3 == 0 ? Pose{} : scenes::random_pose(random, 5, 3);
    const SunkenPlate plate(random, place);
    const PairStates states = states_of(plate.scene);
    Motion motion{std::array{ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide}[round % 3],
                  {{{"plate"}, {{0, {}}}}}};
    for (int step = 0; step < 2 + round % 5; ++step) {
      const bool up = step % 2 == 0;
      const double gap = kTolerance * (std::pow(10, -2 + 2.2 * any(random)) - (any(random) < 0.4 ? 0.3 : 0));
      const Pose within{{0.05 * side(random), 0.05 * side(random), up ? plate.depth + gap : -kTolerance * any(random)},
                        quat_about(normalized(Vec3{side(random), side(random), side(random)}),
                                   step % 4 == 0 ? 1e-3 * side(random) : 0)};
      motion.moves[0].targets.push_back({1.0 + step, place * within * inverse(place)});
    }
    CertificateEngine engine(plate.scene, states);
    const Result<PlayedMotion> played = play_motion(plate.scene, states, motion, engine);
    ASSERT_TRUE(played.ok()) << played.error().message;
    const AuditReport report = audit_path(plate.scene, played->path);
    EXPECT_TRUE(report.holds()) << round << ": " << (report.violations.empty() ? "" : report.violations[0].message);
    (engine.overlapping_pairs().empty() ? parted : kept) += 1;
  }
  EXPECT_GT(parted, 50);
  EXPECT_GT(kept, 20);
}

/// A pin in a hole that is too small for it, their facets where they are deepest in each other.
TEST(RandomParting, LetsAPinBackThatIsHardlyOffItsHoleAsTheAuditDoes) {
  for (const std::uint32_t sides : {12u, 24u})
    for (const double apart : {0.3, 0.9, 4.0, 40.0}) {
      const Pose half_a_facet{{}, quat_about({0, 0, 1}, kTurn / (2 * sides))};
      const Assembly assembly =
          scenes::assembly({scenes::component("pin", scenes::moved(scenes::tube(5.05, 0, 0, 10, sides), half_a_facet)),
                            scenes::component("plate", scenes::tube(8, 5, 0, 10, sides))});
      const PairStates states = states_of(assembly);
      Motion motion{ResponseKind::Touch, {{{"pin"}, {{0, {}}}}}};
      double time = 0;
      for (const double z : {5.0, 10 + apart * kTolerance, 9.0, 5.0})
        motion.moves[0].targets.push_back({++time, {{0, 0, z}, {}}});
      CertificateEngine engine(assembly, states);
      const ComponentPair pair = engine.overlapping_pairs().at(0);
      EXPECT_GE(pair.allowed_depth, states.pairs[0].depth + 1.1 * kTolerance);
      const Result<PlayedMotion> played = play_motion(assembly, states, motion, engine);
      ASSERT_TRUE(played.ok()) << played.error().message;
      EXPECT_EQ(engine.overlapping_pairs().empty(), apart == 40) << sides << " sides, apart by " << apart;
      EXPECT_EQ(played->steps.back().result.reached, apart < 40);
      const AuditReport report = audit_path(assembly, played->path);
      EXPECT_TRUE(report.holds()) << sides << " sides, apart by " << apart << ": "
                                  << (report.violations.empty() ? "" : report.violations[0].message);
    }
}

}  // namespace
}  // namespace dismantle
