// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/device/front_device.h"
#include "dismantle/core/keep_going.h"
#include "dismantle/engine/motion_engine.h"
#include "dismantle/exec/cuda_device.h"
#include "dismantle/math/lane_dispatch.h"

#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace dismantle {

/// The smallest distance between the moving set and all other components, and where it is.
struct Clearance {
  double distance = 0;  ///< [mm]; 0 if surfaces meet, infinite if nothing is near enough.
  ComponentId moving;   ///< The component of the moving set.
  ComponentId fixed;    ///< The other component.
  FaceId face_moving;   ///< Face of the moving component's mesh.
  FaceId face_fixed;    ///< Face of the fixed component's mesh.
  Vec3 point_moving;    ///< Nearest point of the moving face [mm, world].
  Vec3 point_fixed;     ///< Nearest point of the fixed face [mm, world].
};

/// Which contact of a linear motion is sought.
enum class StraightSearch {
  Any,    ///< Any contact: decides if the motion is free.
  Quick,  ///< The same, but given up where depths are hard to bound (StraightContact::is_certain).
  /// The first contact or one soon after it, in less time: within some tolerances, but where depths are bounded.
  Near,
  First,  ///< The first contact.
};

/// The contact that blocks a linear motion of one component past another.
struct StraightContact {
  double distance = 0;  ///< With StraightSearch::First the motion is certainly free up to here [mm].
  FaceId face_moving;   ///< Face of the moving component's mesh.
  FaceId face_fixed;    ///< Face of the fixed component's mesh.
  Vec3 point;           ///< Where the two faces meet [mm, world].
  /// False where a search but Any was given up: the motion may be free.
  bool is_certain = true;
};

/// The trees, ghost surfaces and allowances that engines prepare for an assembly.
class AssemblySurfaces;

/// Options of the method `certificates`.
struct CertificateOptions {
  Executor executor;                 ///< Runs the parts of a sweep in parallel; the results do not depend on it.
  LaneCount lanes = widest_lanes();  ///< Lanes of the kernels; the results do not depend on it.
  /// May be empty. Once it returns false, the depth of pairs without ghosts counts as too deep where it is not known
  /// yet, and no more ghosts are searched for: what the engine says is still true, but says less.
  KeepGoing keep_going = {};
  /// Most points and pieces of surfaces that a step examines to bound the depth of pairs without ghosts, or 0 for no
  /// limit but that of a single sweep: the motion of a person's hand must go on. Once they are used up, each sweep
  /// still gets a few, and the step ends where it does not know. The next step continues; after many such steps in
  /// turn, what is not known counts as too deep.
  std::size_t depth_tests = 0;
  /// Maximum number of node pairs that the sweeps of a step examine, or 0 for no limit. Once it is reached, each sweep
  /// may still examine a few, and the step ends if its motion is not known to be free. The next step continues.
  std::size_t node_pairs = 0;
  /// Tests of triangle pairs and pieces of surfaces after which a step of response Slide ends early, at a pose that is
  /// free, or 0 for no limit. The next step continues. The limit does not apply to the first try of a step.
  std::size_t slide_tests = 0;
  /// Surfaces of another engine (CertificateEngine::surfaces()) to reuse, or null. Components with the same mesh in the
  /// same place, and pairs of them with the same state and allowances, are not prepared again. The results do not
  /// depend on it.
  std::shared_ptr<const AssemblySurfaces> prepared = {};
};

/// A device that evaluates fronts, and when it is used.
struct CertificateDevice {
  std::unique_ptr<FrontDevice> fronts;  ///< Null: everything is computed on the CPU.
  /// Set if the device fails (CudaError): the engine then goes on without it, with the same results. May be null.
  std::shared_ptr<DeviceFailure> failure;
};

/// The method `certificates` (docs/design/0006-certificates.md) with responses Stop, Touch and Slide: fronts of
/// separating certificates over static trees of oriented boxes. Components get no deeper into each other than their
/// allowance, and do not pass through each other (docs/guarantee.md). The same
/// input gives the same results with every executor, thread count, lane width and device.
class CertificateEngine final : public MotionEngine {
 public:
  /// All components in the assembled state.
  CertificateEngine(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options = {},
                    CertificateDevice device = {});
  ~CertificateEngine() override;
  ///@{ Movable.
  CertificateEngine(CertificateEngine&&) noexcept;
  CertificateEngine& operator=(CertificateEngine&&) noexcept;
  ///@}

  void grab(Span<const ComponentId> components) override;
  Span<const ComponentId> moving_set() const override;
  StepResult step(const Pose& target, ResponseKind response) override;
  bool can_respond(ResponseKind) const override { return true; }
  void jump(Span<const Pose> poses) override;
  Span<const Pose> poses() const override;
  std::vector<ComponentPair> overlapping_pairs() const override;

  /// The contacts of the moving set at its pose: all triangle pairs nearer than `reach` [mm], by components and faces.
  /// Empty without a moving set.
  std::vector<ContactPoint> contacts(double reach) const;
  /// The faces of one component at its pose, independent of the moving set, with all faces of others within `reach`
  /// [mm], by components and faces. Thread-safe.
  std::vector<NearFaces> near_faces(ComponentId component, double reach) const;
  /// The contact of two faces at the poses of their components. Thread-safe.
  ContactPoint contact(const NearFaces& faces) const;
  /// The exact distance from the moving set to everything that it may not overlap, if it is below `limit` [mm]; of
  /// components that are equally near, the first. Infinite without a moving set.
  Clearance clearance(double limit = std::numeric_limits<double>::infinity()) const;
  /// The first contact of the one screw from the pose of the moving set to `target`. Nothing moves. For many candidate
  /// motions from one state see MotionBatch. May be called by many threads at the same time. @pre the moving set is not
  /// empty
  FirstContact first_contact(const Pose& target) const;
  /// The first contact of each of some translations of the moving set [mm, world] from its pose, in a fraction of the
  /// time of first_contact(). The motion is certainly free up to toi; the first contact may be a few tolerances beyond.
  /// Nothing moves. @pre the moving set is not empty
  std::vector<FirstContact> straight_contacts(Span<const Vec3> displacements) const;
  /// The contact that blocks the translation of one component by `displacement` [mm] past one other, both in their
  /// assembled poses whatever was moved since; none if it is free. May be called by many threads at the same time.
  std::optional<StraightContact> straight_contact(ComponentId moving, ComponentId fixed, const Vec3& displacement,
                                                  StraightSearch search) const;
  /// The prepared surfaces, which other engines of this assembly or of a part of it can reuse.
  std::shared_ptr<const AssemblySurfaces> surfaces() const;
  /// Number of pairs of nodes of the fronts of the moving set.
  std::size_t front_size() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dismantle
