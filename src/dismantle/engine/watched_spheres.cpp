// SPDX-License-Identifier: Apache-2.0
#include "dismantle/engine/watched_spheres.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace dismantle {

namespace {

/// Spheres are joined if the surface is this many radii away from the center of the sphere that holds both.
constexpr double kJoinedClear = 2;

/// The spheres, with neighbours joined that lie well outside.
std::vector<WatchedSphere> merged_spheres(const WatchedComponent& c) {
  std::vector<WatchedSphere> merged;
  for (const WatchedSphere& w : c.spheres) {
    merged.push_back(w);
    while (merged.size() >= 2) {
      const WatchedSphere &left = merged[merged.size() - 2], &right = merged.back();
      if (left.side != SurfaceSide::Outside || right.side != SurfaceSide::Outside || !left.node.left_of(right.node))
        break;
      WatchedSphere both;
      both.node = left.node.joined(right.node);
      const VertexSphere s = c.sphere(both.node);
      for (const WatchedSphere* half : {&left, &right}) {
        const Vec3 center = c.sphere(half->node).center;
        const double clear = half->clear - length(center - s.center) * (1 + 1e-9);
        if (clear <= both.clear) continue;
        both.clear = clear;
        both.face = half->face;
      }
      if (both.clear <= kJoinedClear * s.radius) break;
      both.side = SurfaceSide::Outside;
      both.slack = c.limit + both.clear - s.radius;
      merged.resize(merged.size() - 2);
      merged.push_back(both);
    }
  }
  return merged;
}

}  // namespace

WatchedSphere WatchedSphere::after(double path) const {
  WatchedSphere w = *this;
  w.slack -= path;
  w.clear -= path;
  return w;
}

void WatchedComponent::restart() {
  spheres.assign(1, {});
  spheres.front().node = tree->root();
  spheres_end.clear();
  path = path_end = 0;
  min_slack = spheres.front().slack;
}

void WatchedComponent::set_spheres(std::vector<WatchedSphere> now) {
  spheres = std::move(now);
  min_slack = std::numeric_limits<double>::infinity();
  for (const WatchedSphere& w : spheres) min_slack = std::min(min_slack, w.slack);
}

void WatchedComponent::commit() {
  path = path_end;
  if (spheres_end.empty()) return;
  spheres = std::exchange(spheres_end, {});
  set_spheres(merged_spheres(*this));
}

}  // namespace dismantle
