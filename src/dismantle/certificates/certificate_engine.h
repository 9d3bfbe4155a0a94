// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/device/front_device.h"
#include "dismantle/engine/motion_engine.h"
#include "dismantle/math/lane_dispatch.h"

#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace dismantle {

/// The least distance between the set in hand and the rest, and where it is.
struct Clearance {
  double distance = 0;             ///< [mm]; 0 where surfaces meet, infinite where nothing else is near enough.
  ComponentId moving, fixed;       ///< The two components.
  FaceId face_moving, face_fixed;  ///< Of the components' own meshes.
  Vec3 point_moving, point_fixed;  ///< [mm, world]
};

/// How far one candidate motion of a batch gets.
struct FirstContact {
  double toi = 1;  ///< The motion is certainly free on [0, toi]; 1 where all of it is.
  bool free = true;
  ComponentId moving, fixed;       ///< The earliest contact's components; of no meaning where free.
  FaceId face_moving, face_fixed;  ///< Its faces, of the components' own meshes.
  friend bool operator==(const FirstContact&, const FirstContact&) = default;
};

/// What is asked of a component's way straight past another.
enum class StraightSearch {
  Any,    ///< Whether anything blocks it: any contact will do.
  First,  ///< The first contact.
};

/// Where a component that goes straight is blocked by another one.
struct StraightContact {
  double distance = 0;             ///< It is certainly free so far, with StraightSearch::First [mm].
  FaceId face_moving, face_fixed;  ///< Of the components' own meshes.
  Vec3 point;                      ///< Where the two faces meet then [mm, world].
};

/// Options of the method `certificates`.
struct CertificateOptions {
  Executor executor;
  LaneCount lanes = widest_lanes();  ///< Same results for all.
};

/// A device that keeps copies of fronts, and when sweeps ask it.
struct CertificateDevice {
  std::unique_ptr<FrontDevice> fronts;  ///< None: all is computed on the CPU.
  std::size_t min_pairs = 0;            ///< Sweeps of fewer pairs of nodes do not ask it.
};

/// The method `certificates` (docs/design/0006-certificates.md) with responses Stop, Touch and Slide: a front of
/// separating certificates over static trees of oriented boxes. Same input, same results: for every executor, thread
/// count, lane width and device.
class CertificateEngine final : public MotionEngine {
 public:
  /// All components in the assembled state. `assembly` must outlive the engine.
  CertificateEngine(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options = {},
                    CertificateDevice device = {});
  ~CertificateEngine() override;
  CertificateEngine(CertificateEngine&&) noexcept;
  CertificateEngine& operator=(CertificateEngine&&) noexcept;

  void hold(Span<const ComponentId> components) override;
  StepResult step(const Pose& target, ResponseKind response) override;
  bool can_respond(ResponseKind) const override { return true; }
  void jump(Span<const Pose> poses) override;
  Span<const Pose> poses() const override;
  std::vector<ComponentPair> embedded_pairs() const override;

  /// What the set in hand touches where it is: the triangle pairs nearer than `reach` [mm]. Ordered by components and
  /// faces.
  std::vector<ContactPoint> contacts(double reach) const;
  /// The exact least distance from the set in hand to everything that it may not overlap, if it is below `limit` [mm];
  /// of components that are equally near the first.
  Clearance clearance(double limit = std::numeric_limits<double>::infinity()) const;
  /// The earliest contact of each candidate motion, one screw each from the present pose of the set in hand to
  /// `targets[i]`; embedded pairs are free all the way. Nothing moves. Candidates are looked at side by side.
  std::vector<FirstContact> first_contacts(Span<const Pose> targets) const;
  /// How far the set in hand can go straight on by each of `ways` [mm] from where it is, in a fraction of the time of
  /// first_contacts. All up to toi is certainly free; the first contact may be a few tolerances beyond. A pair that
  /// touches as it begins is looked at anew from where it would stop, up to a few times, so that a fit comes out.
  /// Nothing moves.
  std::vector<FirstContact> straight_contacts(Span<const Vec3> ways) const;
  /// What blocks one component on its way straight on by `way` [mm] past one other, both in their assembled poses and
  /// whatever was moved since; nothing where it is free, or the two are embedded. The vertices' rule of the guarantee
  /// is left to step(). May be asked by many threads at the same time.
  std::optional<StraightContact> straight_contact(ComponentId moving, ComponentId fixed, const Vec3& way,
                                                  StraightSearch search) const;
  /// How many pairs of nodes the fronts of the set in hand have.
  std::size_t front_size() const;

 private:
  class Body;
  std::unique_ptr<Body> body_;
};

}  // namespace dismantle
