// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/core/span.h"
#include "dismantle/engine/contact.h"
#include "dismantle/exec/append_buffer.h"
#include "dismantle/exec/executor.h"
#include "dismantle/math/rigid_transform.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace dismantle {

/// The continuous test for triangle pairs of components that are apart in the assembled state.
enum class ElementaryTest {
  Certified,   ///< ccd_triangle_triangle with ghost surfaces: no miss (docs/guarantee.md).
  Elementary,  ///< The paper's 6 VF + 9 EE cubic tests, no penetration allowed. Pairs that touch or overlap in the
               ///< assembled state need an allowance and are tested with Certified all the same.
};

/// Wall times of the stages of a sweep, as in Table 1 of Du et al. 2015 [ms].
struct StageTimings {
  double vertices = 0;      ///< S_tm -> S_v
  double refit = 0;         ///< S_v -> S_bv, S_bvh
  double front = 0;         ///< S_bvh -> S_f, S_t
  double intersection = 0;  ///< S_t -> results: TID and CCD
  double overall = 0;       ///< The whole sweep.
};

/// Sizes of the streams of a sweep.
struct StreamSizes {
  std::size_t front = 0;               ///< S_f
  std::size_t triangle_pairs = 0;      ///< S_t
  std::size_t intersection_pairs = 0;  ///< S_i: component pairs.
  std::size_t elementary_tests = 0;    ///< VF and EE tests, or certified triangle-pair tests, left by the filters.
  std::size_t replays = 0;             ///< Stages repeated because a buffer was full.
};

/// The result of one sweep.
struct SweepResult {
  double toi = 1;    ///< The smallest toi of all blocking pairs; 1 if the whole motion is free.
  bool free = true;  ///< Nothing blocks the motion.
  /// Every triangle pair whose own toi is within kContactWindow of the smallest, ordered by (a, b, face_a, face_b).
  std::vector<BlockingPair> blocking_pairs;
  StageTimings timings;  ///< Cost of the stages.
  StreamSizes sizes;     ///< Amount of work.
};

/// Options of SweepEngines.
struct CollisionOptions {
  ElementaryTest test = ElementaryTest::Certified;  ///< Test of pairs that are apart in the assembled state.
  Executor executor;                                ///< Threads; the results do not depend on them.
  std::size_t initial_capacity = 1 << 16;      ///< Of every append buffer; they grow as needed. Tests start from 1.
  AppendLock append_lock = AppendLock::Local;  ///< Of `streams` on the CPU; for comparisons.
};

/// A collision method that sweeps the whole assembly (docs/design/0000-overview.md) from its current state to candidate
/// next states, with linear vertex paths. The results do not depend on the executor, the number of threads and the
/// initial capacity.
class SweepEngine {
 public:
  virtual ~SweepEngine() = default;

  /// Tests the motion from the current state to `next`; the state does not change.
  /// @param next one transform a component: x_next = next[c] * x_assembled
  /// @param path_deviation maximum distance of a vertex's true path from the linear one [mm]. Displacements of ghost
  ///        surfaces leave kArcShare of the tolerance for it: a free sweep holds for the true path where only one of
  ///        two components moves. @pre at most half the tolerance
  virtual SweepResult sweep(Span<const RigidTransform> next, double path_deviation) = 0;
  /// Makes the `next` of the last sweep the current state. @pre that sweep was free
  virtual void commit() = 0;
  /// Sets the current state without a test (undo, or a recorded state known to be free), one transform a component.
  /// Free pairs that are apart there leave the intersection stream for good; other overlapping pairs have the tolerance
  /// for their allowance if they are apart there, and else their own.
  virtual void jump(Span<const RigidTransform> state) = 0;

  /// The current state, one transform a component.
  virtual Span<const RigidTransform> state() const = 0;
  /// The pairs with an allowance of their own that have not been apart yet, the free ones (S_i) included.
  virtual std::vector<ComponentPair> overlapping_pairs() const = 0;
};

/// Makes the paper's method (docs/design/0004-streams.md) on the threads of the options' executor, with all components
/// in the assembled state.
std::unique_ptr<SweepEngine> make_streams_engine(const Assembly& assembly, const PairStates& pairs,
                                                 const CollisionOptions& options);

}  // namespace dismantle
