// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/collision/solid_tree.h"
#include "dismantle/front/certificate_front.h"
#include "dismantle/math/screw.h"
#include "dismantle/narrowphase/ccd_triangle_triangle.h"

#include <vector>

namespace dismantle {

/// How far the linear vertex paths that decide a triangle pair may be from the true screw, as a share of the tolerance:
/// longer motions are cut. The share is taken off every allowance whatever the motion, so that a state reached by a
/// translation is not too deep for a rotation.
inline constexpr double kArcShare = 0.125;

/// Where two triangles are stopped.
struct LeafContact {
  std::uint32_t face_moving = 0, face_fixed = 0;
  double toi = 0;  ///< They are certainly allowed on [0, toi].
  Vec3 axis;  ///< Unit, from the moving to the fixed one [frame of the fixed component]; zero where none parts them.
};

/// What decides whether two triangles may go on.
struct LeafRules {
  double allowed = 0;    ///< How deep triangles may be in each other [mm].
  double tolerance = 0;  ///< [mm]
  SideRule sides = SideRule::Memory;
  AdvancementLimits limits;
  bool tells_harmless = true;  ///< Whether it is worth the time to find what Result::harmless tells.
};

/// The sweep of one moving component past one fixed component along a screw, seen from the fixed one: tests pairs of
/// their triangles on the chords of the true arcs, and takes the arcs' deviation off the allowance.
class LeafSweep {
 public:
  /// @param start, end poses of the moving component in the fixed one's frame; the motion is the one screw between
  /// @param deviation upper bound of the distance of any arc of the moving component from its chord [mm]; what is more
  /// than kArcShare of the tolerance costs allowance that may be in use already
  /// @pre deviation is less than the allowance
  LeafSweep(const SolidTree& moving, const SolidTree& fixed, const Pose& start, const Pose& end, double deviation,
            const LeafRules& rules);

  /// As the front takes it.
  PairMotion motion() const;

  struct Result {
    bool free = true;
    double gap = 0;         ///< Lower bound of their distance during the whole motion, by the axis [mm].
    bool harmless = false;  ///< They do not meet at all but for the arcs, or face on face: closed solids only.
    LeafContact contact;    ///< The axis is given also where free.
  };
  /// Guarantee: see ccd_triangle_triangle; for the screw itself.
  /// @param horizon looks no further into the motion than this time: free is free until then
  Result test(std::uint32_t face_moving, std::uint32_t face_fixed, Vec3 hint, double horizon = 1) const;

  /// What the axis of a test proves of the two triangles, for the front. @param sweep of this motion
  Certificate certificate(const Result& found, const LinearSweep& sweep) const;

 private:
  /// The triangles as the motion begins.
  struct Pair {
    std::uint32_t face_moving, face_fixed;
    Triangle moving, fixed;
  };
  /// Whether the two are apart throughout, beginning with the axis, which becomes the one that parts them at the end.
  bool never_meet(std::uint32_t face_moving, std::uint32_t face_fixed, Vec3& axis) const;
  double least_gap(std::uint32_t face_moving, std::uint32_t face_fixed, Vec3 axis) const;
  /// Fills in the normals around both faces, the moving one's turned by `rotation`.
  struct Around;
  OutwardNormals normals_of(const Pair& pair, const Mat3& rotation, Around& around) const;
  bool still_parts(const TriangleMotion& moving, const Pair& pair, Vec3 axis) const;
  /// An axis from the moving triangle to the fixed one, where each knows no side of the other: as they are apart, or as
  /// their normals say where they touch; zero where neither tells.
  Vec3 side_of(const Triangle& moving, const Triangle& fixed) const;
  AxisCcdResult test_chords(const TriangleMotion& moving, const Pair& pair, Vec3 hint) const;

  const SolidTree* moving_;
  const SolidTree* fixed_;
  RigidTransform start_, end_;
  Mat3 middle_;
  Pose start_pose_, end_pose_;
  double deviation_, share_, allowed_;
  LeafRules rules_;
};

}  // namespace dismantle
