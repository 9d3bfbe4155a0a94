// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/response/slide_contacts.h"

#include "dismantle/surface/solid_tree_query.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace dismantle {

namespace {

/// Axes nearer to each other than this (one minus the cosine) are the same.
constexpr double kSameAxis = 1e-9;
/// Corners whose gap exceeds the smallest one by at most this share of the tolerance touch as well.
constexpr double kTouching = 1e-2;

/// Where a pair uses the reserve, a motion is made up to this share of what the certificates allow.
constexpr double kShareBeyondReserve = 0.5;

/// The share of the tolerance that is kept of every gap, for the second-order part of twists; and of the play of a
/// cylinder in its bore, whose rows leave out only the bending of the twist.
constexpr double kReserve = 0.3, kFitReserve = 0.1;

/// A twist is bounded again where it takes a cylinder further, at most this many times.
constexpr int kFitCuts = 6;
/// It may exceed the bound by less than this share of the tolerance.
constexpr double kFitSlack = 1e-2;

/// Cylinders with less play than this share of the tolerance are left to their triangles.
constexpr double kMinOff = 0.05;

/// The touching face is searched at this distance from the end of the contact [of its length].
constexpr double kInside = 1e-3;
/// The smallest cosine of the angle between a cylinder and its bore, up to its sign.
constexpr double kMinAhead = 0.99;

bool same_faces(const SweepContact& x, const SweepContact& y) {
  return x.moving == y.moving && x.fixed == y.fixed && x.surfaces == y.surfaces && x.face_moving == y.face_moving &&
         x.face_fixed == y.face_fixed;
}

}  // namespace

/// The moving and the fixed triangle, the direction of the second to the first, and the gap along it.
struct SlideContacts::ContactTriangles {
  Triangle moving, fixed;
  Vec3 normal;
  double gaps[3];  ///< Of the corners of the moving triangle [mm].
  double gap() const { return std::min({gaps[0], gaps[1], gaps[2]}); }
};

bool SlideContacts::add(const SweepContact& pair) {
  if (length_squared(pair.axis) == 0) return false;
  for (Contact& known : pairs_) {
    if (!same_faces(known.pair, pair)) continue;
    const bool changed = 1 - dot(known.pair.axis, pair.axis) > kSameAxis;
    known = {pair, {}};
    return changed && geometry(known).patch.count > 0;
  }
  pairs_.push_back({pair, {}});
  return geometry(pairs_.back()).patch.count > 0;
}

bool SlideContacts::add_fit(const BlockedFit& fit) {
  const auto same = [&](const BlockedFit& known) {
    return known.moving == fit.moving && known.fixed == fit.fixed && known.surfaces == fit.surfaces &&
           known.fit == fit.fit;
  };
  if (std::any_of(fits_.begin(), fits_.end(), same)) return false;
  if (max_off(fit) < kMinOff * sweeper_.tolerance()) return false;
  fits_.push_back(fit);
  return !ends(fit).empty();
}

void SlideContacts::choose_axes(const ScrewMotion& motion) {
  std::erase_if(pairs_, [&](Contact& contact) {
    if (contact.pair.surfaces == SurfacePair::Plain) return false;
    const TrianglePairResult found = sweeper_.sweep_pair(contact.pair, motion);
    if (found.free || length_squared(found.contact.axis) == 0) return true;
    if (!(contact.pair.axis == found.contact.axis)) contact.geometry.reset();
    contact.pair.axis = found.contact.axis;
    return false;
  });
}

double SlideContacts::fraction_within_reserve(const SweepContact& pair) const {
  if (length_squared(pair.axis) == 0) return 0;
  const double gap = gap_of(pair);
  const double share = gap > 0 ? (gap - reserve()) / gap : 0;
  // A pair that uses the reserve already goes half of what is left.
  return pair.toi * std::max(share, kShareBeyondReserve);
}

const SlideContacts::PairGeometry& SlideContacts::geometry(Contact& contact) {
  if (!(sweeper_.pose() == known_at_)) {
    for (Contact& c : pairs_) c.geometry.reset();
    known_at_ = sweeper_.pose();
  }
  if (!contact.geometry) contact.geometry = geometry_of(contact.pair);
  return *contact.geometry;
}

SlideContacts::PairGeometry SlideContacts::geometry_of(const SweepContact& pair) const {
  if (pair.surfaces != SurfacePair::Plain) return geometry_of(triangles(pair, pair.surfaces));
  const RigidTransform fixed = transform_from_pose(sweeper_.poses()[pair.fixed.value]);
  PairGeometry s;
  s.normal = -(fixed.rotation * pair.axis);
  const Vec3 now = transform_from_pose(sweeper_.pose()) * pair.point;
  s.gap = dot(s.normal, now - fixed * pair.limit);
  s.patch.points[s.patch.count++] = {now, s.gap};
  return s;
}

SlideContacts::PairGeometry SlideContacts::geometry_of(const ContactTriangles& t) const {
  PairGeometry s;
  s.normal = t.normal;
  s.gap = t.gap();
  s.patch = contact_patch(t.moving, t.fixed, t.normal, sweeper_.tolerance());
  if (s.patch.count == 0 && s.gap <= sweeper_.tolerance())
    for (int i = 0; i < 3; ++i) s.patch.points[s.patch.count++] = {t.moving[i], t.gaps[i]};
  return s;
}

double SlideContacts::gap_of(const SweepContact& pair) const {
  return pair.surfaces == SurfacePair::Plain ? geometry_of(pair).gap : triangles(pair, pair.surfaces).gap();
}

SlideContacts::ContactTriangles SlideContacts::triangles(const SweepContact& pair, SurfacePair surfaces) const {
  const RigidTransform moving = transform_from_pose(sweeper_.pose());
  const RigidTransform fixed = transform_from_pose(sweeper_.poses()[pair.fixed.value]);
  const TestedPair tested{pair.moving, pair.fixed, surfaces};
  const Triangle own = sweeper_.moving_surface(tested).triangle(pair.face_moving.value);
  const Triangle other = sweeper_.fixed_surface(tested).triangle(pair.face_fixed.value);
  ContactTriangles t;
  t.moving = {{moving * own[0], moving * own[1], moving * own[2]}};
  t.fixed = {{fixed * other[0], fixed * other[1], fixed * other[2]}};
  t.normal = -(fixed.rotation * pair.axis);
  double top = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) top = std::max(top, dot(t.normal, t.fixed[i] - t.fixed[0]));
  for (int i = 0; i < 3; ++i) t.gaps[i] = dot(t.normal, t.moving[i] - t.fixed[0]) - top;
  return t;
}

void SlideContacts::drop_beyond(double reach) {
  std::erase_if(pairs_, [&](const Contact& contact) { return gap_of(contact.pair) > reach; });
  std::erase_if(fits_, [&](const BlockedFit& fit) {
    const std::vector<FitEnd> both = ends(fit);
    return std::all_of(both.begin(), both.end(), [reach](const FitEnd& end) { return end.gap > reach; });
  });
}

std::vector<SlideContacts::FitEnd> SlideContacts::ends(const BlockedFit& blocked) const {
  const CylinderFit& fit = blocked.fit;
  const RigidTransform moving = transform_from_pose(sweeper_.pose());
  const RigidTransform fixed = transform_from_pose(sweeper_.poses()[blocked.fixed.value]);
  const RigidTransform &of_inner = fit.moving_inside ? moving : fixed, &of_outer = fit.moving_inside ? fixed : moving;
  const Vec3 point = of_inner * fit.inner.point, direction = of_inner.rotation * fit.inner.direction;
  const Vec3 middle = of_outer * fit.outer.point, along = of_outer.rotation * fit.outer.direction;
  // The bore's ends, as positions along the cylinder's axis.
  const double ahead = dot(direction, along), start = dot(point - middle, along);
  if (std::abs(ahead) < kMinAhead) return {};
  double begin = (fit.outer_begin - start) / ahead, end = (fit.outer_end - start) / ahead;
  if (ahead < 0) std::swap(begin, end);
  begin = std::max(begin, fit.inner_begin);
  end = std::min(end, fit.inner_end);
  if (!(begin <= end)) return {};
  std::vector<FitEnd> both;
  for (const bool at_end : {false, true}) {
    const double at = at_end ? end : begin;
    const Vec3 there = point + at * direction, from = there - middle;
    const Vec3 off = from - dot(from, along) * along;
    both.push_back({there, fit.moving_inside ? off : -off, along, (at_end ? begin - end : end - begin) * direction,
                    fit.room - length(off)});
  }
  return both;
}

double SlideContacts::reserve() const {
  return kReserve * sweeper_.tolerance();
}

double SlideContacts::withheld() const {
  double largest = 0;
  for (const BlockedFit& fit : fits_) largest = std::max(largest, fit.fit.radial_deviation);
  return largest;
}

double SlideContacts::max_off(const BlockedFit& fit) const {
  return fit.fit.room - kFitReserve * sweeper_.tolerance();
}

void SlideContacts::bound(const BoundingFit& fit, const Twist& twist, double characteristic_length,
                          std::vector<HalfSpace>& bounds) const {
  const double slack = kFitSlack * sweeper_.tolerance();
  for (const FitEnd& end : fit.ends) {
    const Vec3 arm = end.point - sweeper_.center();
    const Vec3 shift = twist.velocity + cross(twist.rotation, arm);
    const Vec3 off = end.off + shift - dot(shift, end.along) * end.along;
    if (length(off) <= std::max(fit.max_off, length(end.off)) + slack) continue;
    const Vec3 out = normalized(off), turn = (1 / characteristic_length) * cross(arm, out);
    bounds.push_back(
        {{-out.x, -out.y, -out.z, -turn.x, -turn.y, -turn.z}, std::min(0.0, dot(out, end.off) - fit.max_off)});
  }
}

void SlideContacts::bound(const PairGeometry& s, double characteristic_length, std::vector<HalfSpace>& bounds) const {
  const Vec3 center = sweeper_.center();
  if (s.patch.count == 0) return;
  // The gap that the certificates measure can be deeper than that of the overlap.
  const double deeper = std::min(0.0, s.gap - s.patch.nearest().gap);
  for (int i = 0; i < s.patch.count; ++i) {
    const ContactPatch::Point& p = s.patch.points[i];
    const Vec3 turn = (1 / characteristic_length) * cross(p.on_upper - center, s.normal);
    bounds.push_back(
        {{s.normal.x, s.normal.y, s.normal.z, turn.x, turn.y, turn.z}, std::min(0.0, reserve() - p.gap - deeper)});
  }
}

SlideContacts::Twist SlideContacts::nearest(const Twist& wanted, double characteristic_length) {
  std::vector<HalfSpace> bounds;
  for (Contact& contact : pairs_) bound(geometry(contact), characteristic_length, bounds);
  std::vector<BoundingFit> bounding_fits;
  for (const BlockedFit& fit : fits_) bounding_fits.push_back({max_off(fit), ends(fit)});
  const auto twist_of = [&](const NearestTwist& found) {
    const Vec3 turned{found.x[3], found.x[4], found.x[5]};
    return Twist{{found.x[0], found.x[1], found.x[2]}, turned / characteristic_length, found.active_count > 0};
  };
  const auto of_fits = [&](const NearestTwist& found) {
    std::vector<HalfSpace> more;
    for (const BoundingFit& fit : bounding_fits) bound(fit, twist_of(found), characteristic_length, more);
    return more;
  };
  const Vec3 velocity = wanted.velocity, turned = characteristic_length * wanted.rotation;
  return twist_of(
      nearest_twist({velocity.x, velocity.y, velocity.z, turned.x, turned.y, turned.z}, bounds, kFitCuts, of_fits));
}

ContactPoint SlideContacts::point(const BlockedFit& fit, const FitEnd& end) const {
  const Vec3 out = normalized(end.off);
  const double side = fit.fit.moving_inside ? 1 : -1;
  ContactPoint contact{fit.moving, fit.fixed, {}, {}, end.point + side * fit.fit.radius * out, -out, end.gap};
  // Just inside: on the rim, the faces around the opening of the bore are as near.
  const Vec3 inside = contact.point + kInside * end.inwards;
  const auto face = [&inside](const SolidTree& solid, const Pose& pose) {
    const Vec3 seen = inverse(transform_from_pose(pose)) * inside;
    return FaceId(nearest_face(solid, seen, NearestFace::kNone).face);
  };
  contact.face_moving = face(sweeper_.solid(fit.moving), sweeper_.pose());
  contact.face_fixed = face(sweeper_.solid(fit.fixed), sweeper_.poses()[fit.fixed.value]);
  return contact;
}

std::vector<ContactPoint> SlideContacts::points(double reach) const {
  std::vector<ContactPoint> points;
  for (const Contact& contact : pairs_) {
    // Points and gaps are those of the components, not of ghosts.
    const SweepContact& pair = contact.pair;
    PairGeometry s;
    if (pair.surfaces == SurfacePair::Plain) {
      s = geometry_of(pair);
    } else if (const ContactTriangles t = triangles(pair, SurfacePair::Plain); t.gap() <= reach) {
      s = geometry_of(t);
    }
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
  const auto key = [](const ContactPoint& c) { return std::tuple(c.moving, c.fixed, c.face_moving, c.face_fixed); };
  const auto before = [&](const ContactPoint& x, const ContactPoint& y) { return key(x) < key(y); };
  const auto same = [&](const ContactPoint& x, const ContactPoint& y) { return key(x) == key(y); };
  std::stable_sort(points.begin(), points.end(), before);
  // Two faces may be in contact with the ghosts of each other.
  points.erase(std::unique(points.begin(), points.end(), same), points.end());
  for (const BlockedFit& fit : fits_)
    for (const FitEnd& end : ends(fit))
      if (end.gap <= reach && length_squared(end.off) > 0) points.push_back(point(fit, end));
  std::stable_sort(points.begin(), points.end(), before);
  return points;
}

}  // namespace dismantle
