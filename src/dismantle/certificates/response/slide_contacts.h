// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/response/contact_patch.h"
#include "dismantle/certificates/sweep/certificate_sweeper.h"
#include "dismantle/math/nearest_twist.h"

#include <optional>
#include <vector>

namespace dismantle {

/// The contacts that bound the twist of the moving set during one step of response Slide
/// (docs/design/0006-certificates.md; Ortega, Redon, Coquillart 2007): pairs of triangles, each with the axis that last
/// let the wanted motion go furthest.
class SlideContacts {
 public:
  /// No contacts. The sweeper must outlive them.
  explicit SlideContacts(const CertificateSweeper& sweeper) : sweeper_(sweeper) {}

  /// Removes all contacts.
  void clear() {
    pairs_.clear();
    fits_.clear();
  }
  /// Removes all pairs of triangles.
  void drop_pairs() { pairs_.clear(); }
  /// True if there are no pairs of triangles.
  bool empty() const { return pairs_.empty(); }
  /// Adds a pair of triangles, or replaces its axis. @return true if it bounds the twist in a new way
  bool add(const SweepContact& pair);
  /// Adds a cylinder in its bore: one bound at each end instead of those of dozens of triangles.
  /// @return true if it bounds the twist in a new way
  bool add_fit(const BlockedFit& fit);
  /// Upper bound of how much of a motion the whole cylinders withhold that their triangles would allow [mm].
  double withheld() const;
  /// Gives every pair the axis that lets a motion go furthest, and removes pairs that do not block it.
  void choose_axes(const ScrewMotion& motion);
  /// Removes contacts whose gap is more than `reach` [mm].
  void drop_beyond(double reach);

  /// A twist of the moving set about its center.
  struct Twist {
    Vec3 velocity;         ///< Of the center [mm].
    Vec3 rotation;         ///< [rad]
    bool bounded = false;  ///< Some contact holds it back.
  };
  /// The twist nearest to `wanted` that keeps a share of the tolerance of every gap, to first order: room for the
  /// second-order part of twists.
  /// @param characteristic_length weighs rotations against translations [mm]
  Twist nearest(const Twist& wanted, double characteristic_length);

  /// The gap that is kept at the end of a twist [mm].
  double reserve() const;
  /// The fraction of a motion on which `pair` is blocked that should be made, so that the reserve is kept if it can.
  double fraction_within_reserve(const SweepContact& pair) const;

  /// The contacts with a gap of at most `reach` [mm] at the present pose, by components and faces.
  std::vector<ContactPoint> points(double reach) const;

 private:
  /// The contact geometry of a pair at the present pose.
  struct PairGeometry {
    Vec3 normal;         ///< Unit, from the fixed to the moving triangle [world].
    ContactPatch patch;  ///< The moving triangle above the fixed one [world].
    double gap = 0;      ///< Along the normal [mm].
  };
  /// A pair of triangles.
  struct Contact {
    SweepContact pair;
    std::optional<PairGeometry> geometry;  ///< At `known_at_`, once it is known.
  };
  /// The triangles of a contact at the present pose.
  struct ContactTriangles;

  /// The geometry of a contact, computed at most once a pose.
  const PairGeometry& geometry(Contact& contact);
  PairGeometry geometry_of(const SweepContact& pair) const;
  PairGeometry geometry_of(const ContactTriangles& triangles) const;
  /// The gap alone.
  double gap_of(const SweepContact& pair) const;
  /// The triangles of these surfaces of the pair's components.
  ContactTriangles triangles(const SweepContact& pair, SurfacePair surfaces) const;
  /// Adds the rows of nearest_twist() by which the pair bounds the twist.
  void bound(const PairGeometry& contact, double characteristic_length, std::vector<HalfSpace>& bounds) const;

  /// An end of the part of a cylinder that is in its bore.
  struct FitEnd {
    Vec3 point;    ///< On the cylinder's axis [mm, world].
    Vec3 off;      ///< Offset of the moving one's axis from the fixed one's, across the bore [mm, world].
    Vec3 along;    ///< The bore's direction [unit, world].
    Vec3 inwards;  ///< To the other end [mm, world].
    double gap;    ///< Of the two surfaces on that side [mm].
  };
  /// A cylinder in its bore at the present pose.
  struct BoundingFit {
    double max_off;  ///< Largest offset from the bore's axis [mm].
    std::vector<FitEnd> ends;
  };
  /// Both ends; none if the cylinder is not in the bore any more.
  std::vector<FitEnd> ends(const BlockedFit& fit) const;
  /// The largest offset of a cylinder from its bore's axis [mm].
  double max_off(const BlockedFit& fit) const;
  /// Adds the rows by which the bore bounds the twist where `twist` would take the cylinder beyond it.
  void bound(const BoundingFit& fit, const Twist& twist, double characteristic_length,
             std::vector<HalfSpace>& bounds) const;
  ContactPoint point(const BlockedFit& fit, const FitEnd& end) const;

  const CertificateSweeper& sweeper_;
  std::vector<Contact> pairs_;
  std::vector<BlockedFit> fits_;
  Pose known_at_;  // of the moving set
};

}  // namespace dismantle
