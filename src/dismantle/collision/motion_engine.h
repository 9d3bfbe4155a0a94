// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "dismantle/collision/collision_engine.h"

#include <memory>
#include <vector>

namespace dismantle {

/// Where the set in hand touches the rest, and how.
struct ContactPoint {
  ComponentId moving, fixed;       ///< Of the set in hand, and of the rest.
  FaceId face_moving, face_fixed;  ///< Of the components' own meshes.
  Vec3 point;                      ///< On the moving face [mm, world].
  Vec3 normal;                     ///< Unit, from the fixed component to the moving one [world].
  double gap = 0;                  ///< Along the normal [mm]; below 0 where the faces are in each other.
  friend bool operator==(const ContactPoint&, const ContactPoint&) = default;
};

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

/// A collision method with its response, as the loop of a host program sees it (DESIGN sections 2 and 6): takes
/// components in hand and moves them as one rigid body towards targets. Everything it lets happen holds the guarantee
/// of DESIGN section 3. Not for use by two threads at the same time; any number of engines may run side by side.
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

/// A collision method as the loop of a host program sees it, with responses Stop and Touch. The assembly must outlive
/// the engine. @pre `engine` is of this assembly, all components in the assembled state; tolerance > 0 [mm]
std::unique_ptr<MotionEngine> make_sweeping_motion_engine(const Assembly& assembly, double tolerance,
                                                          std::unique_ptr<CollisionEngine> engine);

/// `streams` (DESIGN section 2.1) with responses Stop and Touch, all components in the assembled state. The assembly
/// must outlive the engine.
std::unique_ptr<MotionEngine> make_streams_motion_engine(const Assembly& assembly, const PairStates& pairs,
                                                         const CollisionOptions& options);

}  // namespace dismantle
