// SPDX-License-Identifier: Apache-2.0
// Motions of method `certificates` with a device, compared step by step with the same without: on emulated devices, and
// on a CUDA device if there is one.
#include "dismantle/certificates/sweep/triangle_pair_sweep.h"
#include "dismantle/documents/motion_file.h"
#include "dismantle/loading/load_assembly.h"
#include "dismantle/math/vec3f.h"
#include "tests/support/large_scenes.h"
#include "tests/support/slide_drags.h"
#include "tests/support/tested_device.h"

#include <gtest/gtest.h>

#include <optional>
#include <ostream>

namespace dismantle {
namespace {

using namespace scenes;

const TestedDevice kDevices[] = {{"Serial", Executor()},
                                 {"Shuffled", Executor(ExecutorKind::Shuffled)},
                                 {"Threads3", Executor(ExecutorKind::Threads, 3)},
                                 {"Cuda", std::nullopt}};

/// Counts of a device's queries.
struct QueryCounts {
  std::size_t sweeps = 0, failing = 0, decided = 0;
  std::size_t tests = 0;         ///< Elementary tests evaluated by the device.
  std::size_t tests_taken = 0;   ///< Of these, those that steps used.
  std::size_t tests_wanted = 0;  ///< All that steps needed.
  std::size_t parents = 0;       ///< Pairs of nodes queried for merging.
};

/// Expects the result of the host for the same faces, bit for bit.
void expect_same_test(const TrianglePairResult& found, const TrianglePairResult& expected) {
  EXPECT_EQ(found.free, expected.free);
  EXPECT_EQ(found.gap, expected.gap);
  EXPECT_EQ(found.contact.face_moving, expected.contact.face_moving);
  EXPECT_EQ(found.contact.face_fixed, expected.contact.face_fixed);
  EXPECT_EQ(found.contact.toi, expected.contact.toi);
  EXPECT_EQ(found.contact.axis, expected.contact.axis);
}

/// Counts queries, and checks results that no sweep uses.
class CountedDevice final : public FrontDevice {
 public:
  CountedDevice(std::unique_ptr<FrontDevice> device, QueryCounts& counts)
      : device_(std::move(device)), counts_(counts) {}
  Span<const PartResults> evaluate(Span<const FrontQuery> fronts, bool exhaustive) override {
    const Span<const PartResults> results = device_->evaluate(fronts, exhaustive);
    ++counts_.sweeps;
    std::size_t part = 0;
    for (const FrontQuery& query : fronts)
      for (std::size_t p = 0; p < query.front->part_count(); ++p) count(results[part++], query);
    return results;
  }
  Span<const NodeSeparation> separate(Span<const FrontQuery> fronts, Span<const MergeCandidate> pairs) override {
    counts_.parents += pairs.size();
    return device_->separate(fronts, pairs);
  }

 private:
  void count(const PartResults& part, const FrontQuery& query) {
    std::vector<std::uint32_t> left = part.roots;
    counts_.failing += left.size();
    for (const std::uint32_t root : left) counts_.decided += part.pairs[root].kind != PairResult::None ? 1 : 0;
    while (!left.empty()) {
      const PairResult& result = part.pairs[left.back()];
      left.pop_back();
      if (result.first_child != PairResult::kNone)
        left.insert(left.end(), {result.first_child, result.first_child + 1});
      if (result.test == PairResult::kNone) continue;
      ++counts_.tests;
      const TrianglePairResult& found = part.tests[result.test];
      const Vec3 hint = to_double(result.separation.certificate.axis);
      expect_same_test(found, query.triangle_pairs->test(found.contact.face_moving, found.contact.face_fixed, hint));
    }
  }

  std::unique_ptr<FrontDevice> device_;
  QueryCounts& counts_;
};

class DeviceCertificates : public testing::TestWithParam<TestedDevice> {
 protected:
  void SetUp() override {
    if (GetParam().emulated_by) return;
    const auto cuda = make_cuda_front_device();
    if (!cuda) GTEST_SKIP() << "nothing runs on CUDA: " << cuda.error().message;
  }

  std::unique_ptr<FrontDevice> device(QueryCounts& counts) const {
    auto device = GetParam().emulated_by ? make_emulated_front_device(*GetParam().emulated_by, 1)
                                         : std::move(make_cuda_front_device(1).value());
    return std::make_unique<CountedDevice>(std::move(device), counts);
  }

  /// Plays a motion on the CPU and with the device, and expects equal steps.
  QueryCounts expect_same(const Assembly& assembly, double tolerance, const Motion& motion, std::size_t min_pairs = 0) {
    const PairStates states = states_of(assembly, tolerance);
    QueryCounts counts;
    CertificateEngine plain(assembly, states);
    CertificateEngine engine(assembly, states, {}, {device(counts), min_pairs});
    const PlayedMotion expected = play_motion(assembly, states, motion, plain).value();
    const PlayedMotion played = play_motion(assembly, states, motion, engine).value();
    EXPECT_EQ(played.steps.size(), expected.steps.size());
    for (std::size_t k = 0; k < played.steps.size() && !HasFailure(); ++k) {
      SCOPED_TRACE(k);
      expect_same_step(played.steps[k].result, expected.steps[k].result);
      EXPECT_EQ(expected.steps[k].result.cost.device_tests, 0u);
      counts.tests_taken += played.steps[k].result.cost.device_tests;
      counts.tests_wanted += played.steps[k].result.cost.tests;
    }
    return counts;
  }

 private:
  static void expect_same_step(const StepResult& step, const StepResult& expected) {
    EXPECT_EQ(step.pose, expected.pose);
    EXPECT_EQ(step.reached, expected.reached);
    EXPECT_EQ(step.poses, expected.poses);
    EXPECT_EQ(step.blocking_pairs, expected.blocking_pairs);
    EXPECT_EQ(step.contact_points, expected.contact_points);
    EXPECT_EQ(step.sweeps, expected.sweeps);
    EXPECT_EQ(step.clearance, expected.clearance);
    EXPECT_EQ(step.cost.pairs, expected.cost.pairs);
    EXPECT_EQ(step.cost.tests, expected.cost.tests);
  }
};

std::string name_of_device(const testing::TestParamInfo<TestedDevice>& device) {
  return device.param.name;
}

INSTANTIATE_TEST_SUITE_P(On, DeviceCertificates, testing::ValuesIn(kDevices), name_of_device);

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

TEST_P(DeviceCertificates, PlayTheMicroscopesMotionLikeTheCpu) {
  const std::string sample = DISMANTLE_SOURCE_DIR "/samples/microscope";
  const Assembly assembly = load_assembly(sample + ".step").value();
  Motion motion = read_motion(sample + ".motion.json").value();
  for (MotionMove& move : motion.moves)
    if (move.targets.size() > 12) move.targets.resize(12);
  for (const ResponseKind response : {ResponseKind::Touch, ResponseKind::Slide}) {
    motion.response = response;
    EXPECT_GT(expect_same(assembly, 0.01, motion).decided, 1000u);
  }
}

}  // namespace
}  // namespace dismantle
