// SPDX-License-Identifier: Apache-2.0
// Fronts with a device compared with fronts without: on emulated devices, and on a CUDA device if there is one.
#include "dismantle/certificates/device/front_device.h"
#include "dismantle/certificates/front/certificate_front.h"
#include "tests/support/meshes.h"
#include "tests/support/pair_motions.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <optional>
#include <ostream>

namespace dismantle {
namespace {

constexpr double kAllowed = 0.01;

struct Device {
  const char* name;
  std::optional<Executor> emulated_by;  ///< None for the CUDA device.
  std::size_t capacity;
  friend std::ostream& operator<<(std::ostream& out, const Device& device) { return out << device.name; }
};

const Device kDevices[] = {{"Serial", Executor(), 1},
                           {"SerialOfRoom", Executor(), 100'000},
                           {"Shuffled", Executor(ExecutorKind::Shuffled), 1},
                           {"Threads2", Executor(ExecutorKind::Threads, 2), 50},
                           {"Threads7", Executor(ExecutorKind::Threads, 7), 1},
                           {"Cuda", std::nullopt, 1}};

ObbTree tree_of(const TriangleMesh& mesh) {
  return obb_tree_build(mesh.vertices, mesh.faces, Executor());
}

class DeviceFronts : public testing::TestWithParam<Device> {
 protected:
  void SetUp() override {
    if (GetParam().emulated_by) {
      device_ = make_emulated_front_device(*GetParam().emulated_by, GetParam().capacity);
      return;
    }
    auto cuda = make_cuda_front_device(GetParam().capacity);
    if (!cuda) GTEST_SKIP() << "nothing runs on CUDA: " << cuda.error().message;
    device_ = std::move(cuda.value());
  }

  std::unique_ptr<FrontDevice> device_;
};

std::string name_of_device(const testing::TestParamInfo<Device>& device) {
  return device.param.name;
}

INSTANTIATE_TEST_SUITE_P(On, DeviceFronts, testing::ValuesIn(kDevices), name_of_device);

/// The result of a sweep of a whole front.
struct Swept {
  float min_gap = 3e38f;
  std::size_t blocked = 0;
  bool complete = true;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> tested;
  std::size_t parents = 0;  ///< Pairs of nodes queried for merging; no result.
  friend bool operator==(const Swept& x, const Swept& y) {
    return x.min_gap == y.min_gap && x.blocked == y.blocked && x.complete == y.complete && x.tested == y.tested;
  }
};

/// Every third pair of triangles blocks.
TrianglePairTest triangle_pair_test(Swept& swept) {
  return [&swept](const TrianglePairCandidate& candidate) {
    const std::uint32_t moving = candidate.face_moving, fixed = candidate.face_fixed;
    const Vec3f hint = candidate.hint;
    swept.tested.emplace_back(moving, fixed);
    TrianglePairVerdict verdict;
    verdict.free = (moving + fixed) % 3 != 0;
    verdict.certificate.axis = hint;
    verdict.certificate.offset = kNoCertificate;
    return verdict;
  };
}

void add(Swept& swept, const FrontSweep& found) {
  swept.min_gap = std::min(swept.min_gap, found.min_gap);
  swept.blocked += found.blocked;
  swept.complete &= found.complete;
}

bool free_of(const Swept& swept) {
  return swept.blocked == 0 && swept.complete;
}

/// The merge candidates of the parts, for a device.
std::vector<MergeCandidate> parents_of(const std::vector<std::vector<Siblings>>& siblings) {
  std::vector<MergeCandidate> parents;
  for (const std::vector<Siblings>& of_part : siblings)
    for (const Siblings& s : of_part) parents.push_back({0, s.parent.a, s.parent.b});
  return parents;
}

/// Merges by a device's results. @return the number of pairs queried
std::size_t merge_by(FrontDevice& device, CertificateFront& front, const PreparedSweep& linear) {
  const FrontQuery query{&front, &linear};
  std::vector<std::vector<Siblings>> siblings;
  for (std::size_t part = 0; part < front.part_count(); ++part) siblings.push_back(front.siblings_of(part));
  const std::vector<MergeCandidate> parents = parents_of(siblings);
  const Span<const NodeSeparation> found = device.separate(Span<const FrontQuery>(&query, 1), parents);
  std::size_t begin = 0;
  for (std::size_t part = 0; part < front.part_count(); ++part) {
    const std::size_t count = siblings[part].size();
    front.merge_part(part, linear, front_kernels(widest_lanes()), siblings[part], found.subspan(begin, count));
    begin += count;
  }
  return begin;
}

Swept sweep(CertificateFront& front, const PairMotion& motion, FrontDevice* device, bool exhaustive) {
  Swept swept;
  const FrontKernels kernels = front_kernels(widest_lanes());
  const PreparedSweep linear = front.prepare_sweep(motion);
  Span<const PartResults> results;
  const FrontQuery query{&front, &linear};
  if (device) {
    swept.parents = merge_by(*device, front, linear);
    results = device->evaluate(Span<const FrontQuery>(&query, 1), exhaustive);
  }
  for (std::size_t part = 0; part < front.part_count(); ++part) {
    if (!device) front.merge_part(part, linear, kernels);
    add(swept, front.sweep_part(part, linear, kernels, triangle_pair_test(swept), device ? &results[part] : nullptr));
  }
  front.end_sweep(linear, free_of(swept));
  return swept;
}

/// Expects two fronts to be equal bit by bit, including their order.
void expect_same_fronts(CertificateFront& front, CertificateFront& expected) {
  ASSERT_EQ(front.part_count(), expected.part_count());
  for (std::size_t p = 0; p < front.part_count(); ++p) {
    const CertificatePart &part = front.part(p), &other = expected.part(p);
    ASSERT_EQ(part.size(), other.size());
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Certificate one = part.certificate(i), two = other.certificate(i);
      ASSERT_TRUE(part.pair(i).a == other.pair(i).a && part.pair(i).b == other.pair(i).b) << p << " " << i;
      ASSERT_EQ(std::memcmp(&one, &two, sizeof one), 0) << p << " " << i;
    }
  }
}

// A shaft pressed against its bore with tremor: fronts of several parts that grow, merge, are cut and joined, and
// exchange roles; sweeps with and without the device.
TEST_P(DeviceFronts, EqualTheFrontsOfTheHostFromCapacityOne) {
  const ObbTree a = tree_of(scenes::tube(2, 0, 0, 4, 64, 16)), b = tree_of(scenes::tube(4, 2.02, -1, 5, 64, 16));
  for (const double allowed : {0.0, kAllowed}) {
    CertificateFront front(a, b), expected(a, b);
    std::mt19937_64 random(20261123);
    Pose pose;
    std::size_t max_parts = 0, tests = 0, blocked = 0, parents = 0;
    bool exchanged = false;
    for (int step = 0; step < 50 && !HasFailure(); ++step) {
      SCOPED_TRACE(step);
      const double play = step % 3 == 0 ? 0.03 : 0.004;
      const Pose next{scenes::random_vector(random, play) + Vec3{0, 0, step < 30 ? 0.02 * step : 8.0},
                      quat_about({0, 0, 1}, 0.02 * step)};
      if (step == 40) {
        front.exchange_roles();
        expected.exchange_roles();
        exchanged = true;
      }
      PairMotion motion =
          exchanged ? scenes::pair_motion(b, a, inverse(pose), inverse(next)) : scenes::pair_motion(a, b, pose, next);
      motion.allowed = allowed;
      if (step % 4 == 1) motion.max_blocked = 8;
      const Swept wanted = sweep(expected, motion, nullptr, true);
      const Swept found = sweep(front, motion, step % 5 == 4 ? nullptr : device_.get(), step % 2 == 0);
      EXPECT_EQ(found, wanted);
      expect_same_fronts(front, expected);
      max_parts = std::max(max_parts, front.part_count());
      tests += wanted.tested.size();
      blocked += wanted.blocked;
      parents += found.parents;
      pose = next;
    }
    EXPECT_GT(max_parts, 1u);
    EXPECT_GT(tests, 1000u);
    EXPECT_GT(blocked, 100u);
    EXPECT_GT(parents, 100u);
  }
}

TEST_P(DeviceFronts, LeaveNothingToTheHostInAnExhaustiveQuery) {
  const ObbTree a = tree_of(scenes::tube(2, 0, 0, 4, 48, 12)), b = tree_of(scenes::tube(4, 2.02, -1, 5, 48, 12));
  CertificateFront front(a, b);
  PairMotion motion = scenes::pair_motion(a, b, {}, {{0.03, 0, 0.01}, {}});
  motion.allowed = kAllowed;
  const PreparedSweep linear = front.prepare_sweep(motion);
  const FrontQuery query{&front, &linear};
  const Span<const PartResults> results = device_->evaluate(Span<const FrontQuery>(&query, 1), true);
  ASSERT_EQ(results.size(), 1u);
  ASSERT_EQ(results[0].roots.size(), 1u);
  std::size_t of_kind[4] = {};
  std::vector<std::uint32_t> left = results[0].roots;
  while (!left.empty()) {
    const PairResult& result = results[0].pairs[left.back()];
    left.pop_back();
    ++of_kind[result.kind];
    if (result.kind != PairResult::Split) continue;
    ASSERT_NE(result.first_child, PairResult::kNone);
    left.insert(left.end(), {result.first_child, result.first_child + 1});
  }
  EXPECT_EQ(of_kind[PairResult::None], 0u);
  EXPECT_GT(of_kind[PairResult::Boxes], 100u);
  EXPECT_GT(of_kind[PairResult::Triangles], 100u);
  EXPECT_EQ(of_kind[PairResult::Split] + 1, of_kind[PairResult::Boxes] + of_kind[PairResult::Triangles]);
}

// A front that has moved away merges only by the given results: not at all if no parents are certified.
TEST_P(DeviceFronts, MergeByTheDevicesResultsForParents) {
  const ObbTree a = tree_of(scenes::tube(2, 0, 0, 4, 48, 12)), b = tree_of(scenes::tube(4, 2.02, -1, 5, 48, 12));
  CertificateFront front(a, b);
  PairMotion motion = scenes::pair_motion(a, b, {}, {{0.01, 0, 0}, {}});
  motion.allowed = kAllowed;
  for (int step = 0; step < 7; ++step) sweep(front, motion, nullptr, true);
  motion = scenes::pair_motion(a, b, {{0, 0, 6}, {}}, {{0, 0, 6.01}, {}});
  motion.allowed = kAllowed;
  const PreparedSweep linear = front.prepare_sweep(motion);
  CertificateFront lied_to = front, expected = front;
  std::size_t merged = 0;
  for (std::size_t part = 0; part < front.part_count(); ++part) {
    const std::vector<Siblings> siblings = front.siblings_of(part);
    const std::vector<NodeSeparation> overlap(siblings.size(), NodeSeparation{-1, Certificate::none()});
    lied_to.merge_part(part, linear, front_kernels(widest_lanes()), siblings, overlap);
    expected.merge_part(part, linear, front_kernels(widest_lanes()));
    merged += siblings.size();
  }
  EXPECT_GT(merged, 20u);
  EXPECT_EQ(merge_by(*device_, front, linear), merged);
  EXPECT_LT(front.size() * 2, lied_to.size());
  expect_same_fronts(front, expected);
}

TEST_P(DeviceFronts, OfSeveralPairsOfComponentsAreQueriedTogether) {
  const ObbTree a = tree_of(scenes::tube(2, 0, 0, 4, 24, 6)), b = tree_of(scenes::tube(4, 2.02, -1, 5, 24, 6)),
                c = tree_of(scenes::box({-3, -3, 4.5}, {3, 3, 6}));
  CertificateFront in_bore(a, b), to_box(a, c);
  CertificateFront* const fronts[] = {&in_bore, &to_box};
  for (int step = 0; step < 12; ++step) {
    std::vector<PreparedSweep> sweeps;
    for (const ObbTree* fixed : {&b, &c}) {
      PairMotion motion = scenes::pair_motion(a, *fixed, {}, {{0.01 * step, 0, 0.1 * step}, {}});
      motion.allowed = kAllowed;
      sweeps.push_back(fronts[sweeps.size()]->prepare_sweep(motion));
    }
    const FrontQuery queries[] = {{&in_bore, &sweeps[0]}, {&to_box, &sweeps[1]}};
    const Span<const PartResults> results = device_->evaluate(Span<const FrontQuery>(queries, 2), true);
    ASSERT_EQ(results.size(), in_bore.part_count() + to_box.part_count());
    std::size_t part = 0;
    for (std::size_t f = 0; f < 2; ++f) {
      CertificateFront expected = *fronts[f];
      Swept found, wanted;
      const FrontKernels kernels = front_kernels(widest_lanes());
      for (std::size_t p = 0; p < fronts[f]->part_count(); ++p, ++part) {
        add(wanted, expected.sweep_part(p, sweeps[f], kernels, triangle_pair_test(wanted)));
        add(found, fronts[f]->sweep_part(p, sweeps[f], kernels, triangle_pair_test(found), &results[part]));
      }
      EXPECT_EQ(found, wanted);
      expect_same_fronts(*fronts[f], expected);
    }
  }
}

}  // namespace
}  // namespace dismantle
