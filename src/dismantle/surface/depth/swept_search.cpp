// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/swept_search.h"

#include "dismantle/narrowphase/closest_points.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dismantle {

namespace {

/// One face is sampled for this many pieces that the search may examine, within the limits below.
constexpr std::size_t kPiecesPerSample = 6;
/// Maximum and minimum number of faces that are sampled.
constexpr std::size_t kSamples = 2000, kFewestSamples = 100;
/// As many nodes or known parts take as long as a piece that is examined.
constexpr std::size_t kKnownInPiece = 8;
/// An attempt with known parts ends after this many new pieces; points are then sampled before the full search.
constexpr std::size_t kNewPieces = 1000;

/// Faces of the surface during an interval of time.
struct TimedNode {
  NodeIndex node;
  double from, to;
};

/// Turns the times of the parts from index `first` on into shares of the interval of a face.
void take_shares(std::vector<ShallowPart>& parts, std::size_t first, const MovingPart& face) {
  for (std::size_t i = first; i < parts.size(); ++i) {
    parts[i].from = (parts[i].from - face.from) / (face.to - face.from);
    parts[i].to = (parts[i].to - face.from) / (face.to - face.from);
  }
}

}  // namespace

InterpolatedTransform::InterpolatedTransform(const RigidTransform& start, const RigidTransform& end, double at)
    : time(at), translation((1 - at) * start.translation + at * end.translation) {
  for (int i = 0; i < 3; ++i) matrix.row[i] = (1 - at) * start.rotation.row[i] + at * end.rotation.row[i];
}

Aabb InterpolatedTransform::operator*(const Aabb& own) const {
  const Vec3 center = *this * own.center(), half = own.size() / 2;
  Vec3 reach;
  for (int i = 0; i < 3; ++i) {
    const Vec3& row = matrix.row[i];
    reach[i] = std::abs(row.x) * half.x + std::abs(row.y) * half.y + std::abs(row.z) * half.z;
  }
  return {center - reach, center + reach};
}

InterpolatedTransform InterpolatedTransform::along(const Mat3& axes) const {
  InterpolatedTransform result = *this;
  result.matrix = matrix * transposed(axes);
  return result;
}

SweptSearch::SweptSearch(const SolidShape& own, const SolidShape& other, const RigidTransform& start,
                         const RigidTransform& end, const DepthRule& rule, bool is_limited, ShallowParts* known,
                         const KeepGoing& keep_going)
    : own_(own),
      other_(other),
      start_(start),
      end_(end),
      is_limited_(is_limited),
      rule_(rule),
      known_(known),
      parts_(other, rule_, keep_going) {}

std::optional<ShallowParts::EndedAt> SweptSearch::begin() {
  if (!known_ || !known_->begin(start_, end_)) return std::nullopt;
  return std::exchange(known_->ended_at, std::nullopt);
}

std::optional<TimedPoint> SweptSearch::sample(double time, std::size_t max_pieces) {
  if (!is_limited_) return std::nullopt;
  const std::size_t most = std::clamp(max_pieces / kPiecesPerSample, kFewestSamples, kSamples);
  const auto& [now, of_boxes] = at(time);
  const SurfaceTree& own = own_.surface();
  const Bvh& bvh = own.bvh();
  std::vector<NodeIndex> nodes{bvh.root()};
  std::size_t faces = 0;
  std::uint32_t last = 0;
  while (!nodes.empty() && faces < most) {
    const NodeIndex node = nodes.back();
    nodes.pop_back();
    ++visited_;
    if (rule_.region->contains(of_boxes * own.box(node))) continue;
    if (node >= bvh.leaf_count()) {
      const BvhChildren children = bvh.children[node - bvh.leaf_count()];
      nodes.push_back(children.left);
      nodes.push_back(children.right);
      continue;
    }
    const std::uint32_t face = bvh.leaf_triangle[node];
    const Triangle& t = own.triangle(face);
    ++faces;
    for (const Vec3 p : {(t[0] + t[1] + t[2]) / 3, t[0]})
      if (is_deep_sample(p, now * p, last)) return TimedPoint{time, face, p};
  }
  return std::nullopt;
}

std::optional<TimedPoint> SweptSearch::sample_evenly(double time, std::size_t faces) {
  if (!is_limited_) return std::nullopt;
  const InterpolatedTransform& now = at(time).now;
  const Bvh& bvh = own_.surface().bvh();
  const std::size_t stride = (bvh.leaf_count() + faces - 1) / faces;
  std::uint32_t last = 0;
  for (std::size_t leaf = stride / 2; leaf < bvh.leaf_count(); leaf += stride) {
    const std::uint32_t face = bvh.leaf_triangle[leaf];
    const Triangle& t = own_.surface().triangle(face);
    const Vec3 own = (t[0] + t[1] + t[2]) / 3, place = now * own;
    if (!overlaps(other_.surface().bounds(), {place, place})) continue;
    if (is_deep_sample(own, place, last)) return TimedPoint{time, face, own};
  }
  return std::nullopt;
}

/// True if a sampled point is too deep. @param last the face from which its distance is searched, then the nearest one
bool SweptSearch::is_deep_sample(Vec3 own, Vec3 place, std::uint32_t& last) {
  ++samples_;
  const MeshDistance nearest = other_.surface().distance(place, last, rule_.limit);
  last = nearest.face;
  return parts_.is_deep(own, place, nearest.distance);
}

SweptSearch::Result SweptSearch::find(double from, double to, std::size_t& pieces, std::size_t max_pieces) {
  return search(from, to, [&](const MovingPart& face) {
    if (!known_) return parts_.find(face, pieces, max_pieces);
    if (known_->of(face.face)) return find_in_known(face, pieces, max_pieces);
    std::vector<ShallowPart> parts;
    Result result = parts_.find(face, pieces, max_pieces, &parts);
    if (result.found) parts.clear();
    keep(face, std::move(parts));
    return result;
  });
}

bool SweptSearch::is_shallow_again(double from, double to, std::size_t& pieces, std::size_t max_pieces) {
  if (!is_limited_) return true;
  if (!known_ || (known_->deep && is_deep(*known_->deep, to))) return false;
  const std::size_t enough = std::min(max_pieces, pieces + kNewPieces);
  const Result result = search(from, to, [&](const MovingPart& face) {
    return known_->of(face.face) ? find_in_known(face, pieces, enough) : Result{{}, false};
  });
  return result.complete && !result.found;
}

DeepPoint SweptSearch::deep_point(const TimedPoint& found, bool of_a) const {
  const Vec3 point = InterpolatedTransform(start_, end_, found.time) * found.own;
  const std::uint32_t other_face = other_.surface().distance(point).face;
  const Vec3 nearest = closest_point_of_triangle(other_.surface().triangle(other_face), point);
  return {true, 0, found.time, of_a, of_a ? found.face : other_face, of_a ? other_face : found.face, point, nearest};
}

std::size_t SweptSearch::others() const {
  return samples_ + visited_ / kKnownInPiece;
}

/// Visits the faces that are not certainly shallow, in parts of [from, to], as long as the results are complete and
/// without a point.
template <class Visit>
SweptSearch::Result SweptSearch::search(double from, double to, const Visit& in_face) {
  if (!is_limited_) return {};
  std::vector<TimedNode> waiting{{own_.surface().bvh().root(), from, to}};
  while (!waiting.empty()) {
    if (++visited_ > kMaxSweptPieces) return {{}, false};
    const TimedNode next = waiting.back();
    waiting.pop_back();
    const Aabb& own = own_.surface().box(next.node);
    const Aabb begin = at(next.from).of_boxes * own, end = at(next.to).of_boxes * own;
    Aabb both = begin;
    both.extend(end);
    if (rule_.region->contains(both)) continue;
    const Bvh& bvh = own_.surface().bvh();
    if (next.node < bvh.leaf_count()) {
      const std::uint32_t face = bvh.leaf_triangle[next.node];
      const Result result = in_face(part(own_.surface().triangle(face), face, next.from, next.to));
      if (result.found || !result.complete) return result;
    } else if (length(end.center() - begin.center()) > diagonal(begin)) {
      const double middle = (next.from + next.to) / 2;
      waiting.push_back({next.node, middle, next.to});
      waiting.push_back({next.node, next.from, middle});
    } else {
      const BvhChildren children = bvh.children[next.node - bvh.leaf_count()];
      waiting.push_back({children.left, next.from, next.to});
      waiting.push_back({children.right, next.from, next.to});
    }
  }
  return {};
}

/// Searches the known parts of a face, which are divided further where their reasons do not hold.
SweptSearch::Result SweptSearch::find_in_known(const MovingPart& face, std::size_t& pieces, std::size_t max_pieces) {
  std::vector<ShallowPart> parts;
  const std::size_t proved = known_->proved(face.face, face.from, face.to);
  if (const std::size_t fewer = proved > 0 ? 0 : known_->due(face.face)) {
    const Result result = parts_.find(face, pieces, std::min(max_pieces, pieces + fewer), &parts);
    if (result.found) return result;
    if (result.complete) {
      keep(face, std::move(parts));
      return result;
    }
    parts.clear();
  }
  const std::vector<ShallowPart>& known = *known_->of(face.face);
  const double duration = face.to - face.from;
  bool is_refined = false;
  Result result;
  std::size_t i = 0;
  for (; i < known.size() && !result.found && result.complete; ++i) {
    const ShallowPart& one = known[i];
    if (i < proved && one.proof.reason != ShallowReason::Unknown) {
      parts.push_back(one);
      continue;
    }
    const MovingPart now = part(one.own, face.face, face.from + one.from * duration, face.from + one.to * duration);
    ++visited_;
    if (parts_.holds(one.proof, now)) {
      parts.push_back(one);
      continue;
    }
    const std::size_t before = parts.size();
    result = parts_.find(now, pieces, max_pieces, &parts);
    take_shares(parts, before, face);
    is_refined = true;
  }
  if (result.found) return result;
  // After an early end, the parts that are left were not tested.
  const std::size_t now_proved = parts.size() + std::max(i, proved) - i;
  if (is_refined) {
    parts.insert(parts.end(), known.begin() + static_cast<std::ptrdiff_t>(i), known.end());
    known_->refine(face.face, std::move(parts));
  }
  known_->note_proved(face.face, now_proved, face.from, face.to);
  return result;
}

/// Keeps the parts into which a search of a whole face divided it.
void SweptSearch::keep(const MovingPart& face, std::vector<ShallowPart> parts) {
  take_shares(parts, 0, face);
  const std::size_t count = parts.size();
  known_->set(face.face, std::move(parts));
  known_->note_proved(face.face, count, face.from, face.to);
}

MovingPart SweptSearch::part(const Triangle& own, std::uint32_t face, double from, double to) {
  return {own, at(from).now * own, at(to).now * own, from, to, face};
}

/// The placement of the surface at a time; most times are among the last ones.
const SweptSearch::Placement& SweptSearch::at(double time) {
  for (const Placement& known : recent_)
    if (known.now.time == time) return known;
  Placement& oldest = recent_[next_recent_++ % recent_.size()];
  oldest.now = InterpolatedTransform(start_, end_, time);
  oldest.of_boxes = oldest.now.along(own_.surface().axes());
  return oldest;
}

}  // namespace dismantle
