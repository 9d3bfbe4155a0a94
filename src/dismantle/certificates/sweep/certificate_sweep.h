// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/certificates/front/radial_separation.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace dismantle {

/// The surfaces of a moving and a fixed component that are tested against each other
/// (docs/design/0012-ghost-surfaces.md).
enum class SurfacePair : std::uint8_t {
  Plain,        ///< Both as they are: for distances only.
  MovingGhost,  ///< The ghost of the moving component and the fixed one, without an allowance.
  FixedGhost,   ///< The moving component and the ghost of the fixed one, without an allowance.
  ///@{ The same with the mirrored ghosts of two sheets (SheetSides).
  MovingMirrored,
  FixedMirrored,
  ///@}
};

/// Two components and the surfaces by which a sweep tests them.
struct TestedPair {
  ComponentId moving;                         ///< The component that moves.
  ComponentId fixed;                          ///< The other component.
  SurfacePair surfaces = SurfacePair::Plain;  ///< Their surfaces.
};

/// A contact of two triangles that blocks a sweep: they would cross, or, of components without ghosts, a point of one
/// would get too deep behind the other (SurfacePair::Plain). The engine
/// reports it as a BlockingPair, which has no axis.
struct SweepContact {
  ComponentId moving;  ///< A component of the moving set.
  ComponentId fixed;   ///< The other component.
  FaceId face_moving;  ///< Face of the moving component's mesh.
  FaceId face_fixed;   ///< Face of the fixed component's mesh.
  double toi = 0;      ///< The pair certainly allows the motion on [0, toi].
  /// Unit, from the moving to the fixed triangle [assembled frame of the fixed component]; zero if no axis separates
  /// them.
  Vec3 axis;
  SurfacePair surfaces = SurfacePair::Plain;  ///< The surfaces that the two triangles are of.
  ///@{ SurfacePair::Plain: along the axis, the point of the moving component [mm, assembled] may go as far as the
  /// limit,
  /// which is fixed to the other one [mm, assembled].
  Vec3 point{}, limit{};
  ///@}

  /// The components and surfaces.
  TestedPair tested() const { return {moving, fixed, surfaces}; }
};

/// A cylinder of one component that is blocked by its bore in another, as one contact.
struct BlockedFit {
  ComponentId moving;                         ///< A component of the moving set.
  ComponentId fixed;                          ///< The other component.
  CylinderFit fit;                            ///< The cylinder and the bore.
  SurfacePair surfaces = SurfacePair::Plain;  ///< The surfaces that they are of.
};

/// Result of a sweep of the moving set.
struct CertificateSweep {
  double toi = 1;    ///< The motion is certainly free on [0, toi], if `complete`.
  bool free = true;  ///< Nothing blocks the motion.
  /// False if blocked pairs were left out: `toi` may then be too late, and `blocked` lacks some. A free sweep is always
  /// complete.
  bool complete = true;
  /// The limit of node pairs was reached, and the motion counts as blocked. The next sweep continues.
  bool cut = false;
  std::vector<SweepContact> blocked;  ///< Pairs blocked within the window after the first; by components and faces.
  std::vector<BlockedFit> fits;       ///< SweepBudget::WholeCylinders: blocked cylinders, taken as one contact each.
  double clearance = 0;               ///< Lower bound of all distances during the sweep [mm]; 0 if not free.
  std::size_t front = 0;              ///< Node pairs of the fronts used.
  std::size_t node_pairs = 0;         ///< Node pairs examined because they had no valid certificate.
  std::size_t triangle_tests = 0;     ///< Triangle-pair tests made.
  std::size_t device_tests = 0;       ///< Those of them that a device made.
  std::size_t depth_tests = 0;        ///< Points and pieces of surfaces examined to bound depths.
  /// The limit of CertificateOptions::depth_tests was reached before a depth was bounded: a later sweep goes on.
  bool undecided = false;
};

/// The amount of work that a sweep may do. All budgets are safe; smaller ones are faster, but may block earlier.
enum class SweepBudget {
  Exhaustive,      ///< Tests each triangle pair to its end, and finds all blocked pairs.
  Sampled,         ///< The same for a sample of the blocked pairs.
  Bounded,         ///< A sample; each test is limited in the number and the size of its steps.
  WholeCylinders,  ///< As Bounded; cylinders that are blocked by their bores are one contact each.
};

/// A translation of one component past another.
struct LinearMotion {
  ComponentId moving;  ///< The component that moves.
  ComponentId fixed;   ///< The component that it may meet.
  Vec3 displacement;   ///< [mm, world]
  Pose pose_moving;    ///< Pose of the moving component at the start.
  Pose pose_fixed;     ///< Pose of the fixed component.
};

}  // namespace dismantle
