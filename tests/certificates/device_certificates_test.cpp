// SPDX-License-Identifier: Apache-2.0
#include "tests/support/device_certificates.h"
#include "tests/support/large_scenes.h"

namespace dismantle {
namespace {

using namespace scenes;

INSTANTIATE_TEST_SUITE_P(On, DeviceCertificates, testing::ValuesIn(kCertificateDevices), name_of_device);

TEST_P(DeviceCertificates, PullPegsOutLikeTheCpu) {
  for (const ResponseKind response : {ResponseKind::Slide, ResponseKind::Touch, ResponseKind::Stop}) {
    const SlideScene peg = peg_in_hole(48, 0.01);
    const QueryCounts counts = expect_same(peg.assembly, 0.005, motion_of(peg, pull(Hand(peg, {}), 30), response));
    EXPECT_GT(counts.sweeps, 5u);
    EXPECT_GT(counts.failing, 50u);
    EXPECT_GT(counts.decided, 0u);
    EXPECT_GT(counts.tests, 1000u);
    EXPECT_GT(counts.tests_taken, 0u);
    // The host evaluates what comes after a contact, and pairs at which sweeps stop early.
    EXPECT_LT(counts.tests_taken, counts.tests_wanted);
  }
}

TEST_P(DeviceCertificates, PullKeysAndCornersLikeTheCpu) {
  for (const SlideScene& scene : {key_in_slot(0.01, {0, 1, 0}), part_in_corner(), press_fit_pin(24, 0.02)}) {
    const QueryCounts counts = expect_same(scene.assembly, 0.01, motion_of(scene, pull(Hand(scene, {}), 15)));
    EXPECT_GT(counts.failing, 50u);
    EXPECT_GT(counts.tests, 0u);
  }
}

TEST_P(DeviceCertificates, RollGearsApartLikeTheCpu) {
  const GearPair pair = gear_pair(0.05);
  const SlideScene scene = meshing_gears(pair);
  std::vector<Pose> targets;
  for (int k = 1; k <= 25; ++k) targets.push_back(pair.rolled(0.01 * k, 0.2 * k));
  const QueryCounts counts = expect_same(scene.assembly, 0.01, motion_of(scene, targets));
  EXPECT_GT(counts.decided, 500u);
  EXPECT_GT(counts.parents, 100u);
}

TEST_P(DeviceCertificates, ScrewBoltsOutLikeTheCpu) {
  const SlideScene bolt = bolt_in_nut(12'000, 0.02);
  Hand hand(bolt, {0.5, 0.05, 0.01, 4});
  std::vector<Pose> targets;
  for (int k = 1; k <= 15; ++k) targets.push_back(hand.trembling(unscrewed(0.2 * k)));
  EXPECT_GT(expect_same(bolt.assembly, 0.01, motion_of(bolt, targets)).decided, 1000u);
}

TEST_P(DeviceCertificates, QueryTheDeviceForLargeFrontsOnly) {
  const GearPair pair = gear_pair(0.05);
  const SlideScene scene = meshing_gears(pair);
  std::vector<Pose> targets;
  for (int k = 1; k <= 10; ++k) targets.push_back(pair.rolled(0.01 * k));
  const Motion motion = motion_of(scene, targets);
  const QueryCounts always = expect_same(scene.assembly, 0.01, motion);
  const QueryCounts sometimes = expect_same(scene.assembly, 0.01, motion, 300);
  EXPECT_GT(sometimes.sweeps, 0u);
  EXPECT_LT(sometimes.sweeps, always.sweeps);
  EXPECT_EQ(expect_same(scene.assembly, 0.01, motion, 1'000'000'000).sweeps, 0u);
}

}  // namespace
}  // namespace dismantle
