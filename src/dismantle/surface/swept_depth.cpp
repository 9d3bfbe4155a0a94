// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/swept_depth.h"

#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/surface/solid_depth.h"

#include "dismantle/core/span.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace dismantle {

namespace {

/// Sampled faces of each surface.
constexpr std::size_t kSamples = 2000;

/// The first part of a motion that is searched, in resolutions of time, and by how much each part ends later than the
/// one before: what lies behind a contact costs most.
constexpr double kFirstPart = 16, kPartGrowth = 8;
/// Times of a known deep point are found to within this share of the resolution.
constexpr double kTimeShare = 0.25;
/// A shifted copy is given up where its box meets the boxes of more faces than this.
constexpr int kMaxCopyFaces = 1000;
/// An interval is given up, and a shorter one searched, after this share of the pieces.
constexpr std::size_t kShareOfPieces = 4;
/// Two directions are tried as one where the cosine between them is above this.
constexpr double kSameDirection = 1 - 1e-9;

/// A triangle, or a part of one, during an interval of time: corners in its own frame, and in that of the other surface
/// at begin and end.
struct MovingPart {
  Triangle own, begin, end;
  double from = 0, to = 1;
  std::uint32_t face = 0;
  bool at_ridge = false;  // it was divided where two faces of the other surface are as near
};

/// A ball around something during an interval.
struct Ball {
  Vec3 center;
  double radius = 0;
};

Triangle mean(const Triangle& s, const Triangle& t) {
  return {{(s[0] + t[0]) / 2, (s[1] + t[1]) / 2, (s[2] + t[2]) / 2}};
}

/// The hull of all places of a part and of copies of it, each shifted: tells if an axis separates it from a triangle.
class PartHull {
 public:
  PartHull(const MovingPart& part, Span<const Vec3> shifts) {
    for (const Vec3& shift : shifts)
      for (const Triangle* t : {&part.begin, &part.end})
        for (const Vec3& p : t->corner) {
          corner_[count_++] = p + shift;
          box_.extend(p + shift);
        }
    normal_ = normalized(normal_unscaled(part.begin));
    lower_ = upper_ = dot(normal_, corner_[0]);
    for (int i = 1; i < count_; ++i) {
      lower_ = std::min(lower_, dot(normal_, corner_[i]));
      upper_ = std::max(upper_, dot(normal_, corner_[i]));
    }
  }

  /// True if it may meet a box that is larger by `gap`; across the part, it is thinner than its own box is.
  bool may_meet(const Aabb& box, double gap) const {
    if (!overlaps(box_, {box.lower - Vec3{gap, gap, gap}, box.upper + Vec3{gap, gap, gap}})) return false;
    const Vec3 half = (box.upper - box.lower) / 2;
    const double reach =
        std::abs(normal_.x) * half.x + std::abs(normal_.y) * half.y + std::abs(normal_.z) * half.z + 2 * gap;
    const double middle = dot(normal_, box.center());
    return middle - reach <= upper_ && middle + reach >= lower_;
  }

  /// True if some axis certainly separates it by more than `gap`.
  bool apart(const Triangle& face, double gap) const {
    if (apart_along(normal_unscaled(face), face, gap)) return true;
    const Triangle begin{{corner_[0], corner_[1], corner_[2]}};
    if (apart_along(normal_unscaled(begin), face, gap)) return true;
    const Vec3 way = corner_[3] - corner_[0];
    for (int i = 0; i < 3; ++i) {
      const Vec3 edge = face[(i + 1) % 3] - face[i];
      for (int k = 0; k < 3; ++k)
        if (apart_along(cross(begin[(k + 1) % 3] - begin[k], edge), face, gap)) return true;
      if (apart_along(cross(way, edge), face, gap)) return true;
    }
    return false;
  }

 private:
  bool apart_along(Vec3 axis, const Triangle& face, double gap) const {
    const double size = length(axis);
    if (!(size > 0)) return false;
    double lower = dot(axis, corner_[0]), upper = lower;
    for (int i = 1; i < count_; ++i) {
      const double along = dot(axis, corner_[i]);
      lower = std::min(lower, along);
      upper = std::max(upper, along);
    }
    const double f[3] = {dot(axis, face[0]), dot(axis, face[1]), dot(axis, face[2])};
    return std::min({f[0], f[1], f[2]}) - upper > gap * size || lower - std::max({f[0], f[1], f[2]}) > gap * size;
  }

  std::array<Vec3, 12> corner_;
  int count_ = 0;
  Aabb box_;
  Vec3 normal_;                   // of the part
  double lower_ = 0, upper_ = 0;  // along it
};

/// One surface moving in the frame of the other.
class SweptSearch {
 public:
  SweptSearch(const SolidShape& own, const SolidShape& other, const RigidTransform& start, const RigidTransform& end,
              double limit)
      : own_(own), other_(other), start_(start), end_(end), limit_(limit) {}

  /// A point that is too deep at a time.
  struct Found {
    double time = 0;
    std::uint32_t face = 0;  // that it is on
    Vec3 own;                // in its own frame
  };
  /// The point, or that there were too many pieces.
  struct Result {
    std::optional<Found> found;
    bool complete = true;
  };

  Vec3 at(Vec3 own, double time) const { return (1 - time) * (start_ * own) + time * (end_ * own); }

  bool is_deep(Vec3 own, double time) const { return is_deep(at(own, time)); }

  /// The point as a DeepPoint, without the time until which nothing is deep.
  DeepPoint deep_point(const Found& found, bool of_a) const {
    const Vec3 point = at(found.own, found.time);
    const std::uint32_t other_face = other_.surface().distance(point).face;
    const Vec3 nearest = closest_point_of_triangle(other_.surface().triangle(other_face), point);
    return {0, found.time, of_a, of_a ? found.face : other_face, of_a ? other_face : found.face, point, nearest};
  }

  /// A sampled point that is too deep at a time.
  std::optional<Found> sample(double time) const {
    const SurfaceTree& own = own_.surface();
    const Aabb& box = other_.surface().bounds();
    const std::size_t stride = std::max<std::size_t>(1, own.face_count() / kSamples);
    for (std::size_t f = 0; f < own.face_count(); f += stride) {
      const Triangle& t = own.triangle(static_cast<std::uint32_t>(f));
      for (const Vec3 p : {(t[0] + t[1] + t[2]) / 3, t[0]}) {
        const Vec3 now = at(p, time);
        if (overlaps(box, {now, now}) && is_deep(now)) return Found{time, static_cast<std::uint32_t>(f), p};
      }
    }
    return std::nullopt;
  }

  /// Some point that is too deep in [from, to]; the pieces are counted.
  Result find(double from, double to, std::size_t& pieces, std::size_t max_pieces) const {
    std::vector<NodeIndex> nodes{own_.surface().bvh().root()};
    while (!nodes.empty()) {
      if (++pieces > max_pieces) return {{}, false};
      const NodeIndex node = nodes.back();
      nodes.pop_back();
      if (within(node, from, to)) continue;
      const Bvh& bvh = own_.surface().bvh();
      if (node >= bvh.leaf_count()) {
        const BvhChildren children = bvh.children[node - bvh.leaf_count()];
        nodes.push_back(children.left);
        nodes.push_back(children.right);
        continue;
      }
      const Result in_face = find_in_face(bvh.leaf_triangle[node], from, to, pieces, max_pieces);
      if (in_face.found || !in_face.complete) return in_face;
    }
    return {};
  }

 private:
  bool is_deep(Vec3 point) const {
    return other_.surface().distance(point).distance > limit_ && other_.winding().inside(point);
  }

  bool within(NodeIndex node, double from, double to) const {
    const Aabb& box = own_.surface().box(node);
    const Vec3 center = box.center();
    const Vec3 begin = at(center, from), end = at(center, to);
    return within({(begin + end) / 2, diagonal(box) / 2 + length(end - begin) / 2});
  }

  /// True if no point of a ball is too deep, for one of two simple reasons.
  bool within(const Ball& ball) const {
    const MeshDistance nearest = other_.surface().distance(ball.center);
    return nearest.distance + ball.radius <= limit_ || outside(ball, nearest.distance);
  }

  bool outside(const Ball& ball, double distance) const {
    if (distance <= ball.radius) return false;
    const WindingNumber& winding = other_.winding();
    if (winding.closed()) return !winding.inside(ball.center);
    if (winding.fans()->distance(ball.center).distance > ball.radius && holes_do_not_matter(ball)) return true;
    const double change = winding.max_change(ball.center, ball.radius);
    return change < 1 && std::abs(winding.at(ball.center)) + change < 0.5 + kUndecidedWinding;
  }

  /// True if the mesh closed by its fans is not around the center of a ball, nor do the holes by themselves make an
  /// inside of any point of the ball.
  bool holes_do_not_matter(const Ball& ball) const {
    return other_.winding().bound_outside_fans(ball.center, ball.radius) < 0.5 + kUndecidedWinding;
  }

  Result find_in_face(std::uint32_t face, double from, double to, std::size_t& pieces, std::size_t max_pieces) const {
    const Triangle& own = own_.surface().triangle(face);
    std::vector<MovingPart> parts{{own,
                                   {{at(own[0], from), at(own[1], from), at(own[2], from)}},
                                   {{at(own[0], to), at(own[1], to), at(own[2], to)}},
                                   from,
                                   to,
                                   face}};
    std::uint32_t last = 0;
    while (!parts.empty()) {
      if (++pieces > max_pieces) return {{}, false};
      const MovingPart part = parts.back();
      parts.pop_back();
      const Triangle middle = mean(part.begin, part.end);
      Ball ball{(middle[0] + middle[1] + middle[2]) / 3, 0};
      double way = 0;
      for (int i = 0; i < 3; ++i) {
        ball.radius = std::max(ball.radius, length(middle[i] - ball.center));
        way = std::max(way, length(part.end[i] - part.begin[i]) / 2);
      }
      const MeshDistance nearest = other_.surface().distance(ball.center, last);
      last = nearest.face;
      if (nearest.distance + ball.radius + way <= limit_) continue;
      if (near_face(part, nearest.face)) continue;
      if (outside({ball.center, ball.radius + way}, nearest.distance)) continue;
      if (copy_outside(part, {ball.center, ball.radius + way}, nearest)) continue;
      const double time = (part.from + part.to) / 2;
      const Vec3 center = (part.own[0] + part.own[1] + part.own[2]) / 3;
      for (const Vec3 p : {center, part.own[0], part.own[1], part.own[2]})
        if (is_deep(p, time)) return {Found{time, part.face, p}, true};
      divide(part, nearest, way > ball.radius, parts);
    }
    return {};
  }

  /// True if a part stays within the limit of one face of the other surface.
  bool near_face(const MovingPart& part, std::uint32_t face) const {
    for (const Triangle* t : {&part.begin, &part.end})
      for (int i = 0; i < 3; ++i)
        if (other_.surface().distance_to_face((*t)[i], face) > limit_) return false;
    return true;
  }

  /// True if a copy of a part that is shifted by no more than the limit is outside: on the way there, a point that is
  /// inside passes the surface, unless it passes a fan that closes a hole.
  /// @param ball around the part, its center half-way
  bool copy_outside(const MovingPart& part, const Ball& ball, const MeshDistance& nearest) const {
    const double margin = 4 * other_.winding().placement();
    if (limit_ <= margin) return false;
    const bool inside = other_.winding().inside(ball.center);
    if (!inside && is_outside(part, ball, {})) return true;
    const Triangle& face = other_.surface().triangle(nearest.face);
    const Vec3 way = closest_point_of_triangle(face, ball.center) - ball.center;
    const Vec3 out = normalized(inside ? way : -way);
    Vec3 normal = normalized(normal_unscaled(face));
    if (dot(normal, out) < 0) normal = -normal;
    const Vec3 own = normalized(normal_unscaled(part.begin));
    const Vec3 directions[] = {normal, out, -own, own};
    for (int i = 0; i < 4; ++i) {
      const auto same = [&](const Vec3& known) { return dot(known, directions[i]) > kSameDirection; };
      if (std::any_of(directions, directions + i, same)) continue;
      if (is_outside(part, ball, (limit_ - margin) * directions[i])) return true;
    }
    return false;
  }

  /// True if a part that is shifted is outside, and passes no fan on the way.
  bool is_outside(const MovingPart& part, const Ball& ball, Vec3 shift) const {
    const WindingNumber& winding = other_.winding();
    const Vec3 shifts[] = {shift, {}};
    if (!clear_of(other_.surface(), PartHull(part, Span<const Vec3>(shifts, 1)))) return false;
    if (winding.closed()) return !winding.inside(ball.center + shift);
    return clear_of(*winding.fans(), PartHull(part, Span<const Vec3>(shifts, 2))) &&
           holes_do_not_matter({ball.center + shift, ball.radius + length(shift)});
  }

  bool clear_of(const SurfaceTree& surface, const PartHull& hull) const {
    const double gap = other_.winding().placement();
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

  /// Divides an edge where the faces nearest to its ends are as near, but no part twice in turn; else halves the time
  /// or the longest edge. What lies deepest is often a line between two faces, and each of its sides stays within the
  /// limit of one of them.
  void divide(const MovingPart& part, const MeshDistance& nearest, bool in_time, std::vector<MovingPart>& parts) const {
    int first = 0;
    double share = 0.5;
    const auto size = [&](int i) { return length_squared(part.own[(i + 1) % 3] - part.own[i]); };
    for (int i = 1; i < 3; ++i)
      if (size(i) > size(first)) first = i;
    const Triangle middle = mean(part.begin, part.end);
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

  bool find_ridge(const Triangle& part, const MeshDistance& nearest, int& edge, double& share) const {
    constexpr double kEnd = 0.1;
    constexpr int kHalvings = 12;
    std::uint32_t faces[3];
    for (int i = 0; i < 3; ++i) faces[i] = other_.surface().distance(part[i], nearest.face).face;
    for (int k = 0; k < 3; ++k) {
      const int i = (edge + k) % 3, j = (i + 1) % 3;
      if (faces[i] == faces[j]) continue;
      double near_first = 0, near_second = 1;
      for (int step = 0; step < kHalvings; ++step) {
        const double middle = (near_first + near_second) / 2;
        const Vec3 p = (1 - middle) * part[i] + middle * part[j];
        const bool first =
            other_.surface().distance_to_face(p, faces[i]) < other_.surface().distance_to_face(p, faces[j]);
        (first ? near_first : near_second) = middle;
      }
      if (near_first < kEnd || near_first > 1 - kEnd) continue;
      edge = i;
      share = near_first;
      return true;
    }
    return false;
  }

  const SolidShape& own_;
  const SolidShape& other_;
  RigidTransform start_, end_;
  double limit_;
};

/// Both surfaces of a pair, each moving in the frame of the other.
class PairSearch {
 public:
  PairSearch(const SweptPair& pair, double limit, double resolution, std::size_t max_pieces)
      : searches_{{*pair.a, *pair.b, pair.start, pair.end, limit},
                  {*pair.b, *pair.a, inverse(pair.start), inverse(pair.end), limit}},
        resolution_(resolution),
        max_pieces_(max_pieces) {}

  std::optional<DeepPoint> first() {
    double to = kFirstPart * resolution_;
    for (;;) {
      // A point that is known to be deep leaves a shorter motion to search.
      const double end = known_ ? known_->time - resolution_ : 1;
      if (free_until_ >= end) break;
      to = std::min(to, end);
      if (search(to)) {
        to = std::max(kPartGrowth * free_until_, free_until_ + resolution_);
        continue;
      }
      const double shorter = (to - free_until_) / kPartGrowth;
      if (shorter < resolution_ || pieces_ > max_pieces_) {  // undecided: as if a point were deep
        if (!known_) known_ = SweptSearch::Found{to, 0, {}};
        known_->time = std::min(known_->time, to);
        break;
      }
      to = free_until_ + shorter;
    }
    if (!known_) return std::nullopt;
    DeepPoint point = searches_[of_].deep_point(*known_, of_ == 0);
    point.free_until = free_until_;
    return point;
  }

 private:
  /// Searches up to a time: either it is free until then, or an earlier deep point is known. @return false if undecided
  bool search(double to) {
    for (const int of : {0, 1})
      if (const auto found = searches_[of].sample(to)) return know(*found, of);
    const std::size_t enough = pieces_ + max_pieces_ / kShareOfPieces;
    for (const int of : {0, 1}) {
      const SweptSearch::Result result = searches_[of].find(free_until_, to, pieces_, enough);
      if (result.found) return know(*result.found, of);
      if (!result.complete) return false;
    }
    free_until_ = to;
    return true;
  }

  /// Takes a deep point at the earliest time since which it is deep, as far as halving finds it.
  bool know(SweptSearch::Found found, int of) {
    double shallow = free_until_;
    while (found.time - shallow > kTimeShare * resolution_) {
      const double middle = (shallow + found.time) / 2;
      if (searches_[of].is_deep(found.own, middle)) {
        found.time = middle;
      } else {
        shallow = middle;
      }
    }
    known_ = found;
    of_ = of;
    return true;
  }

  SweptSearch searches_[2];
  double resolution_;
  std::size_t max_pieces_;
  std::size_t pieces_ = 0;  // looked at so far
  double free_until_ = 0;
  std::optional<SweptSearch::Found> known_;
  int of_ = 0;
};

}  // namespace

std::optional<DeepPoint> first_deeper(const SweptPair& pair, double limit, double resolution, std::size_t max_pieces) {
  if (pair.a->empty() || pair.b->empty()) return std::nullopt;
  return PairSearch(pair, limit, resolution, max_pieces).first();
}

}  // namespace dismantle
