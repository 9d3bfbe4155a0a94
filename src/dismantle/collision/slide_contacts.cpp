// SPDX-License-Identifier: Apache-2.0
#include "dismantle/collision/slide_contacts.h"

#include <algorithm>
#include <limits>

namespace dismantle {

namespace {

/// Axes nearer to each other than this (one minus the cosine) are the same.
constexpr double kSameAxis = 1e-9;
/// Corners within this share of the tolerance of the nearest one touch with it.
constexpr double kTouching = 1e-2;

/// Of a motion on which a pair uses the reserve, this share of what the certificates allow is made.
constexpr double kShareBeyondReserve = 0.5;

bool same_faces(const BlockedPair& x, const BlockedPair& y) {
  return x.moving == y.moving && x.fixed == y.fixed && x.face_moving == y.face_moving && x.face_fixed == y.face_fixed;
}

}  // namespace

bool SlideContacts::add(const BlockedPair& pair) {
  if (length_squared(pair.axis) == 0) return false;
  for (BlockedPair& known : pairs_) {
    if (!same_faces(known, pair)) continue;
    const bool changed = 1 - dot(known.axis, pair.axis) > kSameAxis;
    known = pair;
    return changed && stand(known).patch.count > 0;
  }
  pairs_.push_back(pair);
  return stand(pair).patch.count > 0;
}

bool SlideContacts::add_vertex(const BlockedPair& pair) {
  for (const BlockedPair& known : vertices_)
    if (same_faces(known, pair)) return false;
  vertices_.push_back(pair);
  return stand(pair).patch.count > 0;
}

void SlideContacts::drop_vertices() {
  vertices_.clear();
}

void SlideContacts::choose_axes(const Pose& end) {
  std::erase_if(pairs_, [&](BlockedPair& pair) {
    const LeafSweep::Result found = sweeper_.sweep_pair(pair, end);
    if (found.free || length_squared(found.contact.axis) == 0) return true;
    pair.axis = found.contact.axis;
    return false;
  });
}

double SlideContacts::part_within_reserve(const BlockedPair& pair) const {
  if (length_squared(pair.axis) == 0) return 0;
  const double allowed = sweeper_.allowed(pair.moving, pair.fixed), gap = stand(pair).gap;
  const double most = gap + allowed - kArcShare * sweeper_.tolerance();
  const double wanted = gap + allowed - kSlideReserve * sweeper_.tolerance();
  const double share = most > 0 ? wanted / most : 0;
  // What is beyond the reserve already goes half of what is left.
  return pair.toi * std::max(share, kShareBeyondReserve);
}

SlideContacts::Stand SlideContacts::stand(const BlockedPair& pair) const {
  const RigidTransform moving = transform_from_pose(sweeper_.pose());
  const Pose& fixed_pose = sweeper_.poses()[pair.fixed.value];
  const RigidTransform fixed = transform_from_pose(fixed_pose);
  const Triangle own = sweeper_.solid(pair.moving).triangle(pair.face_moving.value);
  const Triangle other = sweeper_.solid(pair.fixed).triangle(pair.face_fixed.value);
  const Triangle own_now{{moving * own[0], moving * own[1], moving * own[2]}};
  const Triangle other_now{{fixed * other[0], fixed * other[1], fixed * other[2]}};
  Stand s;
  s.normal = -(fixed.rotation * pair.axis);
  double most = -std::numeric_limits<double>::infinity(), gaps[3];
  for (int i = 0; i < 3; ++i) most = std::max(most, dot(s.normal, other_now[i] - other_now[0]));
  for (int i = 0; i < 3; ++i) gaps[i] = dot(s.normal, own_now[i] - other_now[0]) - most;
  s.gap = std::min({gaps[0], gaps[1], gaps[2]});
  s.patch = contact_patch(own_now, other_now, s.normal, sweeper_.tolerance());
  if (s.patch.count == 0 && s.gap <= sweeper_.tolerance())
    for (int i = 0; i < 3; ++i) s.patch.points[s.patch.count++] = {own_now[i], gaps[i]};
  return s;
}

void SlideContacts::drop_beyond(double reach) {
  std::erase_if(pairs_, [&](const BlockedPair& pair) { return stand(pair).gap > reach; });
}

void SlideContacts::bound(const BlockedPair& pair, double allowed, double lever, std::vector<HalfSpace>& bounds) const {
  const Vec3 center = sweeper_.center();
  const Stand s = stand(pair);
  const double deepest = allowed - kSlideReserve * sweeper_.tolerance();
  if (s.patch.count == 0) return;
  // What the certificates measure: it can be deeper than where the two lie over each other.
  const double deeper = std::min(0.0, s.gap - s.patch.nearest().gap);
  for (int i = 0; i < s.patch.count; ++i) {
    const ContactPatch::Point& p = s.patch.points[i];
    const Vec3 turn = (1 / lever) * cross(p.on_upper - center, s.normal);
    bounds.push_back(
        {{s.normal.x, s.normal.y, s.normal.z, turn.x, turn.y, turn.z}, std::min(0.0, -(p.gap + deeper + deepest))});
  }
}

SlideContacts::Twist SlideContacts::nearest(const Twist& wanted, double lever) const {
  std::vector<HalfSpace> bounds;
  for (const BlockedPair& pair : pairs_) bound(pair, sweeper_.allowed(pair.moving, pair.fixed), lever, bounds);
  for (const BlockedPair& pair : vertices_)
    bound(pair, VertexDepthGuard::kLimit * sweeper_.allowed(pair.moving, pair.fixed), lever, bounds);
  const Vec3 turned = lever * wanted.rotation;
  const NearestTwist found =
      nearest_twist({wanted.velocity.x, wanted.velocity.y, wanted.velocity.z, turned.x, turned.y, turned.z}, bounds);
  return {{found.x[0], found.x[1], found.x[2]},
          {found.x[3] / lever, found.x[4] / lever, found.x[5] / lever},
          found.active_count > 0};
}

std::vector<ContactPoint> SlideContacts::points(double reach) const {
  std::vector<ContactPoint> points;
  for (const BlockedPair& pair : pairs_) {
    const Stand s = stand(pair);
    if (s.gap > reach || s.patch.count == 0) continue;
    // The middle of what touches.
    const double touching = s.patch.nearest().gap + kTouching * sweeper_.tolerance();
    Vec3 sum;
    int count = 0;
    for (int i = 0; i < s.patch.count; ++i) {
      if (s.patch.points[i].gap > touching) continue;
      sum += s.patch.points[i].on_upper;
      ++count;
    }
    points.push_back(
        {pair.moving, pair.fixed, pair.face_moving, pair.face_fixed, (1.0 / count) * sum, s.normal, s.gap});
  }
  std::sort(points.begin(), points.end(), [](const ContactPoint& x, const ContactPoint& y) {
    if (x.moving != y.moving) return x.moving < y.moving;
    if (x.fixed != y.fixed) return x.fixed < y.fixed;
    return x.face_moving != y.face_moving ? x.face_moving < y.face_moving : x.face_fixed < y.face_fixed;
  });
  return points;
}

}  // namespace dismantle
