// SPDX-License-Identifier: Apache-2.0
#include "dismantle/collision/vertex_depth_guard.h"

#include "dismantle/math/screw.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace dismantle {

namespace {

constexpr double kUnknown = -1;
/// A vertex whose slack is below this share of the tolerance has used it up.
constexpr double kResolutionShare = 0.05;
/// Less than this share of the tolerance is rounding.
constexpr double kNoticeableShare = 1e-3;

double least_altitude(const TriangleMesh& mesh) {
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

VertexDepthGuard::VertexDepthGuard(const Assembly& assembly, const PairStates& pairs, const Executor& executor)
    : assembly_(&assembly),
      tolerance_(pairs.tolerance),
      thinnest_(assembly.components.size(), -1),
      executor_(executor) {
  for (const ComponentPair& p : pairs.pairs) {
    if (p.state != PairState::Fit && p.state != PairState::Contact) continue;
    if (p.penetration <= kNoticeableShare * tolerance_) {
      consider(p.a, p.b, p.allowed_penetration);
      continue;
    }
    known_.insert({p.a, p.b});
    watch(p.a, p.b, p.allowed_penetration);
    watch(p.b, p.a, p.allowed_penetration);
  }
}

double VertexDepthGuard::thinnest(ComponentId component) {
  double& known = thinnest_[component.value];
  if (known < 0) known = least_altitude(*(*assembly_)[component].mesh);
  return known;
}

void VertexDepthGuard::consider(ComponentId a, ComponentId b, double allowed) {
  if (!known_.insert({std::min(a, b), std::max(a, b)}).second) return;
  if (std::min(thinnest(a), thinnest(b)) >= 2 * allowed) return;
  watch(a, b, allowed);
  watch(b, a, allowed);
}

void VertexDepthGuard::watch(ComponentId inner, ComponentId outer, double allowed) {
  if (!(*assembly_)[outer].faults.closed()) return;
  if (!surface_) {
    surface_ = std::make_shared<const AssemblySurface>(make_assembly_surface(*assembly_, executor_));
    const TriangleStreams& streams = surface_->streams;
    face_of_vertex_.resize(streams.vertices.size());
    for (std::size_t leaf = 0; leaf < streams.faces.size(); ++leaf)
      for (const std::uint32_t v : streams.faces[leaf].v) face_of_vertex_[v] = streams.face_of[leaf];
  }
  Side side;
  side.inner = inner;
  side.outer = outer;
  side.limit = 2 * allowed;
  side.resolution = kResolutionShare * tolerance_;
  const Aabb box = assembled_bounds((*assembly_)[inner]);
  side.center = box.empty() ? Vec3{} : box.center();
  side.radius = diagonal(box) / 2;
  side.slack.assign((*assembly_)[inner].mesh->vertices.size(), kUnknown);
  sides_.push_back(std::move(side));
}

double VertexDepthGuard::furthest_way(const Side& side, const RigidTransform& start, const RigidTransform& end) {
  const Screw screw = screw_between(pose_from_transform(start), pose_from_transform(end));
  return screw_path_length(screw, screw_radius(screw, start * side.center, side.radius));
}

VertexDepthGuard::Finding VertexDepthGuard::sweep_side(Side& side, const RigidTransform& start,
                                                       const RigidTransform& end) const {
  const AssemblySurface& s = *surface_;
  const Pose pose_start = pose_from_transform(start), pose_end = pose_from_transform(end);
  const Screw screw = screw_between(pose_start, pose_end);
  const std::uint32_t begin = s.streams.vertex_begin[side.inner.value];
  const double furthest = furthest_way(side, start, end);
  if (side.least - side.spent > furthest) {
    side.spent_end = side.spent + furthest;
    return {};
  }
  side.spent_end = 0;
  side.slack_end.resize(side.slack.size());

  std::vector<Finding> findings(side.slack.size());
  executor_.for_each(side.slack.size(), [&](std::size_t i) {
    const Vec3 vertex = s.streams.vertices[begin + i];
    const double way = screw_path_length(screw, screw_radius(screw, start * vertex, 0));
    if (side.slack[i] - side.spent > way) {
      side.slack_end[i] = side.slack[i] - side.spent - way;
      return;
    }
    for (double at = 0;;) {
      const Vec3 point = transform_from_pose(pose_between(pose_start, pose_end, at)) * vertex;
      const double left = (1 - at) * way;
      const SurfaceDepth depth = surface_depth(s, side.outer, point, side.limit - left - side.resolution);
      const double slack = side.limit - depth.depth;
      if (slack > left) {
        side.slack_end[i] = slack - left;
        return;
      }
      if (slack < side.resolution) {
        findings[i] = {at, static_cast<std::uint32_t>(i), depth.leaf};
        return;
      }
      at += slack / way;
    }
  });
  const auto first = std::min_element(findings.begin(), findings.end(),
                                      [](const Finding& a, const Finding& b) { return a.toi < b.toi; });
  return first == findings.end() ? Finding{} : *first;
}

CollisionContact VertexDepthGuard::contact_of(const Side& side, const Finding& finding) const {
  const FaceId inner_face = face_of_vertex_[surface_->streams.vertex_begin[side.inner.value] + finding.vertex];
  const FaceId outer_face = surface_->streams.face_of[finding.leaf];
  if (side.inner < side.outer) return {side.inner, side.outer, inner_face, outer_face, finding.toi};
  return {side.outer, side.inner, outer_face, inner_face, finding.toi};
}

std::vector<CollisionContact> VertexDepthGuard::sweep(Span<const RigidTransform> from, Span<const RigidTransform> to) {
  return sweep_sides(from, to, [](const Side&) { return true; });
}

std::vector<CollisionContact> VertexDepthGuard::sweep(Span<const RigidTransform> from, Span<const RigidTransform> to,
                                                      Span<const std::pair<ComponentId, ComponentId>> touching) {
  return sweep_sides(from, to, [&](const Side& side) {
    return std::any_of(touching.begin(), touching.end(), [&](const std::pair<ComponentId, ComponentId>& pair) {
      return pair == std::pair{side.inner, side.outer} || pair == std::pair{side.outer, side.inner};
    });
  });
}

std::vector<CollisionContact> VertexDepthGuard::sweep_sides(Span<const RigidTransform> from,
                                                            Span<const RigidTransform> to, const MayMeet& may_meet) {
  std::vector<CollisionContact> contacts;
  for (Side& side : sides_) {
    const RigidTransform start = inverse(from[side.outer.value]) * from[side.inner.value];
    const RigidTransform end = inverse(to[side.outer.value]) * to[side.inner.value];
    side.slack_end.clear();
    side.spent_end = side.spent;
    if (start == end) continue;
    if (!may_meet(side)) {
      side.spent_end = side.spent + furthest_way(side, start, end);
      continue;
    }
    const Finding finding = sweep_side(side, start, end);
    if (finding.leaf != kNoNode) contacts.push_back(contact_of(side, finding));
  }
  return contacts;
}

void VertexDepthGuard::commit() {
  for (Side& side : sides_) {
    side.spent = side.spent_end;
    if (side.slack_end.empty()) continue;
    side.slack = side.slack_end;
    side.least = *std::min_element(side.slack.begin(), side.slack.end());
  }
}

void VertexDepthGuard::jump() {
  for (Side& side : sides_) {
    std::fill(side.slack.begin(), side.slack.end(), kUnknown);
    side.spent = side.spent_end = 0;
    side.least = kUnknown;
  }
}

namespace {

class GuardedEngine final : public CollisionEngine {
 public:
  GuardedEngine(std::unique_ptr<CollisionEngine> engine, VertexDepthGuard guard)
      : engine_(std::move(engine)), guard_(std::move(guard)) {}

  SweepResult sweep(Span<const RigidTransform> next, double path_deviation) override {
    SweepResult result = engine_->sweep(next, path_deviation);
    if (!result.free) return result;
    const auto start = std::chrono::steady_clock::now();
    result.contacts = guard_.sweep(engine_->state(), next);
    for (const CollisionContact& c : result.contacts) result.toi = std::min(result.toi, c.toi);
    result.free = result.contacts.empty();
    const double spent = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    result.timings.intersection += spent;
    result.timings.overall += spent;
    return result;
  }
  void commit() override {
    engine_->commit();
    guard_.commit();
  }
  void jump(Span<const RigidTransform> state) override {
    engine_->jump(state);
    guard_.jump();
  }
  Span<const RigidTransform> state() const override { return engine_->state(); }
  std::vector<ComponentPair> embedded_pairs() const override { return engine_->embedded_pairs(); }

 private:
  std::unique_ptr<CollisionEngine> engine_;
  VertexDepthGuard guard_;
};

}  // namespace

std::unique_ptr<CollisionEngine> make_guarded_engine(std::unique_ptr<CollisionEngine> engine, const Assembly& assembly,
                                                     const PairStates& pairs, const Executor& executor) {
  VertexDepthGuard guard(assembly, pairs, executor);
  if (guard.watches_nothing()) return engine;
  return std::make_unique<GuardedEngine>(std::move(engine), std::move(guard));
}

}  // namespace dismantle
