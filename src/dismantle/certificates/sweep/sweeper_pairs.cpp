// SPDX-License-Identifier: Apache-2.0
// Sweeps of single pairs of triangles.
#include "dismantle/certificates/sweep/certificate_sweeper.h"
#include "dismantle/certificates/sweep/sweep_tasks.h"

#include <algorithm>
#include <optional>

namespace dismantle {

namespace {

/// Limits of SweepBudget::Bounded: the steps of a test, and its smallest step as a share of the tolerance [of path
/// length].
constexpr int kBoundedSteps = 6;
constexpr double kBoundedShare = 1e-2;

}  // namespace

TrianglePairSweep CertificateSweeper::triangle_pair_sweep(const TestedPair& pair, const ScrewMotion& motion,
                                                          SweepBudget budget) const {
  const Pose& frame = poses_[pair.fixed.value];
  AdvancementLimits limits;
  if (budget == SweepBudget::Bounded || budget == SweepBudget::WholeCylinders) {
    limits.steps = kBoundedSteps;
    limits.min_progress = std::max(limits.min_progress, kBoundedShare * tolerance() / motion.path_length);
  }
  return TrianglePairSweep(moving_surface(pair), fixed_surface(pair), seen_from(frame, motion.start),
                           seen_from(frame, motion.end), motion.deviation, tolerance(), limits);
}

TrianglePairResult CertificateSweeper::sweep_pair(const SweepContact& pair, const ScrewMotion& motion) const {
  return triangle_pair_sweep(pair.tested(), motion, SweepBudget::Bounded)
      .test(pair.face_moving.value, pair.face_fixed.value, pair.axis);
}

CertificateSweep CertificateSweeper::sweep_pairs(Span<const SweepContact> pairs, const ScrewMotion& motion,
                                                 double window) const {
  CertificateSweep result;
  std::optional<TrianglePairSweep> triangle_pairs;
  const SweepContact* last = nullptr;
  for (const SweepContact& pair : pairs) {
    if (pair.surfaces == SurfacePair::Plain) continue;
    if (!last || last->moving != pair.moving || last->fixed != pair.fixed || last->surfaces != pair.surfaces)
      triangle_pairs.emplace(triangle_pair_sweep(pair.tested(), motion, SweepBudget::Exhaustive));
    last = &pair;
    const TrianglePairResult found = triangle_pairs->test(pair.face_moving.value, pair.face_fixed.value, pair.axis);
    ++result.triangle_tests;
    if (found.free) continue;
    result.blocked.push_back(pair);
    result.blocked.back().toi = found.contact.toi;
    result.blocked.back().axis = found.contact.axis;
  }
  finish(result, window);
  return result;
}

}  // namespace dismantle
