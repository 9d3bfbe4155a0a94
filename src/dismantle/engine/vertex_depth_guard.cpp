// SPDX-License-Identifier: Apache-2.0
#include "dismantle/engine/vertex_depth_guard.h"

#include <algorithm>
#include <limits>

namespace dismantle {

namespace {

/// Slacks below this share of the tolerance count as used up.
constexpr double kResolutionShare = 0.05;
/// Overlaps below this share of the tolerance are rounding.
constexpr double kNoticeableShare = 1e-3;
/// Spheres to be followed by one task.
constexpr std::size_t kTaskSpheres = 16;

double min_altitude(const TriangleMesh& mesh) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle t = mesh.triangle(f);
    const double longest = std::max({length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])});
    smallest = std::min(smallest, length(normal_unscaled(t)) / longest);
  }
  return smallest;
}

/// Faces: one of the vertex, and the nearest one to it.
BlockingPair blocking_pair(const WatchedComponent& watched, const DeepVertexTime& deep) {
  const Span<const Face> faces = watched.solid_inner->faces;
  const auto has_vertex = [&](const Face& f) { return std::count(f.v, f.v + 3, deep.vertex) > 0; };
  const auto at = std::find_if(faces.begin(), faces.end(), has_vertex) - faces.begin();
  const FaceId inner_face(static_cast<std::uint32_t>(at)), outer_face(deep.face);
  if (watched.inner < watched.outer)
    return {watched.inner, watched.outer, inner_face, outer_face, deep.toi, BlockingRule::VertexOfA};
  return {watched.outer, watched.inner, outer_face, inner_face, deep.toi, BlockingRule::VertexOfB};
}

}  // namespace

VertexDepthGuard::VertexDepthGuard(const Assembly& assembly, const PairStates& pairs, SolidOf solid_of,
                                   const Executor& executor)
    : assembly_(&assembly),
      solid_of_(std::move(solid_of)),
      tolerance_(pairs.tolerance),
      max_allowance_(pairs.tolerance),
      min_altitudes_(assembly.components.size(), -1),
      trees_(assembly.components.size()),
      executor_(executor) {
  for (const ComponentPair& p : pairs.pairs) {
    if (p.state != PairState::Contact) continue;
    max_allowance_ = std::max(max_allowance_, p.allowed_depth);
    if (p.depth <= kNoticeableShare * tolerance_) {
      consider(p.a, p.b, p.allowed_depth);
      continue;
    }
    considered_.insert({p.a, p.b});
    watch(p.a, p.b, p.allowed_depth);
    watch(p.b, p.a, p.allowed_depth);
  }
}

void VertexDepthGuard::prepare() {
  executor_.for_each_heavy(min_altitudes_.size(),
                           [&](std::size_t c) { min_altitude_of(ComponentId(static_cast<std::uint32_t>(c))); });
  if (std::all_of(min_altitudes_.begin(), min_altitudes_.end(), [&](double t) { return t >= kLimit * max_allowance_; }))
    return;
  for (std::size_t c = 0; c < trees_.size(); ++c) tree_of(ComponentId(static_cast<std::uint32_t>(c)));
}

double VertexDepthGuard::min_altitude_of(ComponentId component) {
  double& known = min_altitudes_[component.value];
  if (known < 0) known = min_altitude(*(*assembly_)[component].mesh);
  return known;
}

const VertexTree& VertexDepthGuard::tree_of(ComponentId component) {
  std::shared_ptr<const VertexTree>& tree = trees_[component.value];
  if (!tree) tree = std::make_shared<const VertexTree>(vertex_tree_build(solid_of_(component).vertices, executor_));
  return *tree;
}

void VertexDepthGuard::consider(ComponentId a, ComponentId b, double allowed) {
  if (!considered_.insert({std::min(a, b), std::max(a, b)}).second) return;
  if (std::min(min_altitude_of(a), min_altitude_of(b)) >= kLimit * allowed) return;
  watch(a, b, allowed);
  watch(b, a, allowed);
}

void VertexDepthGuard::watch(ComponentId inner, ComponentId outer, double allowed) {
  if (!(*assembly_)[outer].faults.closed() || tree_of(inner).empty()) return;
  WatchedComponent watched;
  watched.inner = inner;
  watched.outer = outer;
  watched.solid_inner = &solid_of_(inner);
  watched.solid_outer = &solid_of_(outer);
  watched.tree = &tree_of(inner);
  watched.limit = kLimit * allowed;
  watched.resolution = kResolutionShare * tolerance_;
  watched.restart();
  watched_.push_back(std::move(watched));
}

DeepVertexTime VertexDepthGuard::sweep_pair(WatchedComponent& watched, const VertexMotion& motion) const {
  const double max_path = motion.max_path_length();
  if (watched.min_slack - watched.path > max_path) {
    watched.path_end = watched.path + max_path;
    return {};
  }
  std::vector<std::size_t> failing;
  std::vector<double> paths(watched.spheres.size());
  for (std::size_t i = 0; i < watched.spheres.size(); ++i) {
    WatchedSphere& w = watched.spheres[i];
    w = w.after(watched.path);
    paths[i] = w.slack > max_path ? max_path : motion.path_length(w.node);
    if (w.slack <= paths[i]) failing.push_back(i);
  }
  std::vector<SphereOutcome> outcomes(failing.size());
  executor_.for_each_range(failing.size(), kTaskSpheres, [&](std::size_t begin, std::size_t end) {
    SurfaceFreeBalls known;
    for (std::size_t k = begin; k < end; ++k) outcomes[k] = motion.follow(watched.spheres[failing[k]], known);
  });

  DeepVertexTime first;
  std::vector<WatchedSphere> start, end;
  std::size_t next = 0;
  for (std::size_t i = 0; i < watched.spheres.size(); ++i) {
    if (next == failing.size() || failing[next] != i) {
      start.push_back(watched.spheres[i]);
      end.push_back(watched.spheres[i].after(paths[i]));
      continue;
    }
    const SphereOutcome& outcome = outcomes[next++];
    start.insert(start.end(), outcome.start.begin(), outcome.start.end());
    end.insert(end.end(), outcome.end.begin(), outcome.end.end());
    if (outcome.deep.face != NearestFace::kNone && (first.face == NearestFace::kNone || outcome.deep.toi < first.toi))
      first = outcome.deep;
  }
  watched.set_spheres(std::move(start));
  watched.spheres_end = std::move(end);
  watched.path = watched.path_end = 0;
  return first;
}

std::vector<BlockingPair> VertexDepthGuard::sweep(Span<const RigidTransform> from, Span<const RigidTransform> to) {
  return sweep_pairs(from, to, [](const WatchedComponent&) { return true; });
}

std::vector<BlockingPair> VertexDepthGuard::sweep(Span<const RigidTransform> from, Span<const RigidTransform> to,
                                                  Span<const std::pair<ComponentId, ComponentId>> near) {
  return sweep_pairs(from, to, [&](const WatchedComponent& watched) {
    return std::any_of(near.begin(), near.end(), [&](const std::pair<ComponentId, ComponentId>& pair) {
      return pair == std::pair{watched.inner, watched.outer} || pair == std::pair{watched.outer, watched.inner};
    });
  });
}

std::vector<BlockingPair> VertexDepthGuard::sweep_pairs(Span<const RigidTransform> from, Span<const RigidTransform> to,
                                                        const MayMeet& may_meet) {
  std::vector<BlockingPair> found;
  for (WatchedComponent& watched : watched_) {
    const RigidTransform start = inverse(from[watched.outer.value]) * from[watched.inner.value];
    const RigidTransform end = inverse(to[watched.outer.value]) * to[watched.inner.value];
    watched.spheres_end.clear();
    watched.path_end = watched.path;
    if (start == end) continue;
    const VertexMotion motion(watched, start, end);
    if (!may_meet(watched)) {
      watched.path_end = watched.path + motion.max_path_length();
      continue;
    }
    const DeepVertexTime deep = sweep_pair(watched, motion);
    if (deep.face != NearestFace::kNone) found.push_back(blocking_pair(watched, deep));
  }
  return found;
}

void VertexDepthGuard::commit() {
  for (WatchedComponent& watched : watched_) watched.commit();
}

void VertexDepthGuard::jump() {
  for (WatchedComponent& watched : watched_) watched.restart();
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
