// SPDX-License-Identifier: Apache-2.0
// Steps that end as soon as they may, audited.
#include "dismantle/audit/audit_path.h"
#include "dismantle/session/play_motion.h"
#include "tests/certificates/grabbed_component.h"
#include "tests/support/large_scenes.h"
#include "tests/support/slide_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using namespace grabbed;

TEST(ShortSteps, HoldTheGuarantee) {
  CertificateOptions few_tests, few_nodes;
  few_tests.slide_tests = 1;  // a step ends with the first contacts that it finds
  few_nodes.node_pairs = 1;   // sweeps are cut

  // Parts that overlap or touch, drawn about by a trembling hand.
  const scenes::SlideScene all[] = {scenes::peg_in_hole(64, 0), scenes::dovetail(0), scenes::press_fit_pin(24, 0.02),
                                    scenes::meshing_gears(scenes::gear_pair(0.05)), scenes::ring_on_torus(4000, 0)};
  for (const CertificateOptions& options : {few_tests, few_nodes})
    for (const scenes::SlideScene& scene : all) {
      const std::string& name = scene.assembly[scene.moving].name;
      SCOPED_TRACE(name);
      const PairStates states = states_of(scene.assembly);
      Motion motion{ResponseKind::Slide, {{{name}, {{0, {}}}}}};
      scenes::Hand hand(scene, {0.1, 0.3, 0.06, 1});
      for (int k = 1; k <= 60; ++k)
        motion.moves[0].targets.push_back({0.01 * k, hand.trembling(hand.steady(0.03 * k))});
      CertificateEngine engine(scene.assembly, states, options);
      const Result<PlayedMotion> played = play_motion(scene.assembly, states, motion, engine);
      ASSERT_TRUE(played.ok()) << played.error().message;
      int unfinished = 0;
      for (const PlayedStep& step : played->steps) unfinished += step.result.unfinished ? 1 : 0;
      EXPECT_GT(unfinished, 0);
      EXPECT_TRUE(audit_path(scene.assembly, played->path).holds());
    }
}

}  // namespace
}  // namespace dismantle
