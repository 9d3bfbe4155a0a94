// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/swept_depth.h"

#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/surface/depth/moving_part_search.h"

#include <algorithm>
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
/// An interval is given up, and a shorter one searched, after this share of the pieces.
constexpr std::size_t kShareOfPieces = 4;

/// One surface moving in the frame of the other.
class SweptSearch {
 public:
  using Found = MovingPartSearch::Found;
  using Result = MovingPartSearch::Result;

  SweptSearch(const SolidShape& own, const SolidShape& other, const RigidTransform& start, const RigidTransform& end,
              double limit, double far_limit, const KeepGoing& keep_going)
      : own_(own),
        other_(other),
        start_(start),
        end_(end),
        is_limited_(far_limit != limit),
        region_(other.shallow_region(std::min(limit, far_limit))),
        parts_(other, limit, std::min(limit, far_limit), &region_, keep_going) {}

  Vec3 at(Vec3 own, double time) const { return (1 - time) * (start_ * own) + time * (end_ * own); }

  bool is_deep(Vec3 own, double time) const { return parts_.is_deep(own, at(own, time)); }

  /// The point as a DeepPoint, without the time until which nothing is deep.
  DeepPoint deep_point(const Found& found, bool of_a) const {
    const Vec3 point = at(found.own, found.time);
    const std::uint32_t other_face = other_.surface().distance(point).face;
    const Vec3 nearest = closest_point_of_triangle(other_.surface().triangle(other_face), point);
    return {0, found.time, of_a, of_a ? found.face : other_face, of_a ? other_face : found.face, point, nearest};
  }

  /// A sampled point that is too deep at a time.
  std::optional<Found> sample(double time) const {
    if (!is_limited_) return std::nullopt;
    const SurfaceTree& own = own_.surface();
    const Aabb& box = other_.surface().bounds();
    const std::size_t stride = std::max<std::size_t>(1, own.face_count() / kSamples);
    for (std::size_t f = 0; f < own.face_count(); f += stride) {
      const Triangle& t = own.triangle(static_cast<std::uint32_t>(f));
      for (const Vec3 p : {(t[0] + t[1] + t[2]) / 3, t[0]}) {
        const Vec3 now = at(p, time);
        if (!overlaps(box, {now, now})) continue;
        ++samples_;
        if (parts_.is_deep(p, now)) return Found{time, static_cast<std::uint32_t>(f), p};
      }
    }
    return std::nullopt;
  }

  /// Number of sampled points that were near the other shape.
  std::size_t samples() const { return samples_; }

  /// Some point that is too deep in [from, to]; the pieces are counted.
  Result find(double from, double to, std::size_t& pieces, std::size_t max_pieces) const {
    if (!is_limited_) return {};
    std::vector<Piece> pieces_left{{own_.surface().bvh().root(), from, to}};
    while (!pieces_left.empty()) {
      if (++pieces > max_pieces) return {{}, false};
      const Piece piece = pieces_left.back();
      pieces_left.pop_back();
      const Aabb begin = box_at(piece.node, piece.from), end = box_at(piece.node, piece.to);
      Aabb both = begin;
      both.extend(end);
      if (region_.contains(both)) continue;
      const Bvh& bvh = own_.surface().bvh();
      if (piece.node < bvh.leaf_count()) {
        const MovingPart whole = part(bvh.leaf_triangle[piece.node], piece.from, piece.to);
        const Result in_face = parts_.find(whole, pieces, max_pieces);
        if (in_face.found || !in_face.complete) return in_face;
      } else if (length(end.center() - begin.center()) > diagonal(begin)) {
        const double middle = (piece.from + piece.to) / 2;
        pieces_left.push_back({piece.node, middle, piece.to});
        pieces_left.push_back({piece.node, piece.from, middle});
      } else {
        const BvhChildren children = bvh.children[piece.node - bvh.leaf_count()];
        pieces_left.push_back({children.left, piece.from, piece.to});
        pieces_left.push_back({children.right, piece.from, piece.to});
      }
    }
    return {};
  }

 private:
  MovingPart part(std::uint32_t face, double from, double to) const {
    const Triangle& own = own_.surface().triangle(face);
    return {own,
            {{at(own[0], from), at(own[1], from), at(own[2], from)}},
            {{at(own[0], to), at(own[1], to), at(own[2], to)}},
            from,
            to,
            face};
  }

  /// The box around some faces at a time, in the frame of the other shape.
  Aabb box_at(NodeIndex node, double time) const {
    const Aabb& own = own_.surface().box(node);
    Aabb box;
    for (unsigned i = 0; i < 8; ++i)
      box.extend(
          at({i & 1 ? own.upper.x : own.lower.x, i & 2 ? own.upper.y : own.lower.y, i & 4 ? own.upper.z : own.lower.z},
             time));
    return box;
  }

  /// Faces of the own surface during an interval of time.
  struct Piece {
    NodeIndex node;
    double from, to;
  };

  const SolidShape& own_;
  const SolidShape& other_;
  RigidTransform start_, end_;
  bool is_limited_;
  const ShallowRegion& region_;
  MovingPartSearch parts_;
  mutable std::size_t samples_ = 0;
};

/// Both surfaces of a pair, each moving in the frame of the other.
class PairSearch {
 public:
  PairSearch(const SweptPair& pair, const DepthLimits& limits, double resolution, std::size_t max_pieces,
             const KeepGoing& keep_going)
      : searches_{{*pair.a, *pair.b, pair.start, pair.end, limits.limit, limits.far_a, keep_going},
                  {*pair.b, *pair.a, inverse(pair.start), inverse(pair.end), limits.limit, limits.far_b, keep_going}},
        resolution_(resolution),
        max_pieces_(max_pieces),
        keep_going_(keep_going) {}

  /// A point that is too deep at some time, found by looking at ever later times.
  std::optional<DeepPoint> sampled() const {
    for (double time = kFirstPart * resolution_;; time *= 2) {
      for (const int of : {0, 1})
        if (const auto found = searches_[of].sample(std::min(1.0, time)))
          return searches_[of].deep_point(*found, of == 0);
      if (time >= 1) return std::nullopt;
    }
  }

  /// Number of points and pieces examined.
  std::size_t cost() const { return pieces_ + searches_[0].samples() + searches_[1].samples(); }

  std::optional<DeepPoint> find(DeepSearch search_for) {
    double to = kFirstPart * resolution_;
    if (search_for == DeepSearch::Any)
      if (const auto found = sampled()) return found;
    for (;;) {
      // A point that is known to be deep leaves a shorter motion to search.
      const double end = known_ ? known_->time - resolution_ : 1;
      if (free_until_ >= end || (known_ && search_for == DeepSearch::Any)) break;
      to = std::min(to, end);
      if (search(to)) {
        to = std::max(kPartGrowth * free_until_, free_until_ + resolution_);
        continue;
      }
      const double shorter = (to - free_until_) / kPartGrowth;
      if (shorter < resolution_ || pieces_ > max_pieces_ ||
          (keep_going_ && !keep_going_())) {  // undecided: as if a point were deep
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
  const KeepGoing& keep_going_;
  std::size_t pieces_ = 0;  // examined so far
  double free_until_ = 0;
  std::optional<SweptSearch::Found> known_;
  int of_ = 0;
};

}  // namespace

std::optional<DeepPoint> first_deeper(const SweptPair& pair, const DepthLimits& limits, double resolution,
                                      std::size_t max_pieces, const KeepGoing& keep_going, DeepSearch search_for,
                                      std::size_t* cost) {
  if (pair.a->empty() || pair.b->empty()) return std::nullopt;
  PairSearch search(pair, limits, resolution, max_pieces, keep_going);
  std::optional<DeepPoint> found = search.find(search_for);
  if (cost) *cost += search.cost();
  return found;
}

}  // namespace dismantle
