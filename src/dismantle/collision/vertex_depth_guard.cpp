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

Pose pose_from_transform(const RigidTransform& t) {
  return {t.translation, quat_from_mat3(t.rotation)};
}

}  // namespace

VertexDepthGuard::VertexDepthGuard(const Assembly& assembly, const PairStates& pairs, const Executor& executor)
    : executor_(executor) {
  for (const ComponentPair& p : pairs.pairs) {
    if (p.state != PairState::Fit && p.state != PairState::Contact) continue;
    if (!(p.penetration > kNoticeableShare * pairs.tolerance)) continue;
    if (!surface_) surface_ = std::make_shared<const AssemblySurface>(make_assembly_surface(assembly, executor));
    watch(assembly, p, pairs.tolerance);
  }
  if (!surface_) return;
  const TriangleStreams& streams = surface_->streams;
  face_of_vertex_.resize(streams.vertices.size());
  for (std::size_t leaf = 0; leaf < streams.faces.size(); ++leaf)
    for (const std::uint32_t v : streams.faces[leaf].v) face_of_vertex_[v] = streams.face_of[leaf];
}

void VertexDepthGuard::watch(const Assembly& assembly, const ComponentPair& pair, double tolerance) {
  const auto add = [&](ComponentId inner, ComponentId outer) {
    if (!assembly[outer].faults.closed()) return;
    Side side{inner, outer, 2 * pair.allowed_penetration, kResolutionShare * tolerance, {}, {}};
    side.slack.assign(assembly[inner].mesh->vertices.size(), kUnknown);
    sides_.push_back(std::move(side));
  };
  add(pair.a, pair.b);
  add(pair.b, pair.a);
}

VertexDepthGuard::Finding VertexDepthGuard::sweep_side(Side& side, const RigidTransform& start,
                                                       const RigidTransform& end) const {
  const AssemblySurface& s = *surface_;
  const Pose pose_start = pose_from_transform(start), pose_end = pose_from_transform(end);
  const Screw screw = screw_between(pose_start, pose_end);
  const std::uint32_t begin = s.streams.vertex_begin[side.inner.value];
  side.slack_end = side.slack;

  std::vector<Finding> findings(side.slack.size());
  executor_.for_each(side.slack.size(), [&](std::size_t i) {
    const Vec3 vertex = s.streams.vertices[begin + i];
    const double way = screw_path_length(screw, screw_radius(screw, start * vertex, 0));
    if (side.slack[i] > way) {
      side.slack_end[i] = side.slack[i] - way;
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
  std::vector<CollisionContact> contacts;
  for (Side& side : sides_) {
    const RigidTransform start = inverse(from[side.outer.value]) * from[side.inner.value];
    const RigidTransform end = inverse(to[side.outer.value]) * to[side.inner.value];
    if (start == end) {
      side.slack_end = side.slack;
      continue;
    }
    const Finding finding = sweep_side(side, start, end);
    if (finding.leaf != kNoNode) contacts.push_back(contact_of(side, finding));
  }
  return contacts;
}

void VertexDepthGuard::commit() {
  for (Side& side : sides_)
    if (!side.slack_end.empty()) side.slack = side.slack_end;
}

void VertexDepthGuard::jump() {
  for (Side& side : sides_) std::fill(side.slack.begin(), side.slack.end(), kUnknown);
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
