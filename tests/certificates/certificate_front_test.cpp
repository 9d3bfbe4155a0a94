// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/front/certificate_front.h"

#include "dismantle/narrowphase/penetration_triangle_triangle.h"
#include "tests/support/pair_motions.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <set>

namespace dismantle {
namespace {

constexpr double kAllowed = 0.01;

struct Body {
  TriangleMesh mesh;
  ObbTree tree;
};

Body body_of(TriangleMesh mesh) {
  Body body{std::move(mesh), {}};
  body.tree = obb_tree_build(body.mesh.vertices, body.mesh.faces, Executor());
  return body;
}

using FacePairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/// A sweep of a whole front.
struct SweepSettings {
  double allowed = kAllowed;
  LaneCount lanes = widest_lanes();
};

/// Sweeps the whole front. @return the pairs of faces that it cannot certify
FacePairs uncertified(CertificateFront& front, const Body& a, const Body& b, const Pose& start, const Pose& end,
                      const SweepSettings& settings = {}) {
  PairMotion motion = scenes::pair_motion(a.tree, b.tree, start, end);
  motion.allowed = settings.allowed;
  const PreparedSweep sweep = front.prepare_sweep(motion);
  FacePairs found;
  const TrianglePairTest test = [&](const TrianglePairCandidate& candidate) {
    found.insert({candidate.face_moving, candidate.face_fixed});
    TrianglePairVerdict verdict;
    verdict.free = false;
    verdict.certificate.offset = kNoCertificate;
    return verdict;
  };
  for (std::size_t part = 0; part < front.part_count(); ++part) {
    front.merge_part(part, sweep, front_kernels(settings.lanes));
    front.sweep_part(part, sweep, front_kernels(settings.lanes), test);
  }
  front.end_sweep(sweep, found.empty());
  return found;
}

Aabb box_of(const Triangle& t) {
  Aabb box;
  for (int k = 0; k < 3; ++k) box.extend(t[k]);
  return box;
}

/// Pairs of faces that overlap by more than allowed at one of a few instants of the linear motion.
FacePairs too_deep(const Body& a, const Body& b, const Pose& start, const Pose& end, double allowed) {
  FacePairs found;
  const RigidTransform t0 = transform_from_pose(start), t1 = transform_from_pose(end);
  for (std::uint32_t i = 0; i < a.mesh.faces.size(); ++i)
    for (std::uint32_t j = 0; j < b.mesh.faces.size(); ++j)
      for (const double s : {0.0, 0.3, 0.7, 1.0}) {
        Triangle moving = a.mesh.triangle(i);
        for (int k = 0; k < 3; ++k) moving[k] = (1 - s) * (t0 * moving[k]) + s * (t1 * moving[k]);
        if (!overlaps(box_of(moving), box_of(b.mesh.triangle(j)))) continue;
        if (penetration_triangle_triangle(moving, b.mesh.triangle(j)).depth > allowed) found.insert({i, j});
      }
  return found;
}

/// Sweeps the front and expects that it leaves all pairs that get too deep to the triangle test. @return their number
std::size_t expect_deep_ones_left(CertificateFront& front, const Body& a, const Body& b, const Pose& start,
                                  const Pose& end, double allowed = kAllowed) {
  const FacePairs left = uncertified(front, a, b, start, end, {allowed}), deep = too_deep(a, b, start, end, allowed);
  for (const auto& pair : deep) EXPECT_TRUE(left.count(pair)) << "faces " << pair.first << " " << pair.second;
  return deep.size();
}

/// Fronts of surfaces with an allowance, and of ghost surfaces, which have none.
class CertificateFrontAllowing : public testing::TestWithParam<double> {};

TEST_P(CertificateFrontAllowing, LeavesEveryPairThatGetsTooDeepToTheTriangleTest) {
  std::mt19937_64 random(20261121);
  const Body a = body_of(scenes::tube(2, 1, 0, 4, 12, 3)), b = body_of(scenes::box({-3, -1, -2}, {3, 1, 2}));
  CertificateFront front(a.tree, b.tree);
  Pose pose{{4, 0, 0}, {}};
  std::size_t deep_pairs = 0;
  for (int step = 0; step < 120; ++step) {
    SCOPED_TRACE(step);
    const Pose next = scenes::random_pose(random, 3, 0.3) * Pose{0.4 * pose.position, pose.rotation};
    deep_pairs += expect_deep_ones_left(front, a, b, pose, next, GetParam());
    pose = next;
  }
  EXPECT_GT(deep_pairs, 500u);
}

TEST_P(CertificateFrontAllowing, IsTheSameAtEveryLaneCount) {
  const Body a = body_of(scenes::tube(2, 1, 0, 4, 24, 6)), b = body_of(scenes::tube(4, 2.02, -1, 5, 24, 6));
  std::vector<CertificateFront> fronts;
  for (std::size_t k = 0; k < lane_counts().size(); ++k) fronts.emplace_back(a.tree, b.tree);
  std::mt19937_64 random(5);
  Pose pose;
  for (int step = 0; step < 60; ++step) {
    const Pose next = scenes::random_pose(random, 0.02, 0.01) * Pose{{0, 0, 0.05 * step}, {}};
    const FacePairs first = uncertified(fronts[0], a, b, pose, next, {GetParam(), lane_counts()[0]});
    for (std::size_t k = 1; k < fronts.size(); ++k) {
      EXPECT_EQ(uncertified(fronts[k], a, b, pose, next, {GetParam(), lane_counts()[k]}), first) << "step " << step;
      EXPECT_EQ(fronts[k].size(), fronts[0].size());
    }
    pose = next;
  }
}

INSTANTIATE_TEST_SUITE_P(All, CertificateFrontAllowing, testing::Values(0.0, kAllowed));

/// A body with all that is round of it in parts of their own.
struct RevolutionBody : Body {
  explicit RevolutionBody(TriangleMesh of) : Body{std::move(of), {}} {
    const std::vector<RevolutionAxis> axes = revolution_axes(mesh.vertices, mesh.faces);
    std::vector<std::uint8_t> parts;
    add_cylinder_parts(mesh.vertices, mesh.faces, axes, parts);
    tree = obb_tree_build(mesh.vertices, mesh.faces, Executor(), parts);
    revolution =
        std::make_unique<RevolutionSurface>(mesh.vertices, mesh.faces, tree.nodes, axes, std::vector<ThreadAxis>{});
  }
  std::unique_ptr<RevolutionSurface> revolution;
};

TEST(CertificateFront, LeavesDeepPairsInABoreToTheTriangleTestAndIsOtherwiseAFewPairs) {
  const RevolutionBody shaft(scenes::tube(2, 1, 0, 4, 48, 1)), bush(scenes::tube(4, 2.002, 1, 6, 48, 1));
  CertificateFront front(shaft.tree, bush.tree, shaft.revolution.get(), bush.revolution.get());
  std::mt19937_64 random(20261122);
  Pose pose;
  std::size_t deep_pairs = 0;
  for (int step = 0; step < 20; ++step) {
    SCOPED_TRACE(step);
    // Sometimes it is pressed in further, up to three times the allowance.
    const double play = step % 3 == 0 ? 0.03 : 0.003;
    const Pose next{scenes::random_vector(random, play) + Vec3{0, 0, 0.1 * step}, quat_about({0, 0, 1}, 0.07 * step)};
    deep_pairs += expect_deep_ones_left(front, shaft, bush, pose, next);
    pose = next;
  }
  EXPECT_GT(deep_pairs, 100u);
  for (int step = 0; step < 20; ++step) EXPECT_TRUE(uncertified(front, shaft, bush, {}, {{0, 0, 0.01}, {}}).empty());
  EXPECT_LT(front.size(), 64u);
}

TEST(CertificateFront, StaysAPairOfRootsFarAway) {
  const Body a = body_of(scenes::tube(2, 1, 0, 4, 24, 6)), b = body_of(scenes::box({50, 0, 0}, {60, 10, 10}));
  CertificateFront front(a.tree, b.tree);
  EXPECT_TRUE(uncertified(front, a, b, {}, {{1, 2, 3}, quat_about({0, 0, 1}, 1)}).empty());
  EXPECT_EQ(front.size(), 1u);
}

TEST(CertificateFront, MergesAgainWhenComponentsSeparate) {
  const Body a = body_of(scenes::tube(2, 0, 0, 4, 24, 6)), b = body_of(scenes::tube(4, 2.02, -1, 5, 24, 6));
  CertificateFront front(a.tree, b.tree);
  uncertified(front, a, b, {}, {{0, 0, 0.1}, {}});
  const std::size_t inside = front.size();
  EXPECT_GT(inside, 100u);
  for (int step = 0; step < 400; ++step) uncertified(front, a, b, {{0, 0, 20}, {}}, {{0, 0, 20.1}, {}});
  EXPECT_LT(front.size(), inside / 20);
}

TEST(CertificateFront, StaysBoundedUnderMotionBackAndForth) {
  const Body a = body_of(scenes::tube(2, 0, 0, 4, 48, 12)), b = body_of(scenes::tube(4, 2.05, -1, 5, 48, 12));
  CertificateFront front(a.tree, b.tree);
  uncertified(front, a, b, {}, {{0, 0, 0.1}, {}});
  const std::size_t start = front.size();
  Pose pose;
  for (int step = 0; step < 10'000; ++step) {
    const double at = 0.1 * (step % 40 < 20 ? step % 20 : 20 - step % 20);
    const Pose next{{0, 0, at}, quat_about({0, 0, 1}, 0.01 * at)};
    uncertified(front, a, b, pose, next);
    pose = next;
  }
  EXPECT_LE(front.size(), 2 * start);
}

TEST(CertificateFront, MayStopAtSomeBlockedPairsAndReportsIt) {
  const Body a = body_of(scenes::tube(2, 0, 0, 4, 48, 12)), b = body_of(scenes::tube(4, 1.998, -1, 5, 40, 12));
  PairMotion motion;
  motion.t0 = motion.t1 = {{}, a.tree.origin - b.tree.origin};
  const TrianglePairTest blocks = [](const TrianglePairCandidate&) {
    TrianglePairVerdict verdict;
    verdict.free = false;
    verdict.certificate.offset = kNoCertificate;
    return verdict;
  };
  const FrontKernels kernels = front_kernels(widest_lanes());
  const auto sweep = [&](CertificateFront& front) {
    FrontSweep all;
    const PreparedSweep linear = front.prepare_sweep(motion);
    for (std::size_t part = 0; part < front.part_count(); ++part) {
      front.merge_part(part, linear, kernels);
      const FrontSweep found = front.sweep_part(part, linear, kernels, blocks);
      all.blocked += found.blocked;
      all.complete &= found.complete;
    }
    front.end_sweep(linear, all.blocked == 0 && all.complete);
    return all;
  };
  CertificateFront front(a.tree, b.tree);
  const FrontSweep every = sweep(front);
  EXPECT_TRUE(every.complete);
  EXPECT_GT(every.blocked, 200u);

  motion.max_blocked = 16;
  CertificateFront other(a.tree, b.tree);
  const FrontSweep some = sweep(other);
  EXPECT_FALSE(some.complete);
  EXPECT_GT(some.blocked, 0u);
  EXPECT_LT(some.blocked, every.blocked / 4);
  // Nodes that were skipped are evaluated by the next sweep that needs them.
  motion.max_blocked = PairMotion().max_blocked;
  const FrontSweep again = sweep(other);
  EXPECT_TRUE(again.complete);
  EXPECT_EQ(again.blocked, every.blocked);
}

TEST(CertificateFront, GoesOnWhereASweepWasCut) {
  const Body a = body_of(scenes::tube(2, 0, 0, 4, 96, 24)), b = body_of(scenes::tube(4, 2.02, -1, 5, 96, 24));
  PairMotion motion = scenes::pair_motion(a.tree, b.tree, {}, {{0, 0, 0.01}, {}});
  const TrianglePairTest apart = [](const TrianglePairCandidate&) {
    TrianglePairVerdict verdict;
    verdict.certificate.offset = 1e6f;  // it holds for good
    return verdict;
  };
  const FrontKernels kernels = front_kernels(widest_lanes());
  const auto sweep = [&](CertificateFront& front, std::size_t most) {
    FrontSweep all;
    PreparedSweep linear = front.prepare_sweep(motion);
    linear.max_node_pairs = most;
    for (std::size_t part = 0; part < front.part_count(); ++part) {
      const FrontSweep found = front.sweep_part(part, linear, kernels, apart);
      all.node_pairs += found.node_pairs;
      all.complete &= found.complete;
      all.cut |= found.cut;
    }
    front.end_sweep(linear, all.complete);
    return all;
  };
  CertificateFront whole(a.tree, b.tree);
  const FrontSweep once = sweep(whole, SIZE_MAX);
  EXPECT_TRUE(once.complete);
  EXPECT_FALSE(once.cut);
  ASSERT_GT(once.node_pairs, 1200u);

  CertificateFront parts(a.tree, b.tree);
  std::size_t sum = 0;
  int sweeps = 0;
  for (bool is_cut = true; is_cut && sweeps < 1000; ++sweeps) {
    const FrontSweep found = sweep(parts, 200);
    EXPECT_NE(found.complete, found.cut);
    sum += found.node_pairs;
    is_cut = found.cut;
  }
  EXPECT_GT(sweeps, 5);
  EXPECT_LT(sum, 2 * once.node_pairs) << "what was found is found again";
  EXPECT_EQ(sweep(parts, SIZE_MAX).node_pairs, 0u) << "all certificates hold";
}

TEST(CertificateFront, LooksForSiblingsMoreRarelyWhereNoneMerge) {
  const Body a = body_of(scenes::tube(2, 0, 0, 4, 24, 6)), b = body_of(scenes::tube(4, 2.02, -1, 5, 24, 6));
  CertificateFront front(a.tree, b.tree);
  const auto searches = [&](int sweeps) {
    int count = 0;
    for (int k = 0; k < sweeps; ++k) {
      count += front.siblings_of(0).empty() ? 0 : 1;
      uncertified(front, a, b, {}, {{0, 0, 0.01}, {}});
    }
    return count;
  };
  searches(200);
  EXPECT_LE(searches(128), 3);
  // A motion that invalidates most certificates.
  for (int k = 0; k < 8; ++k) uncertified(front, a, b, {}, {{0.5, 0, 0.01}, quat_about({0, 0, 1}, 0.3 * k)});
  EXPECT_GE(searches(32), 2);
}

TEST(CertificateFront, CutsPartsInWhichMostPairsShareANode) {
  // 3000 triangles across one that is as long as all of them, and a ladder of 10,000 through the middle: the smallest
  // node of the second tree is in most pairs, and the others are long.
  TriangleMesh row;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const double x = 0.1 * i;
    row.vertices.insert(row.vertices.end(), {{x, -0.5, 0}, {x + 0.08, -0.5, 0}, {x, 0.5, 0}});
    row.faces.push_back({{3 * i, 3 * i + 1, 3 * i + 2}});
  }
  TriangleMesh other;
  other.vertices = {{-500, 0, -900}, {800, 0, -900}, {150, 0, 900}};
  other.faces = {{{0, 1, 2}}};
  for (std::uint32_t i = 0; i < 10'000; ++i) {
    const double z = 0.1 * (i - 5000.0);
    const auto first = static_cast<std::uint32_t>(other.vertices.size());
    other.vertices.insert(other.vertices.end(), {{149.9, 0.2, z}, {150.1, 0.2, z}, {150, 0.2, z + 0.1}});
    other.faces.push_back({{first, first + 1, first + 2}});
  }
  const Body a = body_of(row), b = body_of(other);
  CertificateFront front(a.tree, b.tree);
  for (int sweep = 0; sweep < 3; ++sweep) EXPECT_GE(uncertified(front, a, b, {}, {}).size(), 3000u);
  EXPECT_GT(front.part_count(), 1u);
}

TEST(CertificateFront, SweepsConstWithoutChanges) {
  const Body a = body_of(scenes::tube(2, 0, 0, 4, 24, 6)), b = body_of(scenes::tube(4, 2.02, -1, 5, 24, 6));
  const CertificateFront front(a.tree, b.tree);
  PairMotion motion;
  motion.t0 = motion.t1 = {{}, a.tree.origin - b.tree.origin};
  motion.allowed = kAllowed;
  std::size_t first = 0, second = 0;
  for (std::size_t* count : {&first, &second})
    front.sweep_const(front.prepare_sweep(motion), front_kernels(widest_lanes()), [&](const TrianglePairCandidate&) {
      ++*count;
      return TrianglePairVerdict{};
    });
  EXPECT_EQ(first, second);
  EXPECT_EQ(front.size(), 1u);
}

TEST(CertificateFront, FindsTheSameInTheSameOrderWhetherItIsUpdatedOrNot) {
  const Body a = body_of(scenes::tube(2, 0, 0, 4, 24, 6)), b = body_of(scenes::tube(4, 1.97, -1, 5, 24, 6));
  PairMotion motion;
  motion.t0 = motion.t1 = {{}, a.tree.origin - b.tree.origin};
  for (const std::size_t max_blocked : {PairMotion().max_blocked, std::size_t{5}}) {
    motion.max_blocked = max_blocked;
    const auto sweep = [&](const auto& run) {
      std::vector<std::pair<std::uint32_t, std::uint32_t>> tested;
      const FrontSweep found = run([&](const TrianglePairCandidate& c) {
        tested.emplace_back(c.face_moving, c.face_fixed);
        TrianglePairVerdict verdict;
        verdict.free = (c.face_moving + c.face_fixed) % 3 != 0;
        return verdict;
      });
      EXPECT_GT(tested.size(), 10u);
      return std::tuple(tested, found.blocked, found.node_pairs, found.triangle_tests, found.complete, found.min_gap);
    };
    CertificateFront updated(a.tree, b.tree);
    const CertificateFront kept(a.tree, b.tree);
    const PreparedSweep prepared = kept.prepare_sweep(motion);
    const FrontKernels kernels = front_kernels(widest_lanes());
    EXPECT_EQ(sweep([&](const TrianglePairTest& test) { return kept.sweep_const(prepared, kernels, test); }),
              sweep([&](const TrianglePairTest& test) { return updated.sweep_part(0, prepared, kernels, test); }));
  }
}

TEST(CertificateFront, KeepsItsPairsWhenRolesAreExchanged) {
  const Body a = body_of({{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{{0, 1, 2}}}});
  const Body b = body_of({{{-2, -2, 1}, {2, -2, 1}, {0, 2, 1}}, {{{0, 1, 2}}}});
  CertificateFront front(a.tree, b.tree);
  EXPECT_TRUE(uncertified(front, a, b, {}, {{0, 0, 0.9}, {}}, {0}).empty());
  front.exchange_roles();
  // Now B moves in A's frame, where it is 0.1 above A.
  EXPECT_TRUE(uncertified(front, b, a, {{0, 0, -0.9}, {}}, {{0, 0, -0.99}, {}}, {0}).empty());
  EXPECT_FALSE(uncertified(front, b, a, {{0, 0, -0.99}, {}}, {{0, 0, -1.01}, {}}, {0}).empty());
}

}  // namespace
}  // namespace dismantle
