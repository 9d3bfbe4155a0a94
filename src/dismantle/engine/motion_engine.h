// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/assembly/path.h"
#include "dismantle/core/span.h"
#include "dismantle/engine/contact.h"
#include "dismantle/engine/step_cost.h"

#include <memory>
#include <vector>

namespace dismantle {

/// How one step towards a target ended, and what it cost.
struct StepResult {
  Pose pose;             ///< Where the set really is now.
  bool reached = false;  ///< pose is the target.
  /// The poses that the set went through, each by one screw from the one before (the first from where it was); the
  /// last is `pose`. Empty where it did not move.
  std::vector<Pose> way;
  std::vector<CollisionContact> contacts;  ///< The triangle pairs that stopped the motion; empty where reached.
  std::vector<ContactPoint> touching;      ///< The same as points and normals at `pose`; methods that have none: empty.
  int sweeps = 0;                          ///< How many sweeps the motion was cut into, and the repeated ones.
  /// A lower bound of the distance from the set to all that it may not overlap, at `pose` [mm]; 0 in contact or where
  /// the method gives none.
  double clearance = 0;
  StepTimings timings;  ///< Summed over the sweeps.
  StreamSizes sizes;    ///< Of the last sweep; tests and replays summed.
};

/// A collision method with its response, as the loop of a host program sees it (docs/design/0000-overview.md): takes
/// components in hand and moves them as one rigid body towards targets. Everything it lets happen holds the guarantee
/// of docs/guarantee.md. Not for use by two threads at the same time; any number of engines may run side by side.
class MotionEngine {
 public:
  virtual ~MotionEngine() = default;

  /// Takes these components in hand, and lets go of all others.
  /// @pre not empty, no repeats, all at the same pose
  virtual void hold(Span<const ComponentId> components) = 0;
  /// Moves the set in hand towards `target` as far as `response` lets it. @pre something is in hand;
  /// can_respond(response)
  virtual StepResult step(const Pose& target, ResponseKind response) = 0;
  virtual bool can_respond(ResponseKind response) const = 0;

  /// Puts all components at `poses` without a test (undo, or a recorded state known to be free), one pose a component.
  /// Embedded pairs that are apart there are clear from then on. What is in hand stays so where its poses are still
  /// the same, else nothing is.
  virtual void jump(Span<const Pose> poses) = 0;
  /// Where every component is.
  virtual Span<const Pose> poses() const = 0;
  /// The pairs that are still embedded.
  virtual std::vector<ComponentPair> embedded_pairs() const = 0;
};

}  // namespace dismantle
