// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/moving_part_search.h"

#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/surface/depth/near_two_faces.h"
#include "dismantle/surface/depth/shallow_region.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dismantle {

namespace {

/// Number of pieces between two calls of keep_going.
constexpr std::size_t kAsk = 256;

/// A shifted copy is given up where its box meets the boxes of more faces than this.
constexpr int kMaxCopyFaces = 1000;
/// Lengths along the surface count for this share where parts are divided.
constexpr double kAlong = 0.05;
/// Two directions are tried as one where the cosine between them is above this.
constexpr double kSameDirection = 1 - 1e-9;
/// A way is parallel to a face where it gets nearer to its plane by no more than this share of its length.
constexpr double kParallel = 1e-9;
/// Two faces are in one plane where the cosine between their normals is this near to 1, and they are off each other's
/// plane by no more than this share of the limit.
constexpr double kSamePlane = 1e-6, kSamePlaneOffset = 1e-3;

Triangle mean(const Triangle& s, const Triangle& t) {
  return {{(s[0] + t[0]) / 2, (s[1] + t[1]) / 2, (s[2] + t[2]) / 2}};
}

std::array<Vec3, 6> corners_of(const MovingPart& part) {
  return {part.begin[0], part.begin[1], part.begin[2], part.end[0], part.end[1], part.end[2]};
}

/// True if a hull is certainly further than `gap` from the faces of a surface, apart from those that `passes` may not
/// cross: those parallel to it. Null for all faces.
bool clear_of(const SurfaceTree& surface, const PartHull& hull, double gap, Vec3 passes = {}) {
  const bool is_way = length_squared(passes) > 0;
  const Bvh& bvh = surface.bvh();
  const PartHull turned = hull.turned(surface.axes());
  int seen = 0;
  std::vector<NodeIndex> nodes{bvh.root()};
  while (!nodes.empty()) {
    const NodeIndex node = nodes.back();
    nodes.pop_back();
    if (!turned.may_meet(surface.box(node), gap)) continue;
    if (node >= bvh.leaf_count()) {
      const BvhChildren children = bvh.children[node - bvh.leaf_count()];
      nodes.push_back(children.left);
      nodes.push_back(children.right);
      continue;
    }
    const Triangle& face = surface.triangle(bvh.leaf_triangle[node]);
    if (is_way && std::abs(dot(normalized(normal_unscaled(face)), passes)) <= kParallel * length(passes)) continue;
    if (++seen > kMaxCopyFaces || !hull.apart(face, gap)) return false;
  }
  return true;
}

}  // namespace

bool MovingPartSearch::is_deep(Vec3 own, Vec3 point) const {
  return is_deep(own, point, solid_.surface().distance(point, 0, rule_.limit).distance);
}

bool MovingPartSearch::is_deep(Vec3 own, Vec3 point, double distance) const {
  if (distance <= rule_.far_limit) return false;
  if (distance <= rule_.limit) {
    const SurfaceTree* thick = rule_.thick_faces();
    if (thick && thick->distance(point, 0, rule_.limit).distance <= rule_.limit) return false;
    if (solid_.surface().distance(own, 0, rule_.limit).distance <= rule_.limit) return false;
    const SolidShape* hole = rule_.hole;
    if (hole &&
        (hole->surface().distance(point, 0, rule_.limit).distance <= rule_.limit || hole->winding().inside(point)))
      return false;
  }
  return solid_.winding().inside(point);
}

/// True if no point of a part is far in the assembled state.
bool MovingPartSearch::is_near(const MovingPart& part) const {
  const Vec3 center = (part.own[0] + part.own[1] + part.own[2]) / 3;
  double radius = 0;
  for (int i = 0; i < 3; ++i) radius = std::max(radius, length(part.own[i] - center));
  const MeshDistance nearest = solid_.surface().distance(center, 0, std::max(rule_.limit, radius));
  if (nearest.distance + radius <= rule_.limit) return true;
  const auto near = [&](Vec3 p) { return solid_.surface().distance_to_face(p, nearest.face) <= rule_.limit; };
  if (std::all_of(part.own.corner, part.own.corner + 3, near)) return true;
  return nearest.distance > radius && solid_.winding().inside(center);  // inside, no point is further from the surface
}

/// A ball around the places of a part half-way, and how far a point of it moves until then.
struct MovingPartSearch::Ball {
  Triangle middle;
  Vec3 center;
  double radius = 0, way = 0;
};

MovingPartSearch::Ball MovingPartSearch::ball_around(const MovingPart& part) {
  Ball ball;
  ball.middle = mean(part.begin, part.end);
  ball.center = (ball.middle[0] + ball.middle[1] + ball.middle[2]) / 3;
  for (int i = 0; i < 3; ++i) {
    ball.radius = std::max(ball.radius, length(ball.middle[i] - ball.center));
    ball.way = std::max(ball.way, length(part.end[i] - part.begin[i]) / 2);
  }
  return ball;
}

MovingPartSearch::Result MovingPartSearch::find(const MovingPart& whole, std::size_t& pieces, std::size_t max_pieces,
                                                std::vector<ShallowPart>* shallow) const {
  std::vector<MovingPart> parts{whole};
  parts[0].was_near = rule_.thin && is_near(whole);
  NearestFaces last;
  const auto note = [&](const MovingPart& part, const ShallowProof& proof) {
    if (shallow) shallow->push_back({part.own, part.from, part.to, proof});
  };
  while (!parts.empty()) {
    if (++pieces > max_pieces || (pieces % kAsk == 0 && keep_going_ && !keep_going_())) {
      for (const MovingPart& left : parts) note(left, {ShallowReason::Unknown});
      return {{}, false};
    }
    MovingPart part = parts.back();
    parts.pop_back();
    ShallowProof proof;
    proof.larger = part.was_near ? LargerLimit::WasNear : LargerLimit::No;
    if (in_region(part, proof.larger)) {
      proof.reason = ShallowReason::Region;
      note(part, proof);
      continue;
    }
    const Ball ball = ball_around(part);
    const MeshDistance nearest = solid_.surface().distance(ball.center, last.of_solid);
    last.of_solid = nearest.face;
    if (find_proof(part, ball, nearest, last, proof)) {
      note(part, proof);
      continue;
    }
    part.was_near = proof.larger == LargerLimit::WasNear;
    const double time = (part.from + part.to) / 2;
    const Vec3 own = (part.own[0] + part.own[1] + part.own[2]) / 3;
    if (is_deep(own, ball.center, nearest.distance)) return {TimedPoint{time, part.face, own}, true};
    for (int i = 0; i < 3; ++i) {
      const Vec3 corner = ball.middle[i];
      if (nearest.distance + length(corner - ball.center) <= rule_.far_limit) continue;
      const double distance = solid_.surface().distance(corner, nearest.face, rule_.limit).distance;
      if (is_deep(part.own[i], corner, distance)) return {TimedPoint{time, part.face, part.own[i]}, true};
    }
    divide(part, nearest.face, parts);
  }
  return {};
}

/// True if a part stays in the region of its points.
bool MovingPartSearch::in_region(const MovingPart& part, LargerLimit larger) const {
  if (larger != LargerLimit::No && rule_.thin->everywhere()) return true;
  const ShallowRegion* region = larger == LargerLimit::No ? rule_.region : rule_.wider_region;
  return region && region->contains(PartHull(part));
}

/// True if a part stays in the hole. @param face of the hole, the one nearest to its middle
bool MovingPartSearch::in_hole(const MovingPart& part, const Ball& ball, std::uint32_t face) const {
  const SurfaceTree& surface = rule_.hole->surface();
  const std::array<Vec3, 6> corners = corners_of(part);
  if (near_two_faces(surface, Span<const Vec3>(corners.data(), corners.size()), face, rule_.limit)) return true;
  const WindingNumber& winding = rule_.hole->winding();
  if (!winding.closed()) return false;
  // A copy that is inside is no further than its shift.
  const double gap = winding.placement();
  const Vec3 inwards = -normalized(normal_unscaled(surface.triangle(face)));
  for (const Vec3 shift : {Vec3{}, std::max(0.0, rule_.limit - 4 * gap) * inwards})
    if (winding.inside(ball.center + shift) && clear_of(surface, PartHull(part, Span<const Vec3>(&shift, 1)), gap))
      return true;
  return false;
}

/// Finds out if far points of a part may get as deep as others, and why.
void MovingPartSearch::find_larger(const MovingPart& part, const Ball& ball, NearestFaces& last,
                                   ShallowProof& proof) const {
  if (is_near(part)) {
    proof.larger = LargerLimit::WasNear;
  } else if (rule_.hole) {
    proof.hole_face = last.of_hole = rule_.hole->surface().distance(ball.center, last.of_hole).face;
    if (in_hole(part, ball, proof.hole_face)) proof.larger = LargerLimit::InHole;
  }
}

/// Finds out why no point of a part gets too deep, other than by its region. @return false if that is not certain
/// @param proof with the limit, as far as it is known
bool MovingPartSearch::find_proof(const MovingPart& part, const Ball& ball, const MeshDistance& nearest,
                                  NearestFaces& last, ShallowProof& proof) const {
  // The simple reasons first: winding numbers of open meshes are expensive.
  const auto near_by_limit = [&] {
    proof.reason = ShallowReason::NearFaces;
    proof.face = nearest.face;
    const double limit = proof.larger == LargerLimit::No ? rule_.far_limit : rule_.limit;
    return near_faces(part, ball, nearest.face, nearest.distance, limit);
  };
  if (near_by_limit()) return true;
  const SurfaceTree* thick = rule_.thick_faces();
  if (thick && proof.larger == LargerLimit::No && nearest.distance <= rule_.limit) {
    const MeshDistance nearest_thick = thick->distance(ball.center, last.of_thick, rule_.limit);
    proof.reason = ShallowReason::ThickFaces;
    proof.face = last.of_thick = nearest_thick.face;
    if (nearest_thick.distance <= rule_.limit && near_thick_faces(part, proof.face)) return true;
  }
  proof.reason = ShallowReason::Ball;
  proof.face = nearest.face;
  if (ball_outside(solid_.winding(), ball.center, ball.radius + ball.way, nearest.distance)) return true;
  if (rule_.thin && proof.larger == LargerLimit::No) {
    find_larger(part, ball, last, proof);
    if (proof.larger != LargerLimit::No) {
      proof.reason = ShallowReason::Region;
      if (in_region(part, proof.larger) || near_by_limit()) return true;
    }
  }
  const std::optional<Vec3> shift = copy_outside(part, ball.center, ball.radius + ball.way, nearest.face, proof.larger);
  if (!shift) return false;
  proof.reason = ShallowReason::Copy;
  proof.shift = *shift;
  return true;
}

bool MovingPartSearch::holds(const ShallowProof& known, const MovingPart& part) const {
  // LargerLimit::WasNear is about the assembled state: it holds for every motion.
  if (known.reason == ShallowReason::Region && known.larger != LargerLimit::InHole)
    return in_region(part, known.larger);
  const Ball ball = ball_around(part);
  const double radius = ball.radius + ball.way;
  if (known.larger == LargerLimit::InHole && !in_hole(part, ball, known.hole_face)) return false;
  switch (known.reason) {
    case ShallowReason::Unknown:
      return false;
    case ShallowReason::Region:
      return in_region(part, known.larger);
    case ShallowReason::NearFaces: {
      const double distance = solid_.surface().distance_to_face(ball.center, known.face);
      const double limit = known.larger == LargerLimit::No ? rule_.far_limit : rule_.limit;
      return near_faces(part, ball, known.face, distance, limit);
    }
    case ShallowReason::ThickFaces:
      return near_thick_faces(part, known.face);
    case ShallowReason::Copy:
      return is_outside(part, ball.center, radius, known.shift, known.larger);
    case ShallowReason::Ball:
      return ball_outside(solid_.winding(), ball.center, radius,
                          solid_.surface().distance(ball.center, known.face).distance);
  }
  return false;
}

/// True if a part stays within a limit of the face that is nearest to its middle, or of another one.
/// @param distance of the middle from that face
bool MovingPartSearch::near_faces(const MovingPart& part, const Ball& ball, std::uint32_t nearest, double distance,
                                  double limit) const {
  if (distance + ball.radius + ball.way <= limit) return true;
  const std::array<Vec3, 6> corners = corners_of(part);
  return near_two_faces(solid_.surface(), Span<const Vec3>(corners.data(), corners.size()), nearest, limit);
}

/// The same of the faces that are not at a thin place. @param nearest its number among them
bool MovingPartSearch::near_thick_faces(const MovingPart& part, std::uint32_t nearest) const {
  const std::array<Vec3, 6> corners = corners_of(part);
  return near_two_faces(*rule_.thick_faces(), Span<const Vec3>(corners.data(), corners.size()), nearest, rule_.limit);
}

/// The shift of a copy of a part, by no more than its limit, that is outside: on the way there, a point that is
/// inside passes the surface, unless it passes a fan that closes a hole.
/// @param center, radius a ball around the part, the center half-way
std::optional<Vec3> MovingPartSearch::copy_outside(const MovingPart& part, Vec3 center, double radius,
                                                   std::uint32_t nearest, LargerLimit larger) const {
  const double margin = 4 * solid_.winding().placement();
  const bool is_far = larger == LargerLimit::No && !rule_.thick_faces();
  const double limit = is_far ? rule_.far_limit : rule_.limit;
  if (limit <= margin) return std::nullopt;
  const bool inside = solid_.winding().inside(center);
  if (!inside && is_outside(part, center, radius, {}, larger)) return Vec3{};
  const Triangle& face = solid_.surface().triangle(nearest);
  const Vec3 way = closest_point_of_triangle(face, center) - center;
  const Vec3 out = normalized(inside ? way : -way);
  Vec3 normal = normalized(normal_unscaled(face));
  if (dot(normal, out) < 0) normal = -normal;
  const Vec3 own = normalized(normal_unscaled(part.begin));
  const Vec3 directions[] = {normal, out, -own, own};
  for (int i = 0; i < 4; ++i) {
    const auto same = [&](const Vec3& known) { return dot(known, directions[i]) > kSameDirection; };
    if (std::any_of(directions, directions + i, same)) continue;
    const Vec3 shift = (limit - margin) * directions[i];
    if (is_outside(part, center, radius, shift, larger)) return shift;
  }
  return std::nullopt;
}

/// True if a part that is shifted is outside, and passes no fan on the way, nor a face at a thin place if it may be
/// far.
bool MovingPartSearch::is_outside(const MovingPart& part, Vec3 center, double radius, Vec3 shift,
                                  LargerLimit larger) const {
  const WindingNumber& winding = solid_.winding();
  const Vec3 shifts[] = {shift, {}};
  const double gap = winding.placement();
  if (!clear_of(solid_.surface(), PartHull(part, Span<const Vec3>(shifts, 1)), gap)) return false;
  if (rule_.thick_faces() && larger == LargerLimit::No &&
      !clear_of(*rule_.thin->thin_faces(), PartHull(part, Span<const Vec3>(shifts, 2)), gap, shift))
    return false;
  if (winding.closed()) return !winding.inside(center + shift);
  return clear_of(*winding.fans(), PartHull(part, Span<const Vec3>(shifts, 2)), gap) &&
         holes_do_not_matter(winding, center + shift, radius + length(shift));
}

/// Divides an edge where the faces nearest to its ends are as near, but no part twice in turn; else halves the time
/// or the edge along which the distance from the surface changes most. What lies deepest is often a line between two
/// faces, and each of its sides stays within the limit of one of them.
void MovingPartSearch::divide(const MovingPart& part, std::uint32_t nearest, std::vector<MovingPart>& parts) const {
  const Triangle middle = mean(part.begin, part.end);
  const Vec3 center = (middle[0] + middle[1] + middle[2]) / 3;
  const Triangle& face = solid_.surface().triangle(nearest);
  Vec3 across = normalized(closest_point_of_triangle(face, center) - center);
  if (!(length_squared(across) > 0)) across = normalized(normal_unscaled(face));
  // Lengths along the surface count as well, so that parts do not become too slender.
  const auto change = [&](Vec3 way) { return std::abs(dot(across, way)) + kAlong * length(way); };
  const auto size = [&](int i) { return change(middle[(i + 1) % 3] - middle[i]); };
  int first = 0;
  double share = 0.5, way = 0;
  for (int i = 0; i < 3; ++i) {
    if (size(i) > size(first)) first = i;
    way = std::max(way, change(part.end[i] - part.begin[i]));
  }
  const bool in_time = way > size(first);
  MovingPart one = part, other = part;
  one.at_ridge = other.at_ridge = !part.at_ridge && find_ridge(middle, nearest, first, share);
  if (in_time && !one.at_ridge) {
    one.end = other.begin = middle;
    one.to = other.from = (part.from + part.to) / 2;
  } else {
    const int next = (first + 1) % 3;
    for (Triangle MovingPart::*t : {&MovingPart::own, &MovingPart::begin, &MovingPart::end})
      (one.*t)[next] = (other.*t)[first] = (1 - share) * (part.*t)[first] + share * (part.*t)[next];
  }
  parts.push_back(other);
  parts.push_back(one);
}

/// True if there is no ridge between two faces.
bool MovingPartSearch::in_one_plane(std::uint32_t face, std::uint32_t other) const {
  const Triangle &a = solid_.surface().triangle(face), &b = solid_.surface().triangle(other);
  const Vec3 normal = normalized(normal_unscaled(a));
  return std::abs(dot(normal, normalized(normal_unscaled(b)))) > 1 - kSamePlane &&
         std::abs(dot(normal, a[0] - b[0])) < kSamePlaneOffset * rule_.limit;
}

bool MovingPartSearch::find_ridge(const Triangle& part, std::uint32_t nearest, int& edge, double& share) const {
  constexpr double kEnd = 0.1;
  constexpr int kHalvings = 12;
  std::uint32_t faces[3];
  for (int i = 0; i < 3; ++i) faces[i] = solid_.surface().distance(part[i], nearest).face;
  for (int k = 0; k < 3; ++k) {
    const int i = (edge + k) % 3, j = (i + 1) % 3;
    if (faces[i] == faces[j] || in_one_plane(faces[i], faces[j])) continue;
    double near_first = 0, near_second = 1;
    for (int step = 0; step < kHalvings; ++step) {
      const double middle = (near_first + near_second) / 2;
      const Vec3 p = (1 - middle) * part[i] + middle * part[j];
      const bool first =
          solid_.surface().distance_to_face(p, faces[i]) < solid_.surface().distance_to_face(p, faces[j]);
      (first ? near_first : near_second) = middle;
    }
    if (near_first < kEnd || near_first > 1 - kEnd) continue;
    edge = i;
    share = near_first;
    return true;
  }
  return false;
}

bool stays_shallow(const SolidShape& solid, const Triangle& from, const Triangle& to, double limit, std::size_t& pieces,
                   std::size_t max_pieces) {
  const MovingPartSearch::Result result =
      MovingPartSearch(solid, {limit, limit}).find({from, from, to}, pieces, max_pieces);
  return result.complete && !result.found;
}

}  // namespace dismantle
