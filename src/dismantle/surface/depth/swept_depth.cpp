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
/// An interval is given up, and a shorter one searched, after this share of the pieces, but not before so many.
constexpr std::size_t kShareOfPieces = 4, kFewPieces = 50000;
/// As many nodes or known parts take as long as a piece that is examined.
constexpr std::size_t kKnownInPiece = 8;
/// An attempt with known parts ends after this many new pieces; points are then sampled before the full search.
constexpr std::size_t kNewPieces = 1000;
/// An interval that is longer than a resolution by this share is as long.
constexpr double kSameLength = 1e-6;

/// One surface moving in the frame of the other.
class SweptSearch {
 public:
  using Found = MovingPartSearch::Found;
  using Result = MovingPartSearch::Result;

  SweptSearch(const SolidShape& own, const SolidShape& other, const RigidTransform& start, const RigidTransform& end,
              double limit, double far_limit, ShallowParts* known, const KeepGoing& keep_going)
      : own_(own),
        other_(other),
        start_(start),
        end_(end),
        is_limited_(far_limit != limit),
        region_(other.shallow_region(std::min(limit, far_limit))),
        known_(known),
        parts_(other, limit, std::min(limit, far_limit), &region_, keep_going) {}

  Vec3 at(Vec3 own, double time) const { return (1 - time) * (start_ * own) + time * (end_ * own); }

  bool is_deep(Vec3 own, double time) const { return parts_.is_deep(own, at(own, time)); }

  /// The point as a DeepPoint, without the time until which nothing is deep.
  DeepPoint deep_point(const Found& found, bool of_a) const {
    const Vec3 point = at(found.own, found.time);
    const std::uint32_t other_face = other_.surface().distance(point).face;
    const Vec3 nearest = closest_point_of_triangle(other_.surface().triangle(other_face), point);
    return {true, 0, found.time, of_a, of_a ? found.face : other_face, of_a ? other_face : found.face, point, nearest};
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

  /// The cost of the search apart from pieces: the points sampled, and nodes and known parts by their time.
  std::size_t others() const { return samples_ + visited_ / kKnownInPiece; }

  /// Some point that is too deep in [from, to]; the pieces are counted.
  Result find(double from, double to, std::size_t& pieces, std::size_t max_pieces) const {
    return search(from, to, [&](const MovingPart& face) {
      if (!known_) return parts_.find(face, pieces, max_pieces);
      if (known_->of(face.face)) return find_in_known(face, pieces, max_pieces);
      std::vector<ShallowPart> parts;
      Result result = parts_.find(face, pieces, max_pieces, &parts);
      if (result.found) parts.clear();
      take_shares(parts, 0, face);
      known_->set(face.face, std::move(parts));
      return result;
    });
  }

  /// True if nothing gets too deep in [from, to], nearly everywhere for reasons that are known; false says nothing.
  bool is_shallow_again(double from, double to, std::size_t& pieces) const {
    if (!is_limited_) return true;
    if (!known_ || (known_->deep && is_deep(*known_->deep, to))) return false;
    const std::size_t enough = pieces + kNewPieces;
    const Result result = search(from, to, [&](const MovingPart& face) {
      return known_->of(face.face) ? find_in_known(face, pieces, enough) : Result{{}, false};
    });
    return result.complete && !result.found;
  }

  /// Notes a point that is too deep, for the next motion; none: nothing is.
  void note_deep(std::optional<Vec3> own) const {
    if (known_) known_->deep = own;
  }

 private:
  /// Visits the faces that are not certainly shallow, in parts of [from, to], as long as the results are complete and
  /// without a point.
  template <class Visit>
  Result search(double from, double to, const Visit& in_face) const {
    if (!is_limited_) return {};
    std::vector<Piece> pieces_left{{own_.surface().bvh().root(), from, to}};
    while (!pieces_left.empty()) {
      if (++visited_ > kMaxSweptPieces) return {{}, false};
      const Piece piece = pieces_left.back();
      pieces_left.pop_back();
      const Aabb begin = box_at(piece.node, piece.from), end = box_at(piece.node, piece.to);
      Aabb both = begin;
      both.extend(end);
      if (region_.contains(both)) continue;
      const Bvh& bvh = own_.surface().bvh();
      if (piece.node < bvh.leaf_count()) {
        const std::uint32_t face = bvh.leaf_triangle[piece.node];
        const Result result = in_face(part(own_.surface().triangle(face), face, piece.from, piece.to));
        if (result.found || !result.complete) return result;
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

  /// Searches the known parts of a face, which are divided further where their reasons do not hold.
  Result find_in_known(const MovingPart& face, std::size_t& pieces, std::size_t max_pieces) const {
    std::vector<ShallowPart> parts;
    if (const std::size_t fewer = known_->due(face.face)) {
      const Result result = parts_.find(face, pieces, std::min(max_pieces, pieces + fewer), &parts);
      if (result.found) return result;
      if (result.complete) {
        take_shares(parts, 0, face);
        known_->set(face.face, std::move(parts));
        return result;
      }
      parts.clear();
    }
    const std::vector<ShallowPart>& known = *known_->of(face.face);
    const double duration = face.to - face.from;
    bool is_refined = false;
    Result result;
    for (std::size_t i = 0; i < known.size() && !result.found; ++i) {
      const ShallowPart& one = known[i];
      const MovingPart now = part(one.own, face.face, face.from + one.from * duration, face.from + one.to * duration);
      ++visited_;
      if (!result.complete || parts_.holds(one, now)) {
        parts.push_back(one);
        continue;
      }
      const std::size_t before = parts.size();
      result = parts_.find(now, pieces, max_pieces, &parts);
      take_shares(parts, before, face);
      is_refined = true;
    }
    if (is_refined && !result.found) known_->refine(face.face, std::move(parts));
    return result;
  }

  /// Makes the times of the parts from the first one on shares of that of a face.
  static void take_shares(std::vector<ShallowPart>& parts, std::size_t first, const MovingPart& face) {
    for (std::size_t i = first; i < parts.size(); ++i) {
      parts[i].from = (parts[i].from - face.from) / (face.to - face.from);
      parts[i].to = (parts[i].to - face.from) / (face.to - face.from);
    }
  }

  MovingPart part(const Triangle& own, std::uint32_t face, double from, double to) const {
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
  ShallowParts* known_;
  MovingPartSearch parts_;
  mutable std::size_t samples_ = 0;
  mutable std::size_t visited_ = 0;
};

/// Both surfaces of a pair, each moving in the frame of the other.
class PairSearch {
 public:
  PairSearch(const SweptPair& pair, const DepthLimits& limits, double resolution, std::size_t max_pieces,
             const KeepGoing& keep_going)
      : searches_{{*pair.a, *pair.b, pair.start, pair.end, limits.limit, limits.far_a, pair.known_a, keep_going},
                  {*pair.b, *pair.a, inverse(pair.start), inverse(pair.end), limits.limit, limits.far_b, pair.known_b,
                   keep_going}},
        resolution_(resolution),
        until_(pair.until),
        max_pieces_(max_pieces),
        keep_going_(keep_going) {}

  /// A point that is too deep at some time, found by looking at ever later times.
  std::optional<DeepPoint> sampled() const {
    for (double time = kFirstPart * resolution_;; time *= 2) {
      for (const int of : {0, 1})
        if (const auto found = searches_[of].sample(std::min(until_, time)))
          return searches_[of].deep_point(*found, of == 0);
      if (time >= until_) return std::nullopt;
    }
  }

  /// Number of points and pieces examined.
  std::size_t cost() const { return pieces_ + recalled_ + searches_[0].others() + searches_[1].others(); }

  std::optional<DeepPoint> find(DeepSearch search_for) {
    double to = kFirstPart * resolution_;
    double back = resolution_;  // points next to a deep one mostly are deep a little earlier: ever longer steps back
    if (search_for == DeepSearch::Any)
      if (const auto found = sampled()) return found;
    if (is_again_shallow(until_)) return std::nullopt;
    for (;;) {
      // A point that is known to be deep leaves a shorter motion to search.
      const double end = known_ ? known_->time - resolution_ : until_;
      if (free_until_ >= end || (known_ && search_for == DeepSearch::Any)) break;
      to = std::min(to, end);
      if (known_) to = std::min(to, std::max(free_until_ + resolution_, known_->time - back));
      const double free_before = free_until_;
      if (search(to)) {
        back = free_until_ > free_before ? resolution_ : 2 * back;
        to = std::max(kPartGrowth * free_until_, free_until_ + resolution_);
        continue;
      }
      const double shorter = std::max(resolution_, (to - free_until_) / kPartGrowth);
      if (to - free_until_ <= (1 + kSameLength) * resolution_ || pieces_ > max_pieces_ ||
          (keep_going_ && !keep_going_())) {  // undecided: as if a point were deep
        is_certain_ = false;
        if (!known_) known_ = SweptSearch::Found{to, 0, {}};
        known_->time = std::min(known_->time, to);
        break;
      }
      to = free_until_ + shorter;
    }
    for (const int of : {0, 1})
      searches_[of].note_deep(known_ && is_certain_ && of == of_ ? std::optional(known_->own) : std::nullopt);
    if (!known_) return std::nullopt;
    DeepPoint point = searches_[of_].deep_point(*known_, of_ == 0);
    point.is_certain = is_certain_;
    point.free_until = free_until_;
    return point;
  }

 private:
  /// True if it is free up to a time for reasons that are known.
  bool is_again_shallow(double to) {
    if (recalled_ > max_pieces_ / 2) return false;
    return searches_[0].is_shallow_again(free_until_, to, recalled_) &&
           searches_[1].is_shallow_again(free_until_, to, recalled_);
  }

  /// Searches up to a time: either it is free until then, or an earlier deep point is known. @return false if undecided
  bool search(double to) {
    if (is_again_shallow(to)) {
      free_until_ = to;
      return true;
    }
    for (const int of : {0, 1})
      if (const auto found = searches_[of].sample(to)) return know(*found, of);
    const std::size_t enough = pieces_ + std::max(max_pieces_ / kShareOfPieces, std::min(max_pieces_, kFewPieces));
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
  double until_;
  std::size_t max_pieces_;
  const KeepGoing& keep_going_;
  std::size_t pieces_ = 0;    // examined so far
  std::size_t recalled_ = 0;  // examined for reasons that were known
  double free_until_ = 0;
  std::optional<SweptSearch::Found> known_;
  bool is_certain_ = true;
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
