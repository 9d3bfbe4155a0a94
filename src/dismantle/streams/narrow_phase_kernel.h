// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/engine/pair_rules.h"
#include "dismantle/geometry/kdop.h"
#include "dismantle/geometry/triangle_mesh.h"
#include "dismantle/narrowphase/ccd_triangle_triangle.h"
#include "dismantle/narrowphase/elementary_triangle_triangle.h"
#include "dismantle/narrowphase/intersect_triangle_triangle.h"
#include "dismantle/streams/bvtt_front_kernel.h"
#include "dismantle/streams/sweep_engine.h"
#include "dismantle/surface/moving_surface.h"

namespace dismantle {

/// A triangle pair of S_t that blocks the motion, as kernels report it.
struct TrianglePairContact {
  std::uint64_t key = 0;  ///< pair_key of the two leaves.
  double toi = 0;         ///< As BlockingPair::toi.
  friend bool operator==(const TrianglePairContact&, const TrianglePairContact&) = default;
};

/// The part of a linear motion between two of its times.
DISMANTLE_HOST_DEVICE inline TriangleMotion part_of(const TriangleMotion& motion, double begin, double end) {
  TriangleMotion part = motion;
  for (int k = 0; k < 3; ++k) {
    if (begin > 0) part.t0[k] = (1 - begin) * motion.t0[k] + begin * motion.t1[k];
    if (end < 1) part.t1[k] = (1 - end) * motion.t0[k] + end * motion.t1[k];
  }
  return part;
}

/// The ghost surfaces of a step (docs/design/0012-ghost-surfaces.md): they move with their components.
struct GhostTriangles {
  Span<const Vec3> displaced;        ///< GhostVertices::displaced [mm, assembled].
  Span<const float> margins;         ///< GhostVertices::margins, shape [leaf_count] [mm].
  Span<const RigidTransform> start;  ///< World from assembled at the start of the step, shape [component_count].
  Span<const RigidTransform> end;    ///< At its end.

  /// The ghost of a triangle during the step.
  /// @param face its vertices
  /// @param slot PairRule::ghost_a or ghost_b
  DISMANTLE_HOST_DEVICE TriangleMotion motion(const Face& face, std::uint32_t component, std::uint32_t slot) const {
    TriangleMotion m;
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = displaced[face.v[k] + slot];
      m.t0[k] = start[component] * p;
      m.t1[k] = end[component] * p;
    }
    return m;
  }
  /// By how much the bounds of two leaves may overlap while their ghosts are certainly apart from the triangles [mm].
  DISMANTLE_HOST_DEVICE double play(NodePair p) const {
    return margins[p.a] < margins[p.b] ? margins[p.a] : margins[p.b];
  }
};

/// A triangle and its ghost, both moving.
struct GhostMotion {
  TriangleMotion triangle;  ///< The triangle.
  TriangleMotion ghost;     ///< Its ghost.
};

/// The certified test of two triangles: the ghost of neither may meet the other one, touching included.
/// Free is certain; the time of contact is early rather than late.
DISMANTLE_HOST_DEVICE inline CcdResult ccd_with_ghosts(const GhostMotion& a, const GhostMotion& b) {
  const CcdResult first = ccd_triangle_triangle(a.ghost, b.triangle, 0);
  const CcdResult second = ccd_triangle_triangle(a.triangle, b.ghost, 0);
  if (first.status == CcdStatus::Contact && (second.status == CcdStatus::Free || first.toi < second.toi)) return first;
  return second;
}

/// Shortens a length by a relative 1e-6 before it is compared in float32: more than the rounding of a difference of
/// bounds.
inline constexpr double kPlayRounding = 1 - 1e-6;

/// True if an axis shows that two bounds certainly overlap by less than `length` [mm].
DISMANTLE_HOST_DEVICE inline bool overlap_by_less(const Kdop16& a, const Kdop16& b, double length) {
  // A length along a diagonal axis is sqrt(2) times as long in the axis's own measure; 1.4 is less.
  const float straight = static_cast<float>(length * kPlayRounding);
  const float diagonal = 1.4f * straight;
  int apart = 0;
  for (int k = 0; k < Kdop16::kAxisCount; ++k) {
    const float overlap = k < 3 ? straight : diagonal;
    apart |= (a.upper[k] - b.lower[k] < overlap) | (b.upper[k] - a.lower[k] < overlap);
  }
  return apart != 0;
}

/// The end of the round of the narrow phase that begins at triangle pair `begin`. S_t is tested in rounds, so that
/// later rounds can omit the time after the first contacts. The first one fills a GPU.
DISMANTLE_HOST_DEVICE inline std::size_t narrow_phase_round_end(std::size_t begin) {
  constexpr std::size_t kFirstRound = 16'384, kRoundGrowth = 4;
  return begin + (kRoundGrowth * begin > kFirstRound ? kRoundGrowth * begin : kFirstRound);
}

/// The time of the step after which contacts do not matter, if the first known one is at time `first`.
DISMANTLE_HOST_DEVICE inline double horizon_after(double first) {
  const double last = first + kContactWindow;
  return last < 1 ? last : 1;
}

/// The cull before the elementary tests of a triangle pair; it does not change their results.
enum class PairCull : std::uint8_t {
  None,            ///< Only each feature pair's own non-penetration filter.
  SeparatingAxis,  ///< One axis for all of them: elementary_apart.
};

/// The tests of the narrow phase, for sets of them: a GPU runs one kernel for each, as the largest one's registers
/// would slow the others down.
enum NarrowTests : unsigned {
  kDiscreteTest = 1,    ///< TID, of S_i.
  kElementaryTest = 2,  ///< With cubic roots, as in the paper.
  kCertifiedTest = 4,   ///< With ghost surfaces.
  kAllTests = 7,
};

/// S_t -> contacts and intersections (Du et al. 2015, algorithm 1, lines 6 to 14): TID for pairs of S_i, a continuous
/// test for all others.
/// The sink receives the output:
///   sink.contact({key, toi})   the pair blocks the motion
///   sink.intersection(key)     a pair of S_i that intersects at the end of the step
///   sink.tested(count)         elementary tests, or certified tests of a pair, that the filters left
struct NarrowPhaseKernel {
  Span<const std::uint64_t> pairs;                  ///< S_t
  StepTriangles triangles;                          ///< At the start and the end of the step.
  GhostTriangles ghosts;                            ///< Of the same triangles.
  Span<const Kdop16> bounds;                        ///< Of the whole step, shape [node_count] [mm, world].
  Span<const std::uint32_t> component_of;           ///< Shape [leaf_count].
  Span<const std::uint8_t> features;                ///< Features that each leaf represents, shape [leaf_count].
  PairRulesView rules;                              ///< The rules of the component pairs.
  ElementaryTest test = ElementaryTest::Certified;  ///< Test of pairs with PairTest::Ordinary.
  double horizon = 1;                               ///< Time of the step at which certified tests end.
  PairCull cull = PairCull::SeparatingAxis;         ///< Cull before elementary tests.

  /// Tests triangle pair i.
  template <class Sink>
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i, Sink& sink) const {
    run<kAllTests>(i, horizon, sink);
  }

  /// Tests triangle pair i, if its test is one of `kTests` (NarrowTests).
  /// @param last as `horizon`
  template <unsigned kTests, class Sink>
  DISMANTLE_HOST_DEVICE void run(std::size_t i, double last, Sink& sink) const {
    const NodePair p = pair_of_key(pairs[i]);
    const PairRule rule = rules.find(component_of[p.a], component_of[p.b]);
    if (rule.test == PairTest::None) return;
    if (rule.test == PairTest::Discrete) {
      if constexpr ((kTests & kDiscreteTest) != 0)
        if (intersect_triangle_triangle(triangles.end(p.a), triangles.end(p.b))) sink.intersection(pairs[i]);
    } else if (rule.test == PairTest::Ordinary && test == ElementaryTest::Elementary) {
      if constexpr ((kTests & kElementaryTest) != 0) elementary(i, p, sink);
    } else if constexpr ((kTests & kCertifiedTest) != 0) {
      if (overlap_by_less(bounds[p.a], bounds[p.b], ghosts.play(p))) return;
      sink.tested(1);
      const CcdResult ccd = certified(p, rule, 0, last);
      if (ccd.status == CcdStatus::Contact) sink.contact({pairs[i], last * ccd.toi});
    }
  }

  /// The certified test of two leaves on a part of the step, whatever their rule's test. Times are shares of the part.
  DISMANTLE_HOST_DEVICE CcdResult certified(NodePair p, const PairRule& rule, double begin, double end) const {
    return ccd_with_ghosts(part_of_motion(p.a, rule.ghost_a, begin, end),
                           part_of_motion(p.b, rule.ghost_b, begin, end));
  }

 private:
  DISMANTLE_HOST_DEVICE GhostMotion part_of_motion(NodeIndex leaf, std::uint32_t slot, double begin, double end) const {
    return {part_of(triangles.motion(leaf), begin, end),
            part_of(ghosts.motion(triangles.faces[leaf], component_of[leaf], slot), begin, end)};
  }

  template <class Sink>
  DISMANTLE_HOST_DEVICE void elementary(std::size_t i, NodePair p, Sink& sink) const {
    const TriangleMotion a = triangles.motion(p.a), b = triangles.motion(p.b);
    if (cull == PairCull::SeparatingAxis && elementary_apart(a, b)) return;
    const ElementaryPairResult found = elementary_triangle_triangle({a, features[p.a]}, {b, features[p.b]});
    sink.tested(static_cast<std::size_t>(found.elementary_tests));
    if (found.ccd.status == CcdStatus::Contact) sink.contact({pairs[i], found.ccd.toi});
  }
};

}  // namespace dismantle
