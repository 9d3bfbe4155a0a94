// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/certificate_queries.h"

#include "dismantle/certificates/straight_motion.h"
#include "dismantle/engine/vertex_depth_guard.h"
#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "dismantle/narrowphase/penetration_triangle_triangle.h"
#include "dismantle/surface/solid_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dismantle {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

Triangle at(const Triangle& own, const Pose& pose) {
  const RigidTransform t = transform_from_pose(pose);
  return {{t * own[0], t * own[1], t * own[2]}};
}

Triangle placed(const CertificateSweeper& sweeper, ComponentId component, FaceId face) {
  return at(sweeper.solid(component).triangle(face.value), sweeper.poses()[component.value]);
}

/// A component in hand and one that is not, and a lower bound of their distance [mm].
struct ApartPair {
  ComponentId moving, fixed;
  PlacedSolid moving_solid, fixed_solid;
  double bound = 0;
};

/// The pairs that may be nearer than `limit`, the nearest bounds first.
std::vector<ApartPair> apart_pairs(const CertificateSweeper& sweeper, double limit) {
  std::vector<ApartPair> pairs;
  const RigidTransform held_at = transform_from_pose(sweeper.pose());
  for (std::uint32_t k = 0; k < sweeper.poses().size(); ++k) {
    const ComponentId fixed(k);
    if (sweeper.holds(fixed) || sweeper.solid(fixed).tree.empty()) continue;
    const PlacedSolid fixed_solid{&sweeper.solid(fixed), transform_from_pose(sweeper.poses()[k])};
    for (const ComponentId moving : sweeper.held()) {
      if (sweeper.solid(moving).tree.empty() || sweeper.allowed(moving, fixed) < 0) continue;
      const PlacedSolid moving_solid{&sweeper.solid(moving), held_at};
      const double bound = bounds_distance(moving_solid, fixed_solid);
      if (bound < limit) pairs.push_back({moving, fixed, moving_solid, fixed_solid, bound});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const ApartPair& x, const ApartPair& y) { return x.bound < y.bound; });
  return pairs;
}

/// One candidate motion, cut so that its arcs stay near their chords.
FirstContact first_contact(const CertificateSweeper& sweeper, const Pose& target) {
  const Pose start = sweeper.pose();
  const double most = kArcShare * sweeper.tolerance();
  const int cuts = std::max(1, static_cast<int>(std::ceil(std::sqrt(sweeper.deviation(target) / most))));
  FirstContact first;
  for (int k = 0; k < cuts; ++k) {
    const CertificateSweep found = sweeper.look(pose_between(start, target, static_cast<double>(k) / cuts),
                                                pose_between(start, target, static_cast<double>(k + 1) / cuts), 0);
    if (found.free) continue;
    const BlockedPair& pair = found.blocked.front();
    return {(k + pair.toi) / cuts, false, pair.moving, pair.fixed, pair.face_moving, pair.face_fixed};
  }
  return first;
}

}  // namespace

std::vector<ContactPoint> contacts_within(const CertificateSweeper& sweeper, double reach) {
  std::vector<ContactPoint> contacts;
  for (const BlockedPair& pair : sweeper.near_pairs(reach)) {
    const Triangle moving = placed(sweeper, pair.moving, pair.face_moving);
    const Triangle fixed = placed(sweeper, pair.fixed, pair.face_fixed);
    const TriangleDistance apart = distance_triangle_triangle(moving, fixed);
    if (apart.distance > reach) continue;
    ContactPoint c{pair.moving, pair.fixed, pair.face_moving, pair.face_fixed, apart.point_a, {}, apart.distance};
    c.normal = normalized(apart.point_a - apart.point_b);
    if (apart.distance == 0) {
      const Penetration depth = penetration_triangle_triangle(moving, fixed);
      c.normal = depth.depth > 0 ? -depth.axis : normalized(normal_unscaled(fixed));
      c.gap = -depth.depth;
    }
    contacts.push_back(c);
  }
  return contacts;
}

Clearance min_clearance(const CertificateSweeper& sweeper, double limit) {
  Clearance least;
  least.distance = kInfinite;
  for (const ApartPair& pair : apart_pairs(sweeper, limit)) {
    // Of components that are equally near the first counts, in whatever order they are looked at.
    const bool is_first = std::pair(pair.moving, pair.fixed) < std::pair(least.moving, least.fixed);
    const double beyond = is_first ? std::nextafter(least.distance, kInfinite) : least.distance;
    const SolidDistance d = solid_distance(pair.moving_solid, pair.fixed_solid, std::min(limit, beyond));
    if (std::isinf(d.distance)) continue;
    least = {d.distance, pair.moving, pair.fixed, d.face_a, d.face_b, d.point_a, d.point_b};
  }
  return least;
}

std::vector<FirstContact> first_contacts(const CertificateSweeper& sweeper, Span<const Pose> targets) {
  std::vector<FirstContact> found(targets.size());
  sweeper.executor().for_each_heavy(targets.size(),
                                    [&](std::size_t i) { found[i] = first_contact(sweeper, targets[i]); });
  return found;
}

namespace {

/// What touches from the start and is stopped goes on if a new start gets so many tolerances further: which of two
/// overlapping faces is on which side is chosen where a sweep begins.
constexpr double kNewStart = 8;
constexpr int kMaxStarts = 8;
/// Each look for the first contact is shorter by at least this share of the tolerance, twice as much each time: else
/// contacts that are ever so little nearer would go on for ever.
constexpr double kShorter = 0.05;

/// @param from how much of the way is free already
/// @param to how much of it is asked about
std::optional<StraightContact> contact_between(const CertificateSweeper& sweeper, const StraightWay& asked, double from,
                                               double to, StraightSearch search) {
  std::optional<StraightContact> contact;
  double shorter = kShorter * sweeper.tolerance() / length(asked.way);
  // Any contact shortens the way; where that is free the contact was the first.
  while (to > from) {
    const CertificateSweep found = sweeper.look_straight(asked, from, to);
    if (found.free) break;
    const auto first = std::min_element(found.blocked.begin(), found.blocked.end(),
                                        [](const BlockedPair& a, const BlockedPair& b) { return a.toi < b.toi; });
    to = std::max(from, std::min(from + (to - from) * first->toi, to - shorter));
    shorter *= 2;
    Triangle moving = at(sweeper.solid(asked.moving).triangle(first->face_moving.value), asked.moving_at);
    for (Vec3& p : moving.corner) p += to * asked.way;
    const Triangle fixed = at(sweeper.solid(asked.fixed).triangle(first->face_fixed.value), asked.fixed_at);
    contact = {to * length(asked.way), first->face_moving, first->face_fixed,
               distance_triangle_triangle(moving, fixed).point_b};
    if (search == StraightSearch::Any) break;
  }
  return contact;
}

/// The same from the beginning, of what touches there.
std::optional<StraightContact> contact_from_fit(const CertificateSweeper& sweeper, const StraightWay& asked, double to,
                                                StraightSearch search) {
  const double whole = length(asked.way);
  double from = 0;
  for (int starts = 1;; ++starts) {
    const double next = std::min(to, from + kNewStart * sweeper.tolerance() / whole);
    if (const auto contact = contact_between(sweeper, asked, from, next, search)) return contact;
    const auto contact = contact_between(sweeper, asked, next, to, StraightSearch::First);
    if (!contact || starts == kMaxStarts) return contact;
    from = contact->distance / whole;
  }
}

/// The way as the fixed one sees it.
StraightMover mover(const CertificateSweeper& sweeper, const StraightWay& asked) {
  const RigidTransform back = inverse(transform_from_pose(asked.fixed_at));
  return {sweeper.solid(asked.moving), back * transform_from_pose(asked.moving_at), back.rotation * asked.way};
}

/// Where some vertex would get deeper than any may: no start makes that way free.
std::optional<StraightContact> deep_contact(const CertificateSweeper& sweeper, const StraightWay& asked,
                                            const StraightMover& moving) {
  const auto deep = deep_vertex_on(moving, sweeper.solid(asked.fixed),
                                   VertexDepthGuard::kLimit * sweeper.allowed(asked.moving, asked.fixed));
  if (!deep) return std::nullopt;
  return StraightContact{deep->share * length(asked.way), FaceId(deep->face_moving), FaceId(deep->face_fixed),
                         transform_from_pose(asked.fixed_at) * deep->point};
}

/// The earliest contact of the set in hand on its way: what one component meets shortens it for the others.
FirstContact straight_contact_of_all(const CertificateSweeper& sweeper, Vec3 way) {
  FirstContact first;
  for (std::uint32_t k = 0; k < sweeper.poses().size(); ++k) {
    const ComponentId fixed(k);
    if (sweeper.holds(fixed)) continue;
    for (const ComponentId moving : sweeper.held()) {
      const StraightWay asked{moving, fixed, first.toi * way, sweeper.pose(), sweeper.poses()[k]};
      const auto contact = straight_contact(sweeper, asked, StraightSearch::First);
      if (!contact) continue;
      first = {contact->distance / length(way), false, moving, fixed, contact->face_moving, contact->face_fixed};
      if (first.toi <= 0) return first;
    }
  }
  return first;
}

}  // namespace

std::vector<FirstContact> straight_contacts(const CertificateSweeper& sweeper, Span<const Vec3> ways) {
  std::vector<FirstContact> found(ways.size());
  sweeper.executor().for_each_heavy(ways.size(), [&](std::size_t i) {
    if (length(ways[i]) > 0) found[i] = straight_contact_of_all(sweeper, ways[i]);
  });
  return found;
}

std::optional<StraightContact> straight_contact(const CertificateSweeper& sweeper, const StraightWay& asked,
                                                StraightSearch search) {
  const double allowed = sweeper.allowed(asked.moving, asked.fixed);
  if (allowed < 0 || sweeper.solid(asked.moving).tree.empty() || sweeper.solid(asked.fixed).tree.empty())
    return std::nullopt;
  const StraightMover moving = mover(sweeper, asked);
  if (passes_by(moving, sweeper.solid(asked.fixed))) return std::nullopt;
  const auto deep = deep_contact(sweeper, asked, moving);
  if (deep && search == StraightSearch::Any) return deep;
  const double to = deep ? deep->distance / length(asked.way) : 1;
  const auto contact = sweeper.touched(asked.moving, asked.fixed) ? contact_from_fit(sweeper, asked, to, search)
                                                                  : contact_between(sweeper, asked, 0, to, search);
  return contact ? contact : deep;
}

}  // namespace dismantle
