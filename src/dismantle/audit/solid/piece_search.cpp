// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/piece_search.h"

#include "dismantle/audit/solid/piece_tests.h"
#include "dismantle/audit/triangle_axes.h"

#include <algorithm>
#include <limits>

namespace dismantle::audit {

namespace {

/// Time is divided where arcs are further from their chords than this part of the slack.
constexpr double kDeviationPart = 0.25;
/// The nearest of so many faces is found by comparing all of them, of more with the tree.
constexpr std::size_t kFewFaces = 12;
/// The node of the whole surface.
constexpr std::uint32_t kRoot[] = {0};
/// A piece faces neither towards nor away from what it is near where this cosine is smaller.
constexpr double kAcross = 0.2;
/// Directions of faces that differ by less than this count once [cosine].
constexpr double kSameDirection = 0.99;

double squared_distance_of_boxes(const Aabb& a, const Aabb& b) {
  const Vec3 apart = max(max(a.lower - b.upper, b.lower - a.upper), Vec3{});
  return dot(apart, apart);
}

Aabb box_of(const Triangle& t) {
  Aabb box;
  for (int k = 0; k < 3; ++k) box.extend(t[k]);
  return box;
}

/// A box around a piece, without the deviation of its arcs.
Aabb box_of(const SurfacePiece& piece) {
  Aabb box;
  for (const Vec3& p : piece.corner) box.extend(p);
  return box;
}

/// The sum of the different outward directions of the faces that are within `distance` of a point, of unit length.
Vec3 common_direction(const SolidBody& solid, Span<const std::uint32_t> faces, Vec3 point, double distance) {
  std::vector<Vec3> directions;
  Vec3 sum;
  for (const std::uint32_t f : faces) {
    const Triangle t = solid.surface().triangle(f);
    if (distance_to_triangle(t, point) > distance) continue;
    const Vec3 normal = solid.orientation() * unit_normal(t);
    const auto same = [&](Vec3 other) { return dot(normal, other) > kSameDirection; };
    if (std::any_of(directions.begin(), directions.end(), same)) continue;
    directions.push_back(normal);
    sum += normal;
  }
  return normalized(sum);
}

}  // namespace

PieceSearch::PieceSearch(const SolidBody& solid, const DepthGoal& goal, double rounding)
    : solid_(solid), goal_(goal), rounding_(rounding) {}

double PieceSearch::limit() const {
  const double found = goal_.growth * findings_.deepest.depth + goal_.slack / 2;
  return std::max(goal_.floor + goal_.slack, findings_.first.depth > 0 ? found : 0);
}

bool PieceSearch::ended() const {
  return (goal_.first_only && findings_.first.depth > 0) ||
         (goal_.max_pieces > 0 && findings_.samples >= goal_.max_pieces);
}

void PieceSearch::search(const TimeSlice& slice, const Triangle& triangle, const NearNodes& near) {
  const SurfacePiece piece = make_piece(slice, triangle);
  faces_.clear();
  add_faces(box_of(piece), near.reach + piece.deviation, near.nodes);
  // A piece that does not meet the surface is outside if one of its points is.
  if (faces_.empty() && solid_.outside_throughout(piece.center, piece.radius, near.reach, last_point_)) return;
  check(slice, triangle, {0, faces_.size(), near.reach});
}

PieceSearch::Range PieceSearch::near_faces(const SurfacePiece& piece, const Range& parent) {
  const Aabb box = box_of(piece);
  Range near{faces_.size(), 0, limit()};
  const double reach = near.reach + piece.deviation;
  if (parent.reach < near.reach) {  // the limit has risen since
    add_faces(box, reach, Span<const std::uint32_t>(kRoot, 1));
  } else {
    for (std::size_t i = parent.first; i < parent.first + parent.count; ++i) {
      const std::uint32_t f = faces_[i];
      if (squared_distance_of_boxes(box, box_of(solid_.surface().triangle(f))) <= reach * reach) faces_.push_back(f);
    }
  }
  near.count = faces_.size() - near.first;
  return near;
}

void PieceSearch::add_faces(const Aabb& box, double reach, Span<const std::uint32_t> below) {
  open_.assign(below.begin(), below.end());
  while (!open_.empty()) {
    const std::uint32_t i = open_.back();
    open_.pop_back();
    const BoxNode& node = solid_.surface().node(i);
    if (squared_distance_of_boxes(box, {node.center - node.half, node.center + node.half}) > reach * reach) continue;
    if (node.leaf()) {
      faces_.push_back(node.face);
    } else {
      open_.push_back(node.right);
      open_.push_back(i + 1);
    }
  }
}

PieceSearch::Nearest PieceSearch::nearest_face(const SurfacePiece& piece, const Range& parent) {
  Nearest nearest{std::numeric_limits<double>::infinity(), last_face_};
  if (parent.count <= kFewFaces) {
    for (std::size_t i = parent.first; i < parent.first + parent.count; ++i) {
      const double distance = distance_to_triangle(solid_.surface().triangle(faces_[i]), piece.center);
      if (distance < nearest.distance) nearest = {distance, faces_[i]};
    }
  }
  if (nearest.distance > parent.reach) {
    const SurfacePoint closest = solid_.surface().closest(piece.center, nearest.face);
    nearest = {closest.distance, closest.face};
  }
  last_face_ = nearest.face;
  return nearest;
}

bool PieceSearch::clear_when_shifted(const SurfacePiece& piece, Vec3 shift, const Range& near) {
  const Span<const std::uint32_t> faces(faces_.data() + near.first, near.count);
  if (!passes_clear(piece, shift, solid_.surface(), faces, rounding_)) return false;
  const double way = solid_.closed() ? 0 : length(shift);
  return solid_.outside_throughout(piece.center + shift, piece.radius + way, 0, last_point_);
}

bool PieceSearch::ghost_is_clear(const SurfacePiece& piece, const Range& near, const Nearest& nearest, bool inside) {
  const Triangle face = solid_.surface().triangle(nearest.face);
  const Vec3 normal = solid_.orientation() * unit_normal(face);
  Vec3 away = normal;
  if (nearest.distance > 1e3 * rounding_) {
    const Vec3 offset = normalized(piece.center - closest_point(face, piece.center));
    away = inside ? -offset : offset;
  }
  Vec3 own = normalized(cross(piece.corner[1] - piece.corner[0], piece.corner[2] - piece.corner[0]));
  if (dot(own, away) < 0) own = -own;
  const double most = near.reach - piece.deviation - rounding_;
  const double least = (inside ? nearest.distance : 0) + 4 * goal_.slack;
  const auto is_clear_along = [&](Vec3 direction) {
    if (direction == Vec3{}) return false;
    return clear_when_shifted(piece, most * direction, near) ||
           (least < 0.7 * most && clear_when_shifted(piece, least * direction, near));
  };
  if (is_clear_along(own) || (dot(own, away) < kAcross && is_clear_along(-own)) || is_clear_along(away)) return true;
  if (!(away == normal) && is_clear_along(normal)) return true;
  const Span<const std::uint32_t> faces(faces_.data() + near.first, near.count);
  if (is_clear_along(common_direction(solid_, faces, piece.center, std::min(near.reach, piece.radius)))) return true;
  // A large piece along an edge of its surface touches faces that its middle is far from.
  return piece.radius > near.reach &&
         is_clear_along(common_direction(solid_, faces, piece.center, piece.radius + near.reach));
}

bool PieceSearch::near_surface(const SurfacePiece& piece, const Nearest& nearest) const {
  const double limit = this->limit() - rounding_;
  if (nearest.distance + piece.radius <= limit) return true;
  if (nearest.distance > limit) return false;
  const Triangle face = solid_.surface().triangle(nearest.face);
  if (stays_within(piece, face, limit)) return true;
  // Half-way between the two faces of a plate, a piece is within the limit of both together.
  const auto nearer = [&](Vec3 a, Vec3 b) { return distance_to_triangle(face, a) < distance_to_triangle(face, b); };
  const Vec3 far = *std::max_element(piece.corner, piece.corner + 6, nearer);
  const SurfacePoint other = solid_.surface().closest(far, nearest.face);
  return other.distance <= limit && other.face != nearest.face &&
         stays_within_either(piece, face, solid_.surface().triangle(other.face), limit);
}

bool PieceSearch::stays_outside(const SurfacePiece& piece, const Range& near, const Nearest& nearest) {
  const bool inside = solid_.inside(piece.center, last_point_);
  if (!inside) {
    // A point that gets inside across the surface is no deeper than the way to it, in a small piece.
    const bool small = piece.radius <= limit() - rounding_;
    if (small && (solid_.closed() || solid_.outside_throughout(piece.center, piece.radius, 0, last_point_)))
      return true;
    if (piece.radius <= goal_.slack / 4) return true;  // in the opening of a surface
    if (clear_when_shifted(piece, {}, near)) return true;
  }
  return near.count > 0 && ghost_is_clear(piece, near, nearest, inside);
}

void PieceSearch::sample(const TimeSlice& slice, const SurfacePiece& piece) {
  const double s = slice.middle();
  const Vec3 body = (piece.body[0] + piece.body[1] + piece.body[2]) / 3.0;
  const Vec3 point = slice.motion->at(s) * body;
  const SurfacePoint closest = solid_.surface().closest(point, last_face_);
  if (!(closest.distance > std::max(goal_.floor + rounding_, findings_.deepest.depth)) ||
      !solid_.inside(point, last_point_))
    return;
  const DepthSample found{closest.distance, slice.segment, s, true, point};
  findings_.deepest = found;
  if (findings_.first.depth == 0 && found.depth > goal_.floor + goal_.slack / 2) findings_.first = found;
}

void PieceSearch::check(const TimeSlice& slice, const Triangle& triangle, const Range& parent) {
  if (ended()) return;
  ++findings_.samples;
  const SurfacePiece piece = make_piece(slice, triangle);
  const Nearest nearest = nearest_face(piece, parent);
  if (near_surface(piece, nearest)) return;
  const std::size_t before = faces_.size();
  const Range near = near_faces(piece, parent);
  // The face that is most likely in the way is tested first.
  const auto begin = faces_.begin() + static_cast<std::ptrdiff_t>(near.first);
  const auto at = std::find(begin, faces_.end(), nearest.face);
  if (at != faces_.end()) std::iter_swap(begin, at);
  if (!stays_outside(piece, near, nearest)) {
    const double known = std::max(goal_.floor, findings_.deepest.depth);
    if (nearest.distance + piece.deviation > known) sample(slice, piece);
    divide(slice, piece, near);
  }
  faces_.resize(before);
}

void PieceSearch::divide(const TimeSlice& slice, const SurfacePiece& piece, const Range& near) {
  int longest = 0;
  double edge[3];
  for (int k = 0; k < 3; ++k) {
    edge[k] = length(piece.body[(k + 1) % 3] - piece.body[k]);
    if (edge[k] > edge[longest]) longest = k;
  }
  if (piece.movement > edge[longest] || piece.deviation > kDeviationPart * goal_.slack) {
    TimeSlice half = slice;
    half.to = slice.middle();
    half.end = slice.motion->at(half.to);
    check(half, piece.body, near);
    half.from = half.to;
    half.start = half.end;
    half.to = slice.to;
    half.end = slice.end;
    check(half, piece.body, near);
    return;
  }
  const int next = (longest + 1) % 3;
  const Vec3 middle = (piece.body[longest] + piece.body[next]) / 2.0;
  Triangle half = piece.body;
  half[next] = middle;
  check(slice, half, near);
  half = piece.body;
  half[longest] = middle;
  check(slice, half, near);
}

}  // namespace dismantle::audit
