// SPDX-License-Identifier: Apache-2.0
#include "tests/support/device_certificates.h"
#include "tests/support/large_scenes.h"

namespace dismantle {
namespace {

using namespace scenes;

INSTANTIATE_TEST_SUITE_P(On, DeviceCertificates, testing::ValuesIn(kCertificateDevices), name_of_device);

/// A device that fails in its n-th call.
class FailingDevice final : public FrontDevice {
 public:
  explicit FailingDevice(int calls_before) : device_(make_emulated_front_device(Executor())), left_(calls_before) {}
  Span<const PartResults> evaluate(Span<const FrontQuery> fronts, bool exhaustive) override {
    fail_in_time();
    return device_->evaluate(fronts, exhaustive);
  }
  Span<const NodeSeparation> separate(Span<const FrontQuery> fronts, Span<const MergeCandidate> pairs) override {
    fail_in_time();
    return device_->separate(fronts, pairs);
  }

 private:
  void fail_in_time() {
    if (left_-- == 0) throw CudaError("a kernel failed (the device is lost)");
  }

  std::unique_ptr<FrontDevice> device_;
  int left_;
};

TEST(CertificateDevice, IsGivenUpWithTheSameResultsWhereverItFails) {
  const GearPair pair = gear_pair(0.05);
  const SlideScene scene = meshing_gears(pair);
  const PairStates states = states_of(scene.assembly, 0.01);
  for (int calls = 0; calls < 12; ++calls) {
    SCOPED_TRACE(calls);
    const auto failure = std::make_shared<DeviceFailure>();
    CertificateEngine plain(scene.assembly, states);
    CertificateEngine engine(scene.assembly, states, {}, {std::make_unique<FailingDevice>(calls), failure});
    for (CertificateEngine* each : {&plain, &engine}) each->grab(std::vector<ComponentId>{scene.moving});
    for (int k = 1; k <= 10; ++k) {
      const StepResult a = plain.step(pair.rolled(0.01 * k, 0.2 * k), ResponseKind::Slide);
      const StepResult b = engine.step(pair.rolled(0.01 * k, 0.2 * k), ResponseKind::Slide);
      ASSERT_EQ(a.poses, b.poses);
      ASSERT_EQ(a.clearance, b.clearance);
      ASSERT_EQ(a.cost.pairs, b.cost.pairs);
    }
    EXPECT_EQ(failure->why, "a kernel failed (the device is lost)");
  }
}

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
  EXPECT_GT(expect_same(scene.assembly, 0.01, motion_of(scene, targets), 1).decided, 100u) << "sweeps are cut";
}

TEST_P(DeviceCertificates, ScrewBoltsOutLikeTheCpu) {
  const SlideScene bolt = bolt_in_nut(12'000, 0.02);
  Hand hand(bolt, {0.5, 0.05, 0.01, 4});
  std::vector<Pose> targets;
  for (int k = 1; k <= 15; ++k) targets.push_back(hand.trembling(unscrewed(0.2 * k)));
  EXPECT_GT(expect_same(bolt.assembly, 0.01, motion_of(bolt, targets)).decided, 1000u);
}

}  // namespace
}  // namespace dismantle
