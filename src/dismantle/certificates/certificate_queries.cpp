// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/certificate_queries.h"

#include "dismantle/certificates/straight_motion.h"
#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "dismantle/narrowphase/penetration_triangle_triangle.h"
#include "dismantle/surface/solid_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dismantle {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

Triangle at(const Triangle& own, const RigidTransform& t) {
  return {{t * own[0], t * own[1], t * own[2]}};
}

Triangle at(const Triangle& own, const Pose& pose) {
  return at(own, transform_from_pose(pose));
}

/// Faces at the poses of their components. Keeps the transform of the last component.
class PlacedFaces {
 public:
  explicit PlacedFaces(const CertificateSweeper& sweeper) : sweeper_(sweeper) {}
  Triangle operator()(ComponentId component, FaceId face) {
    if (component != last_) {
      last_ = component;
      transform_ = transform_from_pose(sweeper_.poses()[component.value]);
    }
    return at(sweeper_.solid(component).triangle(face.value), transform_);
  }

 private:
  const CertificateSweeper& sweeper_;
  ComponentId last_;
  RigidTransform transform_;
};

/// The contact of two faces, between their closest points; where they intersect, along the shortest way out of each
/// other, and where they only touch, along the normal of the fixed one.
ContactPoint contact(const NearFaces& faces, const Triangle& moving, const Triangle& fixed) {
  const TriangleDistance apart = distance_triangle_triangle(moving, fixed);
  ContactPoint c{faces.moving, faces.fixed, faces.face_moving, faces.face_fixed, apart.point_a, {}, apart.distance};
  c.normal = normalized(apart.point_a - apart.point_b);
  if (apart.distance == 0) {
    const Penetration depth = penetration_triangle_triangle(moving, fixed);
    c.normal = depth.depth > 0 ? -depth.axis : normalized(normal_unscaled(fixed));
    c.gap = -depth.depth;
  }
  return c;
}

/// A component of the moving set and another one, with a lower bound of their distance [mm].
struct ApartPair {
  ComponentId moving, fixed;
  PlacedSolid moving_solid, fixed_solid;
  double bound = 0;
};

/// The pairs that may be nearer than `limit`, by ascending bounds.
std::vector<ApartPair> apart_pairs(const CertificateSweeper& sweeper, double limit) {
  std::vector<ApartPair> pairs;
  if (sweeper.moving_set().empty()) return pairs;
  const RigidTransform moving_at = transform_from_pose(sweeper.pose());
  for (std::uint32_t k = 0; k < sweeper.poses().size(); ++k) {
    const ComponentId fixed(k);
    if (sweeper.moves(fixed) || sweeper.solid(fixed).tree.empty()) continue;
    const PlacedSolid fixed_solid{&sweeper.solid(fixed), transform_from_pose(sweeper.poses()[k])};
    for (const ComponentId moving : sweeper.moving_set()) {
      if (sweeper.solid(moving).tree.empty() || sweeper.guarded(moving, fixed).guard != PairGuard::Ghosts) continue;
      const PlacedSolid moving_solid{&sweeper.solid(moving), moving_at};
      const double bound = bounds_distance(moving_solid, fixed_solid);
      if (bound < limit) pairs.push_back({moving, fixed, moving_solid, fixed_solid, bound});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const ApartPair& x, const ApartPair& y) { return x.bound < y.bound; });
  return pairs;
}

}  // namespace

std::vector<ContactPoint> contacts_of(const CertificateSweeper& sweeper, Span<const SweepContact> pairs, double reach) {
  std::vector<ContactPoint> contacts;
  PlacedFaces of_moving(sweeper), of_fixed(sweeper);
  for (const SweepContact& pair : pairs) {
    const ContactPoint c = contact({pair.moving, pair.fixed, pair.face_moving, pair.face_fixed},
                                   of_moving(pair.moving, pair.face_moving), of_fixed(pair.fixed, pair.face_fixed));
    if (c.gap <= reach) contacts.push_back(c);
  }
  return contacts;
}

ContactPoint contact_of(const CertificateSweeper& sweeper, const NearFaces& faces) {
  return contact(faces, PlacedFaces(sweeper)(faces.moving, faces.face_moving),
                 PlacedFaces(sweeper)(faces.fixed, faces.face_fixed));
}

std::vector<NearFaces> near_faces_of(const CertificateSweeper& sweeper, Span<const SweepContact> pairs, double reach) {
  std::vector<NearFaces> near;
  PlacedFaces of_moving(sweeper), of_fixed(sweeper);
  for (const SweepContact& pair : pairs)
    if (triangles_within(of_moving(pair.moving, pair.face_moving), of_fixed(pair.fixed, pair.face_fixed), reach))
      near.push_back({pair.moving, pair.fixed, pair.face_moving, pair.face_fixed});
  return near;
}

Clearance min_clearance(const CertificateSweeper& sweeper, double limit) {
  Clearance nearest;
  nearest.distance = kInfinite;
  for (const ApartPair& pair : apart_pairs(sweeper, limit)) {
    // Of components that are equally near the first counts, independent of the order of examination.
    const bool is_first = std::pair(pair.moving, pair.fixed) < std::pair(nearest.moving, nearest.fixed);
    const double beyond = is_first ? std::nextafter(nearest.distance, kInfinite) : nearest.distance;
    const SolidDistance d = solid_distance(pair.moving_solid, pair.fixed_solid, std::min(limit, beyond));
    if (std::isinf(d.distance)) continue;
    nearest = {d.distance, pair.moving, pair.fixed, d.face_a, d.face_b, d.point_a, d.point_b};
  }
  return nearest;
}

FirstContact first_contact(const CertificateSweeper& sweeper, const Pose& target) {
  // Cut so that the arcs stay near their chords.
  const ScrewMotion whole = sweeper.motion_to(target);
  const int cuts = chord_count(whole.deviation, kArcShare * sweeper.tolerance());
  FirstContact first;
  for (int k = 0; k < cuts; ++k) {
    const ScrewMotion motion =
        sweeper.motion_between(whole.at(static_cast<double>(k) / cuts), whole.at(static_cast<double>(k + 1) / cuts));
    const CertificateSweep found = sweeper.sweep_const(motion, 0, target);
    if (found.free) continue;
    const SweepContact& pair = found.blocked.front();
    return {(k + pair.toi) / cuts, false, pair.moving, pair.fixed, pair.face_moving, pair.face_fixed};
  }
  return first;
}

namespace {

/// Each sweep for the first contact is shorter by at least this share of the tolerance, twice as much each time: else
/// contacts that are hardly nearer each time would go on forever.
constexpr double kShorter = 0.05;
/// With StraightSearch::Near, a contact before this many tolerances counts as one at the start.
constexpr double kNear = 4;
/// Where the contact itself is sought, and not only whether there is one, or the search is to be quick, it gives up
/// bounding a depth after this many pieces, which take about a second.
constexpr std::size_t kMaxPieces = 100000;

/// Where two components meet: the faces of a contact, or, where it is not known to be one, those nearest to each other.
StraightContact meeting(const CertificateSweeper& sweeper, const LinearMotion& motion, double at_share,
                        const SweepContact& contact, bool is_known) {
  const Vec3 moved = at_share * motion.displacement;
  const Pose pose{motion.pose_moving.position + moved, motion.pose_moving.rotation};
  const SolidTree &moving = sweeper.solid(motion.moving), &fixed = sweeper.solid(motion.fixed);
  if (!is_known) {
    const SolidDistance nearest = solid_distance({&moving, transform_from_pose(pose)},
                                                 {&fixed, transform_from_pose(motion.pose_fixed)}, kInfinite);
    return {length(moved), nearest.face_a, nearest.face_b, nearest.point_b, false};
  }
  const Triangle of_moving = at(moving.triangle(contact.face_moving.value), pose);
  const Triangle of_fixed = at(fixed.triangle(contact.face_fixed.value), motion.pose_fixed);
  return {length(moved), contact.face_moving, contact.face_fixed,
          distance_triangle_triangle(of_moving, of_fixed).point_b};
}

/// The contact in part of a motion.
/// @param from, to the part, as fractions of the displacement; what is before it is free already
std::optional<StraightContact> contact_between(const CertificateSweeper& sweeper, const LinearMotion& motion,
                                               double from, double to, StraightSearch search) {
  std::optional<StraightContact> contact;
  double shorter = kShorter * sweeper.tolerance() / length(motion.displacement);
  const bool is_depth_bounded = sweeper.guarded(motion.moving, motion.fixed).guard == PairGuard::Depth;
  // Any contact shortens the motion; if the rest is free it was the first.
  while (to > from) {
    const CertificateSweep found =
        sweeper.sweep_linear(motion, from, to, search == StraightSearch::First ? DeepSearch::First : DeepSearch::Any,
                             search == StraightSearch::Any ? kMaxSweptPieces : kMaxPieces);
    if (found.free) break;
    const auto first = std::min_element(found.blocked.begin(), found.blocked.end(),
                                        [](const SweepContact& a, const SweepContact& b) { return a.toi < b.toi; });
    to = std::max(from, std::min(from + (to - from) * first->toi, to - shorter));
    shorter *= 2;
    contact = meeting(sweeper, motion, to, *first, !found.undecided);
    // Nothing gets too deep before the time at which depths end.
    if (search == StraightSearch::Any || search == StraightSearch::Quick || is_depth_bounded) break;
    if (search == StraightSearch::Near && contact->distance <= kNear * sweeper.tolerance()) {
      contact->distance = 0;
      break;
    }
  }
  return contact;
}

/// The motion in the frame of the fixed component.
StraightMover mover(const CertificateSweeper& sweeper, const LinearMotion& motion) {
  const RigidTransform back = inverse(transform_from_pose(motion.pose_fixed));
  return {sweeper.solid(motion.moving), back * transform_from_pose(motion.pose_moving),
          back.rotation * motion.displacement};
}

/// The first contact of the whole moving set: the contact of one component shortens the motion for the others.
FirstContact straight_contact_of_all(const CertificateSweeper& sweeper, Vec3 displacement) {
  FirstContact first;
  for (const ComponentId fixed : sweeper.near_straight(displacement)) {
    for (const ComponentId moving : sweeper.moving_set()) {
      const LinearMotion motion{moving, fixed, first.toi * displacement, sweeper.pose(), sweeper.poses()[fixed.value]};
      const auto contact = straight_contact(sweeper, motion, StraightSearch::First);
      if (!contact) continue;
      first = {
          contact->distance / length(displacement), false, moving, fixed, contact->face_moving, contact->face_fixed};
      if (first.toi <= 0) return first;
    }
  }
  return first;
}

}  // namespace

std::vector<FirstContact> straight_contacts(const CertificateSweeper& sweeper, Span<const Vec3> displacements) {
  std::vector<FirstContact> found(displacements.size());
  sweeper.options().executor.for_each_heavy(displacements.size(), [&](std::size_t i) {
    if (length(displacements[i]) > 0) found[i] = straight_contact_of_all(sweeper, displacements[i]);
  });
  return found;
}

std::optional<StraightContact> straight_contact(const CertificateSweeper& sweeper, const LinearMotion& motion,
                                                StraightSearch search) {
  if (sweeper.solid(motion.moving).tree.empty() || sweeper.solid(motion.fixed).tree.empty()) return std::nullopt;
  if (passes_by(mover(sweeper, motion), sweeper.solid(motion.fixed))) return std::nullopt;
  return contact_between(sweeper, motion, 0, 1, search);
}

}  // namespace dismantle
