// SPDX-License-Identifier: Apache-2.0
// Components that overlap in the assembled state keep their allowance until they have been apart.
#include "tests/certificates/grabbed_component.h"
#include "tests/support/depth_oracle.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using namespace grabbed;

/// A block that is 0.2 mm deep in a floor.
Assembly sunken_block() {
  return scenes::assembly({scenes::component("block", scenes::box({0, 0, -0.2}, {5, 5, 5})),
                           scenes::component("floor", scenes::box({-20, -20, -5}, {20, 20, 0}))});
}

TEST(PairParting, EndsAnAllowanceWhereTwoAreApartAtTheEndOfAStepOnly) {
  const Assembly assembly = sunken_block();
  const PairStates states = states_of(assembly);
  for (const ResponseKind response : {ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide}) {
    SCOPED_TRACE(static_cast<int>(response));
    Grabbed block(assembly, states, 0);
    EXPECT_TRUE(block.engine.step({{0, 0, 0.25}, {}}, response).reached);
    EXPECT_TRUE(block.engine.overlapping_pairs().empty());
    EXPECT_FALSE(block.engine.step({}, response).reached);
    EXPECT_GE(block.engine.poses()[0].position.z, 0.2 - kTolerance);
  }
}

TEST(PairParting, KeepsAnAllowanceAsLongAsTwoOverlap) {
  const Assembly assembly = sunken_block();
  const PairStates states = states_of(assembly);
  Grabbed block(assembly, states, 0);
  EXPECT_TRUE(block.engine.step({{2, 0, 0.15}, {}}, ResponseKind::Slide).reached);
  EXPECT_EQ(block.engine.overlapping_pairs().size(), 1u);
  EXPECT_TRUE(block.engine.step({}, ResponseKind::Slide).reached);
}

TEST(PairParting, LetsFacetsOfAHingeMeetAgainAfterATurn) {
  // In phase the facets are 0.005 mm apart, and meet after half a facet.
  const Assembly assembly = scenes::assembly({scenes::component("pin", scenes::tube(4.995, 0, -2, 12, 16)),
                                              scenes::component("eye", scenes::tube(8, 5, 0, 10, 16))});
  const PairStates states = states_of(assembly);
  Grabbed pin(assembly, states, 0);
  for (int k = 1; k <= 40; ++k)
    EXPECT_TRUE(pin.engine.step({{}, quat_about({0, 0, 1}, 0.05 * k)}, ResponseKind::Slide).reached) << k;
}

}  // namespace
}  // namespace dismantle
