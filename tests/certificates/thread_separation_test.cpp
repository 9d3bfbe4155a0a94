// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/front/thread_separation.h"

#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "dismantle/surface/solid_tree.h"
#include "tests/support/large_scenes.h"
#include "tests/support/pair_motions.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <set>

namespace dismantle {
namespace {

scenes::Winding winding(double wider, std::uint32_t sides, std::uint32_t turns) {
  scenes::Winding w = scenes::thread(wider, 2);
  w.sides = sides;
  w.turns = turns;
  return w;
}

struct Body {
  Component component;
  SolidTree solid;
  explicit Body(TriangleMesh mesh)
      : component(scenes::component("part", std::move(mesh))), solid(make_solid_tree(component, Executor())) {}
};

/// A bolt of six turns in a nut of three, with about `clearance`.
struct Bolted {
  std::unique_ptr<Body> bolt_body, nut_body;
  const SolidTree& bolt() const { return bolt_body->solid; }
  const SolidTree& nut() const { return nut_body->solid; }
  explicit Bolted(double clearance, std::uint32_t sides, const Pose& frame = {}) {
    scenes::Winding outer = winding(0, sides, 6);
    outer.start = -outer.pitch;
    bolt_body = std::make_unique<Body>(scenes::moved(scenes::wound_solid(outer), frame));
    nut_body = std::make_unique<Body>(scenes::moved(scenes::wound_hole(winding(2 * clearance, sides, 3), 7), frame));
  }
};

PairMotion motion_of(const SolidTree& moving, const SolidTree& fixed, const Pose& start, const Pose& end) {
  return scenes::pair_motion(moving.tree, fixed.tree, start, end);
}

/// The minimum distance of the triangles under two nodes, at some times of the true screw.
double min_distance(const SolidTree& moving, std::uint32_t m, const SolidTree& fixed, std::uint32_t f,
                    const Pose& start, const Pose& end) {
  const ObbNode &a = moving.tree.nodes[m], &b = fixed.tree.nodes[f];
  if (!a.leaf())
    return std::min(min_distance(moving, a.child, fixed, f, start, end),
                    min_distance(moving, a.child + 1, fixed, f, start, end));
  if (!b.leaf())
    return std::min(min_distance(moving, m, fixed, b.child, start, end),
                    min_distance(moving, m, fixed, b.child + 1, start, end));
  double minimum = 1e9;
  for (const double time : {0.0, 0.25, 0.5, 0.8, 1.0}) {
    const RigidTransform t = transform_from_pose(pose_between(start, end, time));
    const Triangle own = moving.triangle(a.child);
    const Triangle there{{t * own[0], t * own[1], t * own[2]}};
    minimum = std::min(minimum, distance_triangle_triangle(there, fixed.triangle(b.child)).distance);
  }
  return minimum;
}

/// Pairs of small nodes with a claim.
struct Claims {
  int found = 0;  ///< By a sweep itself.
  int kept = 0;   ///< By a later sweep, from what the first one found.
};

/// Expects the claims of a sweep, and those that it keeps for another motion, to be true.
Claims expect_true(const SolidTree& moving, const SolidTree& fixed, const Pose (&first)[2], const Pose (&later)[2],
                   std::uint64_t seed) {
  const std::vector<ThreadMatch> matches =
      match_threads(*moving.revolution, moving.tree.origin, *fixed.revolution, fixed.tree.origin);
  EXPECT_EQ(matches.size(), 1u);
  const ThreadSweep sweep(matches.at(0), 0, motion_of(moving, fixed, first[0], first[1]));
  const ThreadSweep next(matches.at(0), 0, motion_of(moving, fixed, later[0], later[1]));
  std::mt19937_64 random(seed);
  Claims claims;
  const auto count = [](const SolidTree& solid) {
    std::vector<std::size_t> counts(solid.tree.nodes.size(), 0);
    for (std::uint32_t n = 0; n < counts.size(); ++n)
      if (solid.tree.nodes[n].leaf())
        for (std::uint32_t up = n; up != ObbNode::kNone; up = solid.tree.nodes[up].parent) ++counts[up];
    return counts;
  };
  const std::vector<std::size_t> of_moving = count(moving), of_fixed = count(fixed);
  // Claims for large and small nodes; nodes that are far apart test little.
  for (int trial = 0; trial < 30000 && claims.found < 60; ++trial) {
    const auto m = static_cast<std::uint32_t>(random() % moving.tree.nodes.size());
    const auto f = static_cast<std::uint32_t>(random() % fixed.tree.nodes.size());
    const ThreadSweep::Gap claimed = sweep.gap(m, f);
    if (!(claimed.during > 0) || of_moving[m] * of_fixed[f] > 3000) continue;
    const double gap = min_distance(moving, m, fixed, f, first[0], first[1]);
    EXPECT_GE(gap, claimed.during - 1e-6) << m << ' ' << f;
    claims.found += gap < 1;
    const double kept = next.kept_gap(static_cast<float>(claimed.in_place), static_cast<float>(sweep.phase()));
    if (!(kept > 0) || !next.useful()) continue;
    const double later_gap = min_distance(moving, m, fixed, f, later[0], later[1]);
    EXPECT_GE(later_gap, kept - 1e-6) << m << ' ' << f;
    claims.kept += later_gap < 1;
  }
  return claims;
}

TEST(ThreadSweep, NeverClaimsMoreThanTheGapOfTriangles) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 6; ++trial) {
    const Pose frame = scenes::random_pose(random, trial < 3 ? 0 : 100, 3);
    const Bolted pair(trial % 2 == 0 ? 0.05 : 0.15, 20, frame);
    const auto nearly = [&](double angle) {
      return frame * (scenes::random_pose(random, 0.01, 0.002) * scenes::unscrewed(angle)) * inverse(frame);
    };
    const Pose motion[] = {nearly(0.1), nearly(0.1 + 0.3 * trial)}, back[] = {inverse(motion[0]), inverse(motion[1])};
    // Some turns further on, and shifted along the axis besides.
    const double turned = static_cast<double>(random() % 1000) / 100, shift = 0.02 * (trial % 3);
    const auto shifted = [&](double angle) {
      return frame * (Pose{{0, 0, shift}, {}} * inverse(frame) * nearly(angle));
    };
    const Pose later[] = {shifted(turned), shifted(turned + 0.2)},
               later_back[] = {inverse(later[0]), inverse(later[1])};
    const Claims of_bolt = expect_true(pair.bolt(), pair.nut(), motion, later, random()),
                 of_nut = expect_true(pair.nut(), pair.bolt(), back, later_back, random());
    EXPECT_GT(of_bolt.found, 20) << trial;
    EXPECT_GT(of_nut.found, 20) << trial;
    EXPECT_GT(of_bolt.kept + of_nut.kept, 10) << trial;
  }
}

TEST(ThreadSweep, SeparatesTheFlanksOfAWholeBoltFromThoseOfItsNut) {
  const Bolted pair(0.05, 64);
  for (const bool nut_moves : {false, true}) {
    const SolidTree &moving = nut_moves ? pair.nut() : pair.bolt(), &fixed = nut_moves ? pair.bolt() : pair.nut();
    const std::vector<ThreadMatch> matches =
        match_threads(*pair.bolt().revolution, pair.bolt().tree.origin, *pair.nut().revolution, pair.nut().tree.origin);
    ASSERT_EQ(matches.size(), 1u);
    const Pose out = scenes::unscrewed(2.5), end = nut_moves ? inverse(out) : out;
    const ThreadSweep sweep(matches[0], nut_moves ? 1 : 0, motion_of(moving, fixed, {}, end));
    ASSERT_TRUE(sweep.useful());
    // The largest node of each part of a profile; the first of each component is not thread.
    const auto part_roots = [](const SolidTree& solid) {
      const std::vector<std::uint8_t> parts = thread_parts(solid.vertices, solid.faces, solid.revolution->threads());
      std::vector<std::uint32_t> roots;
      std::vector<std::set<std::uint8_t>> under(solid.tree.nodes.size());
      for (std::uint32_t n = 0; n < solid.tree.nodes.size(); ++n)
        if (solid.tree.nodes[n].leaf())
          for (std::uint32_t up = n; up != ObbNode::kNone; up = solid.tree.nodes[up].parent)
            under[up].insert(parts[solid.tree.nodes[n].child]);
      for (std::uint32_t n = 1; n < solid.tree.nodes.size(); ++n)
        if (under[n].size() == 1 && *under[n].begin() > 0 && under[solid.tree.nodes[n].parent].size() > 1)
          roots.push_back(n);
      return roots;
    };
    const std::vector<std::uint32_t> of_moving = part_roots(moving), of_fixed = part_roots(fixed);
    ASSERT_EQ(part_roots(pair.bolt()).size(), 4u);
    int parted = 0;
    for (const std::uint32_t m : of_moving)
      for (const std::uint32_t f : of_fixed) {
        // The nut's ends follow the helix and are flanks too, but other turns pass them.
        const ThreadMatch::Side &own = matches[0].sides[nut_moves ? 1 : 0],
                                &other = matches[0].sides[nut_moves ? 0 : 1];
        if (own.nodes[m].max_radius > 5 || other.nodes[f].max_radius > 5) continue;
        EXPECT_GT(sweep.gap(m, f).during, 0.01) << m << ' ' << f;
        ++parted;
      }
    EXPECT_GE(parted, 16);
  }
}

TEST(ThreadSweep, KeepsNothingWhereNoNodeIsBounded) {
  const Bolted pair(0.05, 24);
  std::vector<ThreadMatch> matches =
      match_threads(*pair.bolt().revolution, pair.bolt().tree.origin, *pair.nut().revolution, pair.nut().tree.origin);
  ASSERT_EQ(matches.size(), 1u);
  // Faces around the axis cannot be bounded.
  const Body block(scenes::box({-2, -2, -2}, {2, 2, 2}));
  matches[0].sides[0].nodes =
      ThreadBoundsList(matches[0].frame, block.solid.vertices, block.solid.faces, block.solid.tree.nodes);
  const ThreadSweep sweep(matches[0], 0, motion_of(pair.bolt(), pair.nut(), {}, scenes::unscrewed(0.5)));
  ASSERT_TRUE(sweep.useful());
  EXPECT_EQ(sweep.kept_gap(1, static_cast<float>(sweep.phase())), -std::numeric_limits<double>::infinity());
}

TEST(ThreadSweep, ClaimsNothingForStraightPullsAndTilts) {
  const Bolted pair(0.05, 64);
  const std::vector<ThreadMatch> matches =
      match_threads(*pair.bolt().revolution, pair.bolt().tree.origin, *pair.nut().revolution, pair.nut().tree.origin);
  ASSERT_EQ(matches.size(), 1u);
  const Pose pulled{{0, 0, 2}, {}}, tilted{{}, quat_about({1, 0, 0}, 0.1)}, aside{{1, 0, 0}, {}};
  EXPECT_FALSE(ThreadSweep(matches[0], 0, motion_of(pair.bolt(), pair.nut(), {}, pulled)).useful());
  EXPECT_FALSE(ThreadSweep(matches[0], 0, motion_of(pair.bolt(), pair.nut(), tilted, tilted)).useful());
  EXPECT_FALSE(ThreadSweep(matches[0], 0, motion_of(pair.bolt(), pair.nut(), aside, aside)).useful());
}

TEST(MatchThreads, FindsMatingThreads) {
  const Bolted pair(0.05, 24);
  const auto matches = [](const SolidTree& a, const SolidTree& b) {
    return match_threads(*a.revolution, a.tree.origin, *b.revolution, b.tree.origin).size();
  };
  EXPECT_EQ(matches(pair.bolt(), pair.nut()), 1u);
  EXPECT_EQ(matches(pair.bolt(), pair.bolt()), 0u) << "two outer threads";
  scenes::Winding finer = winding(0.1, 24, 3);
  finer.pitch = 1;
  for (scenes::ProfilePoint& p : finer.profile) p.y *= 0.8;
  const Body other(scenes::wound_hole(finer, 7)), plain(scenes::tube(7, 4.1, 0, 4, 24, 3));
  EXPECT_EQ(matches(pair.bolt(), other.solid), 0u) << "another lead";
  EXPECT_EQ(matches(pair.bolt(), plain.solid), 0u);
}

}  // namespace
}  // namespace dismantle
