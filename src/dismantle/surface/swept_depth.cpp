// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/swept_depth.h"

#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/surface/solid_depth.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dismantle {

namespace {

/// Sampled faces of each surface.
constexpr std::size_t kSamples = 4000;

/// The first part of a motion that is searched, in resolutions of time, and by how much each part ends later than the
/// one before: what lies behind a contact costs most.
constexpr double kFirstPart = 16, kPartGrowth = 8;

/// A triangle, or a part of one, during an interval of time: corners at its begin and its end.
struct MovingPart {
  Triangle begin, end;
  double from = 0, to = 1;
  std::uint32_t face = 0;
};

/// A ball around something during an interval.
struct Ball {
  Vec3 center;
  double radius = 0;
};

Triangle mean(const Triangle& s, const Triangle& t) {
  return {{(s[0] + t[0]) / 2, (s[1] + t[1]) / 2, (s[2] + t[2]) / 2}};
}

/// One surface moving in the frame of the other.
class SweptSearch {
 public:
  SweptSearch(const SolidShape& own, const SolidShape& other, const RigidTransform& start, const RigidTransform& end,
              double limit)
      : own_(own), other_(other), start_(start), end_(end), limit_(limit) {}

  /// What was found.
  struct Found {
    double time = 0;
    std::uint32_t face = 0, other_face = 0;
    Vec3 point, nearest;   // in the frame of the other
    bool unknown = false;  // there were too many pieces
  };

  /// A sampled point that is too deep at a time.
  std::optional<Found> sample(double time) const {
    const SurfaceTree& own = own_.surface();
    const Aabb& box = other_.surface().bounds();
    const std::size_t stride = std::max<std::size_t>(1, own.face_count() / kSamples);
    for (std::size_t f = 0; f < own.face_count(); f += stride) {
      const Triangle& t = own.triangle(static_cast<std::uint32_t>(f));
      const Triangle now{{at(t[0], time), at(t[1], time), at(t[2], time)}};
      const MovingPart part{now, now, time, time, static_cast<std::uint32_t>(f)};
      for (const Vec3 p : {(now[0] + now[1] + now[2]) / 3, now[0]})
        if (overlaps(box, {p, p}))
          if (const auto found = deep_at(part, p)) return found;
    }
    return std::nullopt;
  }

  /// Some point that is too deep in [from, to], or one without a face where there are too many pieces; these are
  /// counted.
  std::optional<Found> find(double from, double to, std::size_t& pieces, std::size_t max_pieces) const {
    std::vector<NodeIndex> nodes{own_.surface().bvh().root()};
    while (!nodes.empty()) {
      if (++pieces > max_pieces) return unknown(to);
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
      if (auto found = find_in_face(bvh.leaf_triangle[node], from, to, pieces, max_pieces)) return found;
    }
    return std::nullopt;
  }

 private:
  Vec3 at(Vec3 own, double time) const { return (1 - time) * (start_ * own) + time * (end_ * own); }

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
    const double change = winding.max_change(ball.center, ball.radius);
    return change < 1 && std::abs(winding.at(ball.center)) + change < 0.5 + kUndecidedWinding;
  }

  std::optional<Found> find_in_face(std::uint32_t face, double from, double to, std::size_t& pieces,
                                    std::size_t max_pieces) const {
    const Triangle& own = own_.surface().triangle(face);
    std::vector<MovingPart> parts{{{{at(own[0], from), at(own[1], from), at(own[2], from)}},
                                   {{at(own[0], to), at(own[1], to), at(own[2], to)}},
                                   from,
                                   to,
                                   face}};
    while (!parts.empty()) {
      if (++pieces > max_pieces) return unknown(to);
      const MovingPart part = parts.back();
      parts.pop_back();
      const Triangle middle = mean(part.begin, part.end);
      Ball ball{(middle[0] + middle[1] + middle[2]) / 3, 0};
      double way = 0;
      for (int i = 0; i < 3; ++i) {
        ball.radius = std::max(ball.radius, length(middle[i] - ball.center));
        way = std::max(way, length(part.end[i] - part.begin[i]) / 2);
      }
      const MeshDistance nearest = other_.surface().distance(ball.center);
      if (nearest.distance + ball.radius + way <= limit_) continue;
      if (near_face(part, nearest.face)) continue;
      if (outside({ball.center, ball.radius + way}, nearest.distance)) continue;
      for (const Vec3 p : {ball.center, middle[0], middle[1], middle[2]})
        if (const auto found = deep_at(part, p)) return found;
      divide(part, way > ball.radius, parts);
    }
    return std::nullopt;
  }

  /// True if a part stays within the limit of one face of the other surface.
  bool near_face(const MovingPart& part, std::uint32_t face) const {
    for (const Triangle* t : {&part.begin, &part.end})
      for (int i = 0; i < 3; ++i)
        if (other_.surface().distance_to_face((*t)[i], face) > limit_) return false;
    return true;
  }

  static Found unknown(double to) {
    Found found;
    found.time = to;
    found.unknown = true;
    return found;
  }

  std::optional<Found> deep_at(const MovingPart& part, Vec3 point) const {
    const MeshDistance nearest = other_.surface().distance(point);
    if (nearest.distance <= limit_ || !other_.winding().inside(point)) return std::nullopt;
    const Vec3 there = closest_point_of_triangle(other_.surface().triangle(nearest.face), point);
    return Found{(part.from + part.to) / 2, part.face, nearest.face, point, there, false};
  }

  static void divide(const MovingPart& part, bool in_time, std::vector<MovingPart>& parts) {
    if (in_time) {
      const Triangle middle = mean(part.begin, part.end);
      const double time = (part.from + part.to) / 2;
      parts.push_back({middle, part.end, time, part.to, part.face});
      parts.push_back({part.begin, middle, part.from, time, part.face});
      return;
    }
    int longest = 0;
    const auto size = [&](int i) { return length_squared(part.begin[(i + 1) % 3] - part.begin[i]); };
    for (int i = 1; i < 3; ++i)
      if (size(i) > size(longest)) longest = i;
    const int next = (longest + 1) % 3;
    MovingPart first = part, second = part;
    first.begin[next] = second.begin[longest] = (part.begin[longest] + part.begin[next]) / 2;
    first.end[next] = second.end[longest] = (part.end[longest] + part.end[next]) / 2;
    parts.push_back(first);
    parts.push_back(second);
  }

  const SolidShape& own_;
  const SolidShape& other_;
  RigidTransform start_, end_;
  double limit_;
};

}  // namespace

namespace {

DeepPoint deep_point(const SweptSearch::Found& f, bool of_a) {
  return {0, f.time, of_a, of_a ? f.face : f.other_face, of_a ? f.other_face : f.face, f.point, f.nearest};
}

}  // namespace

std::optional<DeepPoint> first_deeper(const SweptPair& pair, double limit, double resolution, std::size_t max_pieces) {
  if (pair.a->empty() || pair.b->empty()) return std::nullopt;
  const SweptSearch searches[2] = {{*pair.a, *pair.b, pair.start, pair.end, limit},
                                   {*pair.b, *pair.a, inverse(pair.start), inverse(pair.end), limit}};
  std::optional<DeepPoint> first;
  // Points that are found soon leave a shorter motion to search.
  const auto too_deep = [&](double from, double to) {
    for (const bool sampled : {true, false}) {
      std::size_t pieces = 0;
      for (const int of : {0, 1}) {
        const auto found = sampled ? searches[of].sample(to) : searches[of].find(from, to, pieces, max_pieces);
        if (!found) continue;
        if (!found->unknown || !first) first = deep_point(*found, of == 0);
        first->time = found->time;
        return true;
      }
    }
    return false;
  };
  double free_until = 0;
  for (double to = std::min(1.0, kFirstPart * resolution); !too_deep(free_until, to);
       to = std::min(1.0, kPartGrowth * to)) {
    if (to == 1) return std::nullopt;
    free_until = to;
  }
  while (first->time - free_until > resolution) {
    const double middle = (free_until + first->time) / 2;
    if (!too_deep(free_until, middle)) free_until = middle;
  }
  first->free_until = free_until;
  return first;
}

}  // namespace dismantle
