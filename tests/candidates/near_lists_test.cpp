// SPDX-License-Identifier: Apache-2.0
#include "dismantle/candidates/find_near_lists.h"
#include "dismantle/candidates/screw_kernels.h"
#include "dismantle/candidates/straight_sweep.h"
#include "dismantle/exec/host_queue.h"
#include "dismantle/streams/guarded_pairs.h"
#include "dismantle/streams/moving_streams.h"
#include "tests/support/engine_scene.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

constexpr double kTolerance = 0.01;

/// A random assembly in a random state, with a moving set of two components.
struct ListedScene {
  /// @param shift of components from where they are assembled [mm]
  ListedScene(unsigned seed, double shift)
      : random(seed),
        assembly(scenes::random_assembly(random, 12, 9)),
        states(scenes::states_by_brute_force(assembly, kTolerance)),
        streams(assembly, Executor()),
        guards(assembly, states, streams.fixed(), {}),
        state(12),
        moving(12, 0) {
    streams.set_margins(guards.ghosts().margins, Executor());
    for (RigidTransform& pose : state)
      if (random() % 3 == 0) pose = transform_from_pose(scenes::random_pose(random, shift, 0.5 * shift));
    state[3] = state[4] = transform_from_pose(scenes::random_pose(random, shift, 0.5 * shift));
    moving[3] = moving[4] = 1;
    streams.jump(state, Executor());
    guards.jump(state);
    for (const int c : {3, 4}) roots.push_back(streams.fixed().bvh.components[static_cast<std::size_t>(c)].root);
  }

  CandidateScene scene() const {
    const AssemblyTriangles& fixed = streams.fixed();
    return {BvhView(fixed.bvh),
            streams.bounds(),
            fixed.vertices,
            streams.vertices_t0(),
            fixed.faces,
            roots,
            moving,
            {guards.ghosts().displaced, guards.ghosts().margins, state, state},
            guards.rules(),
            state[3]};
  }

  std::mt19937_64 random;
  Assembly assembly;
  PairStates states;
  MovingStreams streams;
  GuardedPairs guards;
  std::vector<RigidTransform> state;
  std::vector<std::uint32_t> moving;
  std::vector<NodeIndex> roots;
};

TEST(NearLists, ListRatesThatNoContactIsEarlierThan) {
  std::size_t contacts = 0, apart = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    ListedScene listed(seed, 0.2);
    const CandidateScene scene = listed.scene();
    const FoundNearLists lists = find_near_lists(scene, Executor());
    for (int i = 0; i < 100; ++i) {
      const Vec3 d = scenes::random_vector(listed.random, i % 2 == 0 ? 0.05 : 5);
      const StraightMotion motion(d);
      const StraightPiece piece(scene, d);
      const NearLists view{lists.near, lists.normals, lists.levels, lists.far};
      for (std::size_t k = 0; k < lists.near.size(); ++k) {
        const NearLeaves& near = lists.near[k];
        const PairRule rule = scene.rule_of(near.leaves);
        const CcdResult ccd =
            ccd_with_ghosts(scene.moving_leaf(near.leaves, rule, piece), scene.fixed_leaf(near.leaves, rule));
        const double rate = view.closing_rate(k, motion, i % 3 == 0 ? 1 : 0);
        if (ccd.status != CcdStatus::Contact) {
          apart += rate < 1 ? 1 : 0;
          continue;
        }
        ++contacts;
        // The test's times are early by up to a share of the ghosts' displacement.
        const double early = 0.02 * kTolerance / motion.distance;
        EXPECT_GE(rate * (ccd.toi + early), 1);
        EXPECT_GE((ccd.toi + early) * motion.distance, near.gap);
      }
    }
  }
  EXPECT_GT(contacts, 1000u);
  EXPECT_GT(apart, 1000u);
}

/// The contacts of a sweep by lists. @param most_pairs as of StraightSweep: with 0, pairs are tested one a candidate
std::vector<CandidateContact> swept(const CandidateScene& scene, const FoundNearLists& lists,
                                    const std::vector<Vec3>& displacements, std::size_t most_pairs) {
  HostQueue queue{Executor()};
  std::vector<CandidateContact> found(displacements.size());
  StraightSweep<HostQueue>(queue, most_pairs)
      .run(queue, scene, {lists.near, lists.normals, lists.levels, lists.far}, displacements, found);
  return found;
}

TEST(StraightSweep, GivesTheContactsOfASearchOfTheWholeTreeWhateverTheRoomAndTheOtherCandidates) {
  std::size_t free = 0, stopped = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    ListedScene listed(seed, 2);
    const CandidateScene scene = listed.scene();
    for (const NearLimits& limits : {NearLimits{0, 0}, NearLimits{7, 3}, NearLimits{1 << 18, 0}, NearLimits{}}) {
      const FoundNearLists lists = find_near_lists(scene, Executor(), limits);
      EXPECT_LE(lists.near.size(), limits.most);
      std::vector<Vec3> displacements;
      displacements.reserve(60);
      for (int i = 0; i < 60; ++i) displacements.push_back(scenes::random_vector(listed.random, i % 2 == 0 ? 0.3 : 30));
      const std::vector<CandidateContact> found = swept(scene, lists, displacements, 1 << 22);
      EXPECT_EQ(swept(scene, lists, displacements, 0), found);
      for (std::size_t i = 0; i < displacements.size(); ++i) {
        const StraightPiece piece(scene, displacements[i]);
        const CandidateContact expected = CandidateSearch<StraightPiece>(scene, piece).first();
        ASSERT_EQ(found[i].key == CandidateContact::kFree, expected.key == CandidateContact::kFree);
        EXPECT_NEAR(found[i].toi, expected.toi, 1e-4);
        EXPECT_EQ(swept(scene, lists, {displacements[i]}, 1 << 22)[0], found[i]);
        free += found[i].key == CandidateContact::kFree ? 1 : 0;
        stopped += found[i].key != CandidateContact::kFree && found[i].toi > 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(free, 100u);
  EXPECT_GT(stopped, 100u);
}

/// A pose of the moving set, near the one that the lists are of, and how far its points are from there.
ScrewStation station_at(const CandidateScene& scene, const ListedScene& listed, const RigidTransform& motion) {
  ScrewStation station{motion * scene.start, 0};
  const Bvh& bvh = listed.streams.fixed().bvh;
  for (std::size_t leaf = 0; leaf < bvh.leaf_count(); ++leaf) {
    if (listed.moving[bvh.component_of[leaf]] == 0) continue;
    for (const auto v : scene.faces[leaf].v)
      station.reach = std::max(station.reach, length(station.pose * scene.assembled[v] - scene.vertices[v]));
  }
  station.reach *= 1 + 1e-9;
  return station;
}

RigidTransform random_motion(std::mt19937_64& random, double size) {
  return transform_from_pose(scenes::random_pose(random, size, size));
}

TEST(NearLists, BoundTheContactsOfChordsFromBelow) {
  std::size_t contacts = 0, apart = 0, late = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    ListedScene listed(seed, 0.2);
    const CandidateScene scene = listed.scene();
    const FoundNearLists lists = find_near_lists(scene, Executor());
    for (int i = 0; i < 100; ++i) {
      const double size = i % 2 == 0 ? 0.01 : 0.5;
      const RigidTransform start = i % 3 == 0 ? RigidTransform{} : random_motion(listed.random, size);
      const TurningPiece piece(scene, start * scene.start, random_motion(listed.random, size) * start * scene.start);
      for (std::size_t k = 0; k < lists.near.size(); ++k) {
        const NodePair leaves = lists.near[k].leaves;
        const PairRule rule = scene.rule_of(leaves);
        const GhostMotion moving = scene.moving_leaf(leaves, rule, piece);
        const CcdResult ccd = ccd_with_ghosts(moving, scene.fixed_leaf(leaves, rule));
        const double bound = piece.contact_of_near(scene, lists.near[k], lists.levels[k]);
        if (ccd.status != CcdStatus::Contact) {
          apart += bound > 1 ? 1 : 0;
          continue;
        }
        ++contacts;
        late += bound > 0 ? 1 : 0;
        double way = 1e-300;
        for (int c = 0; c < 3; ++c) way = std::max(way, length(moving.triangle.t1[c] - moving.triangle.t0[c]));
        // The test's times are early by up to a share of the ghosts' displacement.
        EXPECT_LE(bound, ccd.toi + 0.02 * kTolerance / way);
      }
    }
  }
  EXPECT_GT(contacts, 1000u);
  EXPECT_GT(apart, 1000u);
  EXPECT_GT(late, 1000u);
}

TEST(SweepTurning, GivesTheContactsOfASearchOfTheWholeTree) {
  std::size_t free = 0, stopped = 0, searched = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    ListedScene listed(seed, 2);
    const CandidateScene scene = listed.scene();
    std::vector<ScrewStation> stations;
    std::vector<std::uint32_t> begin{0};
    for (int i = 0; i < 60; ++i) {
      const RigidTransform motion = random_motion(listed.random, i % 2 == 0 ? 0.02 : 0.4);
      stations.push_back(station_at(scene, listed, {}));
      stations.push_back(station_at(scene, listed, motion));
      stations.push_back(station_at(scene, listed, random_motion(listed.random, 0.05) * motion));
      begin.push_back(static_cast<std::uint32_t>(stations.size()));
    }
    std::vector<CandidateContact> expected;
    for (const NearLimits& limits : {NearLimits{0, 0}, NearLimits{7, 3}, NearLimits{1 << 18, 0}, NearLimits{}}) {
      const FoundNearLists lists = find_near_lists(scene, Executor(), limits);
      std::vector<CandidateContact> found(begin.size() - 1);
      const NearLists view{lists.near, lists.normals, lists.levels, lists.far};
      Executor().for_each(found.size(), SweepTurning{scene, view, stations, begin, found});
      if (expected.empty()) expected = found;  // without lists
      for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_EQ(found[i].key == CandidateContact::kFree, expected[i].key == CandidateContact::kFree);
        EXPECT_NEAR(found[i].toi, expected[i].toi, 1e-4);
        free += found[i].key == CandidateContact::kFree ? 1 : 0;
        stopped += found[i].key != CandidateContact::kFree && found[i].toi > 0 ? 1 : 0;
        searched += view.hold_within(stations[begin[i] + 2].reach) ? 0 : 1;
      }
    }
  }
  EXPECT_GT(free, 100u);
  EXPECT_GT(stopped, 100u);
  EXPECT_GT(searched, 100u);
}

}  // namespace
}  // namespace dismantle
