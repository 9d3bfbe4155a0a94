// SPDX-License-Identifier: Apache-2.0
#include "dismantle/engine/vertex_depth_guard.h"

#include "dismantle/narrowphase/closest_points.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>

namespace dismantle {

namespace {

/// A vertex whose slack is below this share of the tolerance has used it up.
constexpr double kResolutionShare = 0.05;
/// Less than this share of the tolerance is rounding.
constexpr double kNoticeableShare = 1e-3;
/// What a distance may be off by, relative to the coordinates.
constexpr double kDistanceRounding = 1e-13;
/// A sphere is cut where the surface is nearer to its center than this share of its radius, whatever the exact
/// distance.
constexpr double kNearShare = 0.25;
/// Spheres are joined where the surface is that many radii away from what holds both.
constexpr double kJoinedClear = 2;
/// Spheres that have to be looked at, a task.
constexpr std::size_t kTaskSpheres = 16;
/// A face holds what keeps this share of the resolution.
constexpr double kHeldShare = 0.1;
/// How often, in quarters, a way is shortened for one face to hold it.
constexpr int kFaceTries = 4;

double min_altitude(const TriangleMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle t = mesh.triangle(f);
    const double longest = std::max({length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])});
    least = std::min(least, length(normal_unscaled(t)) / longest);
  }
  return least;
}

Pose pose_from_transform(const RigidTransform& t) {
  return {t.translation, quat_from_mat3(t.rotation)};
}

}  // namespace

/// The motion of a side's inner component as the outer one sees it, and what becomes of watched spheres on it.
class VertexDepthGuard::Course {
 public:
  /// A ball without any surface in it, where the outer component is at rest.
  struct Ball {
    Vec3 center;
    double clear = -std::numeric_limits<double>::infinity();  ///< Its radius; negative for none [mm].
    Where where = Where::Unknown;
  };
  /// The balls that were found last: at any time of the motion, for the surface is at rest.
  struct Balls {
    std::array<Ball, 8> last;
    std::size_t next = 0;
    void add(const Ball& ball) { last[next++ % last.size()] = ball; }
  };
  /// Of one sphere: what takes its place before and after the motion, and the first vertex that gets too deep.
  struct Outcome {
    std::vector<Watched> start, end;
    Finding finding;
  };

  Course(const Side& side, const RigidTransform& start, const RigidTransform& end)
      : side_(side), start_(start), screw_(screw_between(pose_from_transform(start), pose_from_transform(end))) {}

  VertexSphere sphere(const VertexNode& node) const { return side_.tree->sphere(node, side_.solid_inner->vertices); }
  /// No vertex in the sphere goes further than that [mm].
  double way(const VertexSphere& sphere) const {
    return screw_path_length(screw_, screw_radius(screw_, start_ * sphere.center, sphere.radius));
  }
  double furthest() const { return way(sphere(side_.tree->root())); }

  /// What is still known after all have gone that way.
  static Watched after(Watched w, double way) {
    w.slack -= way;
    w.clear -= way;
    return w;
  }

  /// Follows the vertices of a sphere from time `at` of the motion, where `w` is known, to its end.
  /// @param known what other spheres found; what this one finds is added
  void follow(Watched w, double at, Balls& known, Outcome& outcome) const {
    const VertexSphere s = sphere(w.node);
    const Vec3 from = start_ * s.center;
    const double way = this->way(s);
    for (;;) {
      const double left = (1 - at) * way;
      if (held_until(w.face, s, at) >= 1) {
        if (at == 0) outcome.start.push_back(seen_by_face(w, from, s.radius));
        outcome.end.push_back(seen_by_face(after(w, left), place(from, 1), s.radius));
        return;
      }
      const Vec3 point = place(from, at);
      look(w, point, s.radius, left, known);
      if (w.where != Where::Unknown) known.add({point, w.clear, w.where});
      if (w.slack <= left && !w.node.leaf() && w.slack < std::max(s.radius, side_.resolution)) {
        follow(half(w, s, w.node.left()), at, known, outcome);
        follow(half(w, s, w.node.right()), at, known, outcome);
        return;
      }
      if (at == 0) outcome.start.push_back(w);
      if (w.slack > left) {
        outcome.end.push_back(after(w, left));
        return;
      }
      const double held = held_until(w.face, s, at);
      if (w.slack < side_.resolution && held <= at) {
        if (at < outcome.finding.toi || outcome.finding.face == NearestFace::kNone)
          outcome.finding = {at, side_.tree->order[w.node.begin], w.face};
        return;
      }
      const double next = std::max(held, at + w.slack / way);
      w = after(w, (next - at) * way);
      at = next;
    }
  }

 private:
  Vec3 place(Vec3 from, double at) const { return at == 0 ? from : transform_from_pose(screw_at(screw_, at)) * from; }

  double face_distance(std::uint32_t face, Vec3 point) const {
    const ClosestPoints closest = closest_points_vertex_face(point, side_.solid_outer->triangle(face));
    return length(closest.point_b - closest.point_a);
  }

  /// As far as one face is near enough to the sphere for all its vertices, wherever they are: its distance is convex
  /// along a chord, and the arc is near that. At most 1; `at` where the face says nothing.
  double held_until(std::uint32_t face, const VertexSphere& s, double at) const {
    if (face == NearestFace::kNone) return at;
    const Vec3 from = start_ * s.center;
    const double limit = side_.limit - s.radius, first = face_distance(face, place(from, at));
    if (first > limit) return at;
    // What is as deep as may be may still go on no deeper, or come back.
    const double most = std::max(limit - kHeldShare * side_.resolution, first);
    const double bend = screw_chord_deviation(screw_, screw_radius(screw_, from, s.radius));
    double length = 1 - at;
    for (int tries = 0; tries < kFaceTries; ++tries, length /= 4) {
      const double until = tries == 0 ? 1 : at + length;
      if (std::max(first, face_distance(face, place(from, until))) + bend * length * length <= most) return until;
    }
    return at;
  }

  /// What a face at hand alone says of a sphere there.
  Watched seen_by_face(Watched w, Vec3 center, double radius) const {
    w.slack = std::max(w.slack, side_.limit - radius - face_distance(w.face, center));
    return w;
  }

  Watched half(const Watched& w, const VertexSphere& s, const VertexNode& node) const {
    Watched h;
    h.node = node;
    h.face = w.face;
    h.clear = w.clear - length(sphere(node).center - s.center) * (1 + 1e-9);
    h.where = w.where;
    return h;
  }

  /// Finds out how much slack the sphere has with its center at `point`, as exactly as it takes to go `left` on.
  void look(Watched& w, Vec3 point, double radius, double left, const Balls& known) const {
    const SolidTree& outer = *side_.solid_outer;
    const double to_bounds = distance_to_bounds(outer, point);
    if (to_bounds > radius && side_.limit + to_bounds - radius > left) {
      w.where = Where::Outside;
      w.clear = to_bounds;
      w.slack = side_.limit + to_bounds - radius;
      return;
    }
    const double enough = kNearShare * radius;
    const NearestFace nearest = nearest_face(outer, point, w.face, enough);
    const double rounding = kDistanceRounding * (max_abs(point) + nearest.distance);
    const double clear = nearest.distance >= enough ? nearest.distance - rounding : 0;
    w.face = nearest.face;
    // No surface in the ball where it was nor in the one where it is: where they overlap, so is none between them.
    if (w.clear + clear <= 0) w.where = Where::Unknown;
    w.clear = clear;
    // Wherever they are, vertices are no deeper than the surface is far away.
    w.slack = side_.limit - nearest.distance - radius - rounding;
    if (clear <= radius || (w.where == Where::Unknown && w.slack > left)) return;
    if (w.where == Where::Unknown) w.where = where_is(point, clear, known);
    if (w.where == Where::Outside) w.slack = side_.limit + clear - radius;
  }

  /// Where a point is whose distance from the surface is at least `clear`.
  Where where_is(Vec3 point, double clear, const Balls& known) const {
    for (const Ball& ball : known.last)
      if (length(point - ball.center) < ball.clear + clear) return ball.where;
    return point_in_solid(*side_.solid_outer, point) ? Where::Inside : Where::Outside;
  }

  const Side& side_;
  RigidTransform start_;
  Screw screw_;
};

VertexDepthGuard::VertexDepthGuard(const Assembly& assembly, const PairStates& pairs, SolidOf solid_of,
                                   const Executor& executor)
    : assembly_(&assembly),
      solid_of_(std::move(solid_of)),
      tolerance_(pairs.tolerance),
      largest_allowance_(pairs.tolerance),
      thinnest_(assembly.components.size(), -1),
      trees_(assembly.components.size()),
      executor_(executor) {
  for (const ComponentPair& p : pairs.pairs) {
    if (p.state != PairState::Fit && p.state != PairState::Contact) continue;
    largest_allowance_ = std::max(largest_allowance_, p.allowed_penetration);
    // The triangles of a fit may all be apart, or end where the other's begin: only its vertices are deep.
    if (p.state == PairState::Contact && p.penetration <= kNoticeableShare * tolerance_) {
      consider(p.a, p.b, p.allowed_penetration);
      continue;
    }
    known_.insert({p.a, p.b});
    watch(p.a, p.b, p.allowed_penetration);
    watch(p.b, p.a, p.allowed_penetration);
  }
}

void VertexDepthGuard::prepare() {
  executor_.for_each_heavy(thinnest_.size(),
                           [&](std::size_t c) { thinnest(ComponentId(static_cast<std::uint32_t>(c))); });
  if (std::all_of(thinnest_.begin(), thinnest_.end(), [&](double t) { return t >= kLimit * largest_allowance_; }))
    return;
  for (std::size_t c = 0; c < trees_.size(); ++c) tree_of(ComponentId(static_cast<std::uint32_t>(c)));
}

double VertexDepthGuard::thinnest(ComponentId component) {
  double& known = thinnest_[component.value];
  if (known < 0) known = min_altitude(*(*assembly_)[component].mesh);
  return known;
}

const VertexTree& VertexDepthGuard::tree_of(ComponentId component) {
  std::shared_ptr<const VertexTree>& tree = trees_[component.value];
  if (!tree) tree = std::make_shared<const VertexTree>(vertex_tree_build(solid_of_(component).vertices, executor_));
  return *tree;
}

void VertexDepthGuard::consider(ComponentId a, ComponentId b, double allowed) {
  if (!known_.insert({std::min(a, b), std::max(a, b)}).second) return;
  if (std::min(thinnest(a), thinnest(b)) >= kLimit * allowed) return;
  watch(a, b, allowed);
  watch(b, a, allowed);
}

void VertexDepthGuard::watch(ComponentId inner, ComponentId outer, double allowed) {
  if (!(*assembly_)[outer].faults.closed() || tree_of(inner).empty()) return;
  Side side;
  side.inner = inner;
  side.outer = outer;
  side.solid_inner = &solid_of_(inner);
  side.solid_outer = &solid_of_(outer);
  side.tree = &tree_of(inner);
  side.limit = kLimit * allowed;
  side.resolution = kResolutionShare * tolerance_;
  begin_anew(side);
  sides_.push_back(std::move(side));
}

void VertexDepthGuard::begin_anew(Side& side) {
  side.watched.assign(1, {});
  side.watched.front().node = side.tree->root();
  side.watched_end.clear();
  side.spent = side.spent_end = 0;
  side.least = side.watched.front().slack;
}

namespace {

template <class Watched>
double min_slack(const std::vector<Watched>& watched) {
  double least = std::numeric_limits<double>::infinity();
  for (const Watched& w : watched) least = std::min(least, w.slack);
  return least;
}

}  // namespace

VertexDepthGuard::Finding VertexDepthGuard::sweep_side(Side& side, const Course& course) const {
  const double furthest = course.furthest();
  if (side.least - side.spent > furthest) {
    side.spent_end = side.spent + furthest;
    return {};
  }
  std::vector<std::size_t> failing;
  std::vector<double> ways(side.watched.size());
  for (std::size_t i = 0; i < side.watched.size(); ++i) {
    Watched& w = side.watched[i];
    w.slack -= side.spent;
    w.clear -= side.spent;
    ways[i] = w.slack > furthest ? furthest : course.way(course.sphere(w.node));
    if (w.slack <= ways[i]) failing.push_back(i);
  }
  std::vector<Course::Outcome> outcomes(failing.size());
  executor_.for_each_range(failing.size(), kTaskSpheres, [&](std::size_t begin, std::size_t end) {
    Course::Balls known;
    for (std::size_t k = begin; k < end; ++k) course.follow(side.watched[failing[k]], 0, known, outcomes[k]);
  });

  Finding first;
  std::vector<Watched> start, end;
  std::size_t next = 0;
  for (std::size_t i = 0; i < side.watched.size(); ++i) {
    if (next == failing.size() || failing[next] != i) {
      start.push_back(side.watched[i]);
      end.push_back(Course::after(side.watched[i], ways[i]));
      continue;
    }
    const Course::Outcome& outcome = outcomes[next++];
    start.insert(start.end(), outcome.start.begin(), outcome.start.end());
    end.insert(end.end(), outcome.end.begin(), outcome.end.end());
    if (outcome.finding.face != NearestFace::kNone &&
        (first.face == NearestFace::kNone || outcome.finding.toi < first.toi))
      first = outcome.finding;
  }
  side.watched = std::move(start);
  side.watched_end = std::move(end);
  side.spent = side.spent_end = 0;
  side.least = min_slack(side.watched);
  return first;
}

BlockingPair VertexDepthGuard::contact_of(const Side& side, const Finding& finding) const {
  const Span<const Face> faces = side.solid_inner->faces;
  const auto has_vertex = [&](const Face& f) { return std::count(f.v, f.v + 3, finding.vertex) > 0; };
  const auto at = std::find_if(faces.begin(), faces.end(), has_vertex) - faces.begin();
  const FaceId inner_face(static_cast<std::uint32_t>(at)), outer_face(finding.face);
  if (side.inner < side.outer)
    return {side.inner, side.outer, inner_face, outer_face, finding.toi, BlockingRule::VertexOfA};
  return {side.outer, side.inner, outer_face, inner_face, finding.toi, BlockingRule::VertexOfB};
}

std::vector<BlockingPair> VertexDepthGuard::sweep(Span<const RigidTransform> from, Span<const RigidTransform> to) {
  return sweep_sides(from, to, [](const Side&) { return true; });
}

std::vector<BlockingPair> VertexDepthGuard::sweep(Span<const RigidTransform> from, Span<const RigidTransform> to,
                                                   Span<const std::pair<ComponentId, ComponentId>> touching) {
  return sweep_sides(from, to, [&](const Side& side) {
    return std::any_of(touching.begin(), touching.end(), [&](const std::pair<ComponentId, ComponentId>& pair) {
      return pair == std::pair{side.inner, side.outer} || pair == std::pair{side.outer, side.inner};
    });
  });
}

std::vector<BlockingPair> VertexDepthGuard::sweep_sides(Span<const RigidTransform> from, Span<const RigidTransform> to,
                                                         const MayMeet& may_meet) {
  std::vector<BlockingPair> contacts;
  for (Side& side : sides_) {
    const RigidTransform start = inverse(from[side.outer.value]) * from[side.inner.value];
    const RigidTransform end = inverse(to[side.outer.value]) * to[side.inner.value];
    side.watched_end.clear();
    side.spent_end = side.spent;
    if (start == end) continue;
    const Course course(side, start, end);
    if (!may_meet(side)) {
      side.spent_end = side.spent + course.furthest();
      continue;
    }
    const Finding finding = sweep_side(side, course);
    if (finding.face != NearestFace::kNone) contacts.push_back(contact_of(side, finding));
  }
  return contacts;
}

void VertexDepthGuard::merge(Side& side) {
  std::vector<Watched> merged;
  for (const Watched& w : side.watched) {
    merged.push_back(w);
    while (merged.size() >= 2) {
      const Watched &left = merged[merged.size() - 2], &right = merged.back();
      if (left.where != Where::Outside || right.where != Where::Outside || !left.node.left_of(right.node)) break;
      Watched both;
      both.node = left.node.joined(right.node);
      const VertexSphere s = side.tree->sphere(both.node, side.solid_inner->vertices);
      for (const Watched* half : {&left, &right}) {
        const Vec3 center = side.tree->sphere(half->node, side.solid_inner->vertices).center;
        const double clear = half->clear - length(center - s.center) * (1 + 1e-9);
        if (clear <= both.clear) continue;
        both.clear = clear;
        both.face = half->face;
      }
      if (both.clear <= kJoinedClear * s.radius) break;
      both.where = Where::Outside;
      both.slack = side.limit + both.clear - s.radius;
      merged.resize(merged.size() - 2);
      merged.push_back(both);
    }
  }
  side.watched = std::move(merged);
}

void VertexDepthGuard::commit() {
  for (Side& side : sides_) {
    side.spent = side.spent_end;
    if (side.watched_end.empty()) continue;
    side.watched = std::move(side.watched_end);
    side.watched_end.clear();
    merge(side);
    side.least = min_slack(side.watched);
  }
}

void VertexDepthGuard::jump() {
  for (Side& side : sides_) begin_anew(side);
}

VertexDepthGuard::SolidOf solids_of(const Assembly& assembly, const Executor& executor) {
  const auto solids = std::make_shared<std::vector<std::shared_ptr<const SolidTree>>>(assembly.components.size());
  return [solids, &assembly, executor](ComponentId c) -> const SolidTree& {
    std::shared_ptr<const SolidTree>& known = (*solids)[c.value];
    if (known) return *known;
    known = std::make_shared<const SolidTree>(make_solid_tree(assembly[c], executor));
    return *known;
  };
}

}  // namespace dismantle
