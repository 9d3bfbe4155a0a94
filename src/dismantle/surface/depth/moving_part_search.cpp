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
/// Two faces are in one plane where the cosine between their normals is this near to 1, and they are off each other's
/// plane by no more than this share of the limit.
constexpr double kSamePlane = 1e-6, kSamePlaneOffset = 1e-3;

Triangle mean(const Triangle& s, const Triangle& t) {
  return {{(s[0] + t[0]) / 2, (s[1] + t[1]) / 2, (s[2] + t[2]) / 2}};
}

/// True if a hull is certainly further than `gap` from a surface.
bool clear_of(const SurfaceTree& surface, const PartHull& hull, double gap) {
  const Bvh& bvh = surface.bvh();
  int seen = 0;
  std::vector<NodeIndex> nodes{bvh.root()};
  while (!nodes.empty()) {
    const NodeIndex node = nodes.back();
    nodes.pop_back();
    if (!hull.may_meet(surface.box(node), gap)) continue;
    if (node >= bvh.leaf_count()) {
      const BvhChildren children = bvh.children[node - bvh.leaf_count()];
      nodes.push_back(children.left);
      nodes.push_back(children.right);
      continue;
    }
    if (++seen > kMaxCopyFaces || !hull.apart(surface.triangle(bvh.leaf_triangle[node]), gap)) return false;
  }
  return true;
}

}  // namespace

bool MovingPartSearch::is_deep(Vec3 own, Vec3 point) const {
  return is_deep(own, point, solid_.surface().distance(point).distance);
}

bool MovingPartSearch::is_deep(Vec3 own, Vec3 point, double distance) const {
  if (distance <= far_limit_) return false;
  if (distance <= limit_ && solid_.surface().distance(own).distance <= limit_) return false;
  return solid_.winding().inside(point);
}

bool MovingPartSearch::is_unlimited(const MovingPart& part) const {
  if (far_limit_ == limit_) return false;
  const Vec3 center = (part.own[0] + part.own[1] + part.own[2]) / 3;
  double radius = 0;
  for (int i = 0; i < 3; ++i) radius = std::max(radius, length(part.own[i] - center));
  const MeshDistance nearest = solid_.surface().distance(center);
  if (nearest.distance + radius <= limit_) return true;
  const auto near = [&](Vec3 p) { return solid_.surface().distance_to_face(p, nearest.face) <= limit_; };
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
  std::uint32_t last = 0;
  const auto note = [&](const MovingPart& part, const ShallowProof& proof) {
    if (shallow) shallow->push_back({part.own, part.from, part.to, proof});
  };
  while (!parts.empty()) {
    if (++pieces > max_pieces || (pieces % kAsk == 0 && keep_going_ && !keep_going_())) {
      for (const MovingPart& left : parts) note(left, {ShallowReason::Unknown});
      return {{}, false};
    }
    const MovingPart part = parts.back();
    parts.pop_back();
    if (region_ && region_->contains(PartHull(part))) {
      note(part, {ShallowReason::Region});
      continue;
    }
    const Ball ball = ball_around(part);
    const MeshDistance nearest = solid_.surface().distance(ball.center, last);
    last = nearest.face;
    if (const std::optional<ShallowProof> proof = shallow_proof(part, ball, nearest)) {
      note(part, *proof);
      continue;
    }
    const double time = (part.from + part.to) / 2;
    const Vec3 own = (part.own[0] + part.own[1] + part.own[2]) / 3;
    if (is_deep(own, ball.center, nearest.distance)) return {TimedPoint{time, part.face, own}, true};
    for (int i = 0; i < 3; ++i) {
      const Vec3 corner = ball.middle[i];
      if (nearest.distance + length(corner - ball.center) <= far_limit_) continue;
      const double distance = solid_.surface().distance(corner, nearest.face).distance;
      if (is_deep(part.own[i], corner, distance)) return {TimedPoint{time, part.face, part.own[i]}, true};
    }
    divide(part, nearest.face, parts);
  }
  return {};
}

/// Why no point of a part gets too deep, if that is certain.
std::optional<ShallowProof> MovingPartSearch::shallow_proof(const MovingPart& part, const Ball& ball,
                                                            const MeshDistance& nearest) const {
  ShallowProof proof{ShallowReason::NearFaces, nearest.face};
  // The simple reasons first: winding numbers of open meshes are expensive.
  if (nearest.distance + ball.radius + ball.way <= far_limit_ || near_faces(part, nearest.face)) return proof;
  proof.reason = ShallowReason::Ball;
  if (ball_outside(solid_.winding(), ball.center, ball.radius + ball.way, nearest.distance)) return proof;
  proof.reason = ShallowReason::Unlimited;
  if (is_unlimited(part)) return proof;
  proof.reason = ShallowReason::Copy;
  const std::optional<Vec3> shift = copy_outside(part, ball.center, ball.radius + ball.way, nearest.face);
  if (!shift) return std::nullopt;
  proof.shift = *shift;
  return proof;
}

bool MovingPartSearch::holds(const ShallowProof& known, const MovingPart& part) const {
  if (known.reason == ShallowReason::Unlimited) return true;  // does not depend on the motion
  if (known.reason == ShallowReason::Unknown) return false;
  if (known.reason == ShallowReason::Region) return region_ && region_->contains(PartHull(part));
  const Ball ball = ball_around(part);
  const double radius = ball.radius + ball.way;
  if (known.reason == ShallowReason::NearFaces)
    return solid_.surface().distance_to_face(ball.center, known.face) + radius <= far_limit_ ||
           near_faces(part, known.face);
  if (known.reason == ShallowReason::Copy) return is_outside(part, ball.center, radius, known.shift);
  return ball_outside(solid_.winding(), ball.center, radius,
                      solid_.surface().distance(ball.center, known.face).distance);
}

/// True if a part stays within the limit of the face that is nearest to its middle, or of another one.
bool MovingPartSearch::near_faces(const MovingPart& part, std::uint32_t nearest) const {
  Vec3 corners[6];
  for (int i = 0; i < 3; ++i) corners[i] = part.begin[i], corners[3 + i] = part.end[i];
  return near_two_faces(solid_.surface(), Span<const Vec3>(corners, 6), nearest, far_limit_);
}

/// The shift of a copy of a part, by no more than the limit, that is outside: on the way there, a point that is
/// inside passes the surface, unless it passes a fan that closes a hole.
/// @param center, radius a ball around the part, the center half-way
std::optional<Vec3> MovingPartSearch::copy_outside(const MovingPart& part, Vec3 center, double radius,
                                                   std::uint32_t nearest) const {
  const double margin = 4 * solid_.winding().placement();
  if (far_limit_ <= margin) return std::nullopt;
  const bool inside = solid_.winding().inside(center);
  if (!inside && is_outside(part, center, radius, {})) return Vec3{};
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
    const Vec3 shift = (far_limit_ - margin) * directions[i];
    if (is_outside(part, center, radius, shift)) return shift;
  }
  return std::nullopt;
}

/// True if a part that is shifted is outside, and passes no fan on the way.
bool MovingPartSearch::is_outside(const MovingPart& part, Vec3 center, double radius, Vec3 shift) const {
  const WindingNumber& winding = solid_.winding();
  const Vec3 shifts[] = {shift, {}};
  const double gap = winding.placement();
  if (!clear_of(solid_.surface(), PartHull(part, Span<const Vec3>(shifts, 1)), gap)) return false;
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
         std::abs(dot(normal, a[0] - b[0])) < kSamePlaneOffset * limit_;
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
      MovingPartSearch(solid, limit, limit, nullptr).find({from, from, to}, pieces, max_pieces);
  return result.complete && !result.found;
}

}  // namespace dismantle
