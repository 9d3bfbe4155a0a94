// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/assembly/path.h"
#include "dismantle/core/span.h"
#include "dismantle/engine/contact.h"
#include "dismantle/engine/step_cost.h"

#include <vector>

namespace dismantle {

/// The result and the cost of one step towards a target.
struct StepResult {
  Pose pose;             ///< Pose of the moving set after the step.
  bool reached = false;  ///< `pose` is the target.
  /// The poses that the set went through, each by one screw from the one before (the first from the pose before the
  /// step); the last is `pose`. Empty if the set did not move.
  std::vector<Pose> poses;
  std::vector<BlockingPair> blocking_pairs;  ///< The triangle pairs that stopped the motion; empty if reached.
  std::vector<ContactPoint> contact_points;  ///< The contacts at `pose`; empty for methods that do not compute them.
  int sweeps = 0;                            ///< Sweeps made: the motion is divided, and parts of it are retried.
  /// A lower bound of the distance at `pose` from the set to all that it may not overlap [mm]; 0 in contact, or if the
  /// method computes none.
  double clearance = 0;
  StepCost cost;  ///< Time and work of this step.
  /// It ended at a limit of its work: a step to the same target goes on, even where this one did not move the set.
  bool unfinished = false;
};

/// A collision method with its response, as the loop of a host program uses it (docs/design/0000-overview.md): grabs
/// components and moves them as one rigid body towards targets. All motion that it allows holds the guarantee of
/// docs/guarantee.md. Not for use by two threads at the same time; any number of engines may run side by side.
class MotionEngine {
 public:
  virtual ~MotionEngine() = default;

  /// Makes these components the moving set; those grabbed before are released.
  /// @pre not empty, no repeats, all at the same pose
  virtual void grab(Span<const ComponentId> components) = 0;
  /// The components grabbed; empty before the first grab(), and after a jump() that moved one of them.
  virtual Span<const ComponentId> moving_set() const = 0;
  /// Moves the moving set towards `target` as far as `response` allows.
  /// @pre the moving set is not empty; can_respond(response)
  virtual StepResult step(const Pose& target, ResponseKind response) = 0;
  /// True if step() implements this response.
  virtual bool can_respond(ResponseKind response) const = 0;

  /// Puts all components at `poses` without a test (undo, or a recorded state known to be free). Overlapping pairs
  /// that are apart there have the tolerance for their allowance from then on; those that overlap there have their own
  /// again. Releases the moving set if that changes the pose of one of it.
  /// @param poses shape [component_count]
  virtual void jump(Span<const Pose> poses) = 0;
  /// The pose of every component, shape [component_count].
  virtual Span<const Pose> poses() const = 0;
  /// The pairs with an allowance of their own that have not been apart yet.
  virtual std::vector<ComponentPair> overlapping_pairs() const = 0;
};

}  // namespace dismantle
