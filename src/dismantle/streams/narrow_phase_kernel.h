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

#include <optional>

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

/// Shortens an allowance by a relative 1e-6 before it is compared in float32: more than the rounding of a difference
/// of bounds.
inline constexpr double kAllowanceRounding = 1 - 1e-6;

/// True if an axis shows that two objects with these bounds are never deeper in each other than `allowed` [mm].
DISMANTLE_HOST_DEVICE inline bool within_allowance(const Kdop16& a, const Kdop16& b, double allowed) {
  // A depth along a diagonal axis is sqrt(2) times as long in the axis's own measure; 1.4 is less.
  const float straight = static_cast<float>(allowed * kAllowanceRounding);
  const float diagonal = 1.4f * straight;
  int apart = 0;
  for (int k = 0; k < Kdop16::kAxisCount; ++k) {
    const float depth = k < 3 ? straight : diagonal;
    apart |= (a.upper[k] - b.lower[k] < depth) | (b.upper[k] - a.lower[k] < depth);
  }
  return apart != 0;
}

/// The allowance on linear paths that keeps `allowed` on the true ones: reduced by the deviation of each moving
/// component [mm].
/// @param moving_components of the pair: 0, 1 or 2
DISMANTLE_HOST_DEVICE inline double allowed_on_chords(double allowed, double deviation, int moving_components) {
  const double left = allowed - moving_components * deviation;
  return left > 0 ? left : 0;
}

/// The end of the round of the narrow phase that begins at triangle pair `begin`. S_t is tested in rounds, so that
/// later rounds can omit the time after the first contacts.
DISMANTLE_HOST_DEVICE inline std::size_t narrow_phase_round_end(std::size_t begin) {
  constexpr std::size_t kFirstRound = 512, kRoundGrowth = 4;
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

/// S_t -> contacts and intersections (Du et al. 2015, algorithm 1, lines 6 to 14): TID for pairs of S_i, a continuous
/// test for all others.
/// The sink receives the output:
///   sink.contact({key, toi})   the pair blocks the motion
///   sink.intersection(key)     a pair of S_i that intersects at the end of the step
///   sink.tested(count)         elementary tests, or certified tests of a pair, that the filters left
struct NarrowPhaseKernel {
  Span<const std::uint64_t> pairs;                  ///< S_t
  StepTriangles triangles;                          ///< At the start and the end of the step.
  Span<const Kdop16> bounds;                        ///< Of the whole step, shape [node_count] [mm, world].
  Span<const std::uint32_t> component_of;           ///< Shape [leaf_count].
  Span<const std::uint8_t> features;                ///< Features that each leaf represents, shape [leaf_count].
  Span<const std::uint32_t> motion_class;           ///< 0 for stationary components, shape [component_count].
  PairRulesView rules;                              ///< The rules of the component pairs.
  ElementaryTest test = ElementaryTest::Certified;  ///< Test of pairs with PairTest::Ordinary.
  double path_deviation = 0;                        ///< Maximum distance of true paths from linear ones [mm].
  double horizon = 1;                               ///< Time of the step at which certified tests end.
  PairCull cull = PairCull::SeparatingAxis;         ///< Cull before elementary tests.

  /// Tests triangle pair i.

  template <class Sink>
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i, Sink& sink) const {
    const NodePair p = pair_of_key(pairs[i]);
    const std::uint32_t a = component_of[p.a], b = component_of[p.b];
    const PairRule rule = rules.find(a, b);
    if (rule.test == PairTest::Discrete) {
      if (intersect_triangle_triangle(triangles.end(p.a), triangles.end(p.b))) sink.intersection(pairs[i]);
    } else if (rule.test == PairTest::Ordinary && test == ElementaryTest::Elementary) {
      elementary(i, p, sink);
    } else {
      const int moving = (motion_class[a] != 0) + (motion_class[b] != 0);
      const double allowed = allowed_on_chords(rule.allowed_penetration, path_deviation, moving);
      certified(i, p, allowed, sink);
    }
  }

 private:
  template <class Sink>
  DISMANTLE_HOST_DEVICE void certified(std::size_t i, NodePair p, double allowed, Sink& sink) const {
    if (within_allowance(bounds[p.a], bounds[p.b], allowed)) return;
    sink.tested(1);
    const CcdResult ccd = ccd_triangle_triangle(part_of(triangles.motion(p.a), 0, horizon),
                                                part_of(triangles.motion(p.b), 0, horizon), allowed);
    if (ccd.status == CcdStatus::Contact) sink.contact({pairs[i], horizon * ccd.toi});
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

/// Certified test of the triangle pairs of components that part within the step, over the rest of it. Item: a triangle
/// pair.
struct PartedPairKernel {
  Span<const std::uint64_t> pairs;  ///< Keys of leaf pairs.
  StepTriangles triangles;          ///< At the start and the end of the step.
  double from = 0;                  ///< Time of the step at which the components part.
  double allowed = 0;               ///< Allowed penetration on linear paths [mm].

  /// The contact of triangle pair i, if there is one.

  DISMANTLE_HOST_DEVICE std::optional<TrianglePairContact> operator()(std::size_t i) const {
    const NodePair p = pair_of_key(pairs[i]);
    const CcdResult ccd = ccd_triangle_triangle(part_of(triangles.motion(p.a), from, 1),
                                                part_of(triangles.motion(p.b), from, 1), allowed);
    if (ccd.status == CcdStatus::Free) return {};
    return TrianglePairContact{pairs[i], from + (1 - from) * ccd.toi};
  }
};

}  // namespace dismantle
