// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/response/contact_patch.h"
#include "dismantle/certificates/sweep/certificate_sweeper.h"
#include "dismantle/engine/vertex_depth_guard.h"
#include "dismantle/math/nearest_twist.h"

#include <vector>

namespace dismantle {

/// The contacts that bound the twist of the set in hand during one step of response Slide
/// (docs/design/0006-certificates.md; Ortega, Redon, Coquillart 2007): pairs of triangles, each with the axis that last
/// let the wanted motion go furthest.
class SlideContacts {
 public:
  explicit SlideContacts(const CertificateSweeper& sweeper) : sweeper_(sweeper) {}

  void clear() {
    pairs_.clear();
    vertices_.clear();
    fits_.clear();
  }
  /// Lets go of all pairs, to find those that are left anew.
  void drop_pairs() { pairs_.clear(); }
  bool empty() const { return pairs_.empty(); }
  /// Takes up the pair, or gives it its new axis. True where it bounds the twist in a way that it did not before.
  bool add(const BlockedPair& pair);
  /// The same for a cylinder in its bore: one row a place along its axis instead of dozens of triangles.
  bool add_fit(const BlockedFit& fit);
  /// The most that cylinders taken whole keep from a motion that their triangles would allow [mm].
  double withheld() const;
  /// The same for a vertex that would get too deep behind a face, which the pair of a face of its own and that face
  /// stands for until the step ends: no test of triangles knows of it.
  bool add_vertex(const BlockedPair& pair);
  void drop_vertices();
  /// Gives every pair the axis that lets a motion to `end` go furthest, and lets go of pairs that do not block it.
  void choose_axes(const Pose& end);
  /// Lets go of pairs whose gap is more than `reach` [mm].
  void drop_beyond(double reach);

  /// The twist of the set in hand about its center, nearest to `wanted`, that takes no triangle pair deeper than its
  /// allowance less kSlideReserve of the tolerance, to first order; rotations count with the lever `lever` [mm].
  struct Twist {
    Vec3 velocity;         ///< Of the center [mm].
    Vec3 rotation;         ///< [rad]
    bool bounded = false;  ///< Some contact holds it back.
  };
  Twist nearest(const Twist& wanted, double lever) const;

  /// How much of a motion on which `pair` is blocked should be made, so that kSlideReserve is kept if it can be.
  double part_within_reserve(const BlockedPair& pair) const;
  std::size_t size() const { return pairs_.size(); }

  /// The contacts with a gap of at most `reach` [mm] where the set is now.
  std::vector<ContactPoint> points(double reach) const;

 private:
  /// Where a pair stands.
  struct Stand {
    Vec3 normal;         ///< Unit, from the fixed to the moving one [world].
    ContactPatch patch;  ///< The moving triangle above the fixed one [world].
    double gap = 0;      ///< Along the normal [mm].
  };
  Stand stand(const BlockedPair& pair) const;
  /// What the pair forbids the twist; rows of nearest_twist.
  /// @param allowed how deep it may be [mm]
  void bound(const BlockedPair& pair, double allowed, double lever, std::vector<HalfSpace>& bounds) const;

  /// An end of what of a cylinder is in its bore.
  struct FitEnd {
    Vec3 place;    ///< On the cylinder's axis [mm, world].
    Vec3 off;      ///< What has the moving one's axis there off the fixed one's, across the bore [mm, world].
    Vec3 along;    ///< The bore's direction [unit, world].
    Vec3 inwards;  ///< To the other end [mm, world].
    double gap;    ///< Of the two surfaces on that side [mm].
  };
  /// A cylinder in its bore where the set is now.
  struct HeldFit {
    double max_off;  ///< How far off the bore's axis it may be [mm].
    std::vector<FitEnd> ends;
  };
  /// None where the cylinder is not in the bore any more.
  std::vector<FitEnd> ends(const BlockedFit& fit) const;
  /// How far off its bore's axis a cylinder may be [mm].
  double max_off(const BlockedFit& fit) const;
  /// What the bore forbids the twist where `twist` would take the cylinder.
  /// @return false where the twist keeps within it
  bool bound(const HeldFit& held, const Twist& twist, double lever, std::vector<HalfSpace>& bounds) const;
  ContactPoint point(const BlockedFit& fit, const FitEnd& end) const;
  Twist solve(const Twist& wanted, double lever, const std::vector<HalfSpace>& bounds) const;

  const CertificateSweeper& sweeper_;
  std::vector<BlockedPair> pairs_;
  std::vector<BlockedPair> vertices_;
  std::vector<BlockedFit> fits_;
};

/// Response Slide keeps this share of the tolerance from every allowance: room for what a twist leaves out to first
/// order.
inline constexpr double kSlideReserve = 0.65;

}  // namespace dismantle
