// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/core/span.h"
#include "dismantle/exec/executor.h"
#include "dismantle/math/rigid_transform.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace dismantle {

/// Which continuous test decides a triangle pair of components that are ordinarily apart.
enum class ElementaryTest {
  Certified,   ///< ccd_triangle_triangle: no miss, with the pair's allowed penetration.
  Elementary,  ///< The paper's 6 VF + 9 EE cubic tests, no penetration allowed. Pairs in contact or fit need an
               ///< allowance and are tested with Certified all the same.
};

/// Wall time of the stages of one step [ms], as in the paper's Table 1.
struct StepTimings {
  double vertices = 0;      ///< S_tm -> S_v
  double refit = 0;         ///< S_v -> S_bv, S_bvh
  double front = 0;         ///< S_bvh -> S_f, S_t
  double intersection = 0;  ///< S_t -> results: TID and CCD
  double overall = 0;
};

/// Sizes of the streams of one step.
struct StreamSizes {
  std::size_t front = 0;               ///< S_f
  std::size_t triangle_pairs = 0;      ///< S_t
  std::size_t intersection_pairs = 0;  ///< S_i: component pairs
  std::size_t elementary_tests = 0;    ///< VF and EE tests, or certified triangle-pair tests, that the filters left
  std::size_t answered_tests = 0;      ///< Those of them that a device answered (method `certificates`)
  std::size_t replays = 0;             ///< Times that a stage ran again because its buffer was full
};

/// A triangle pair that stops the motion.
struct CollisionContact {
  ComponentId a, b;       ///< a < b
  FaceId face_a, face_b;  ///< Faces of the components' own meshes.
  double toi = 0;         ///< The motion is certainly free up to here (Elementary: up to the root found).
  friend bool operator==(const CollisionContact&, const CollisionContact&) = default;
};

/// A sweep reports the contacts of this part of the motion, from the first one on: what comes after it would not
/// happen.
inline constexpr double kContactWindow = 0x1p-10;

/// What one sweep found.
struct SweepResult {
  double toi = 1;  ///< The least toi of all contacts; 1 where the whole motion is free.
  bool free = true;
  /// Every triangle pair whose own toi is within kContactWindow of the least one, ordered by (a, b, face_a, face_b).
  std::vector<CollisionContact> contacts;
  StepTimings timings;
  StreamSizes sizes;
};

/// Options of every method.
struct CollisionOptions {
  ElementaryTest test = ElementaryTest::Certified;
  Executor executor;
  std::size_t initial_capacity = 1 << 16;  ///< Of every append buffer; they grow as needed. Tests start from 1.
};

/// A collision method (DESIGN section 2): holds the assembly's current state and sweeps it to candidate next states.
///   sweep(next)  tests the motion from the current state to `next`, linear vertex paths; the state stays as it is.
///   commit()     makes the `next` of the last sweep the current state. @pre that sweep was free
/// Same input, same results: for every executor, thread count and initial capacity.
class CollisionEngine {
 public:
  virtual ~CollisionEngine() = default;

  /// @param next one transform a component: x_next = next[c] * x_assembled
  /// @param path_deviation how far a vertex's true path may be from the linear one [mm]; it is taken off every allowed
  ///        penetration, so that Free holds for the true path. @pre less than half the tolerance
  virtual SweepResult sweep(Span<const RigidTransform> next, double path_deviation) = 0;
  virtual void commit() = 0;
  /// Puts all components at `state` without a test (undo, jump to a recorded state known to be free). Embedded pairs
  /// that are apart there leave the intersection stream.
  virtual void jump(Span<const RigidTransform> state) = 0;

  /// The current state, one transform a component.
  virtual Span<const RigidTransform> state() const = 0;
  /// The pairs that are still embedded: in the intersection stream S_i.
  virtual std::vector<ComponentPair> embedded_pairs() const = 0;
};

/// The paper's method (DESIGN section 2.1), all components in the assembled state.
std::unique_ptr<CollisionEngine> make_streams_engine(const Assembly& assembly, const PairStates& pairs,
                                                     const CollisionOptions& options);

}  // namespace dismantle
