// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/certificates/sweep/triangle_pair_sweep.h"
#include "dismantle/math/vec3f.h"
#include "tests/support/slide_motions.h"
#include "tests/support/tested_device.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

/// Motions of method `certificates` with a device, compared step by step with the same without: on emulated devices,
/// and on a CUDA device if there is one.
namespace dismantle {

inline const TestedDevice kCertificateDevices[] = {{"Serial", Executor()},
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
inline void expect_same_test(const TrianglePairResult& found, const TrianglePairResult& expected) {
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
  /// @param node_pairs CertificateOptions::node_pairs of both
  QueryCounts expect_same(const Assembly& assembly, double tolerance, const Motion& motion,
                          std::size_t node_pairs = 0) {
    const PairStates states = scenes::states_of(assembly, tolerance);
    QueryCounts counts;
    CertificateOptions options;
    options.node_pairs = node_pairs;
    CertificateEngine plain(assembly, states, options);
    options.prepared = plain.surfaces();
    CertificateEngine engine(assembly, states, options, {device(counts), nullptr});
    for (const MotionMove& move : motion.moves) {
      std::vector<ComponentId> moving;
      for (const std::string& name : move.components) moving.push_back(assembly.find(name).value());
      plain.grab(moving);
      engine.grab(moving);
      for (std::size_t k = 0; k < move.targets.size() && !HasFailure(); ++k) {
        SCOPED_TRACE(k);
        const StepResult expected = plain.step(move.targets[k].pose, motion.response);
        const StepResult played = engine.step(move.targets[k].pose, motion.response);
        expect_same_step(played, expected);
        EXPECT_EQ(expected.cost.device_tests, 0u);
        counts.tests_taken += played.cost.device_tests;
        counts.tests_wanted += played.cost.tests;
      }
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
    EXPECT_EQ(step.unfinished, expected.unfinished);
    EXPECT_EQ(step.cost.node_pairs, expected.cost.node_pairs);
    EXPECT_EQ(step.cost.pairs, expected.cost.pairs);
    EXPECT_EQ(step.cost.tests, expected.cost.tests);
  }
};

inline std::string name_of_device(const testing::TestParamInfo<TestedDevice>& device) {
  return device.param.name;
}

}  // namespace dismantle
