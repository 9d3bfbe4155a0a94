// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/overlap_samples.h"

#include "dismantle/surface/ghost_surface.h"

#include <algorithm>

namespace dismantle {

SurfaceEdges::SurfaceEdges(const SolidTree& tree)
    : first(first_at_position(tree.vertices)), edge(3 * tree.faces.size(), kNoEdge) {
  const std::vector<HalfEdge> half_edges = joined_half_edges(tree.faces, first);
  for_each_edge(half_edges, [&](const HalfEdge* begin, const HalfEdge* end) {
    for (const HalfEdge* e = begin; e != end; ++e)
      edge[3 * e->face + e->side] = static_cast<std::uint32_t>(first_face.size());
    first_face.push_back(begin->face);
  });
}

OverlapSamples::OverlapSamples(const SolidTree& surface, const SurfaceEdges& edges, const OverlapSide& solid,
                               double depth)
    : surface_(surface),
      edges_(edges),
      solid_(solid.shape()),
      depth_(depth),
      known_(surface.faces.size() + surface.vertices.size() + edges.first_face.size()) {}

MeshDistance OverlapSamples::nearest(const Sample& sample) {
  if (sample.slot == kNoSlot) return solid_.surface().distance(sample.point, 0, depth_);
  Known& known = known_[sample.slot];
  if (known.distance < 0) {
    const MeshDistance found = solid_.surface().distance(sample.point, 0, depth_);
    known.distance = found.distance;
    known.face = found.face;
  }
  return {known.distance, known.face};
}

bool OverlapSamples::inside(const Sample& sample) {
  if (sample.slot == kNoSlot) return solid_.winding().inside(sample.point);
  Place& place = known_[sample.slot].place;
  if (place == Place::Unknown) place = solid_.winding().inside(sample.point) ? Place::Inside : Place::Outside;
  return place == Place::Inside;
}

/// The part of a segment in the other component's box, as shares of it; empty if the first is larger.
std::pair<double, double> OverlapSamples::part_in_box(Vec3 from, Vec3 along) const {
  const Aabb& box = solid_.surface().bounds();
  double begin = 0, end = 1;
  for (int k = 0; k < 3; ++k) {
    if (along[k] == 0) {
      if (from[k] < box.lower[k] || from[k] > box.upper[k]) return {1, 0};
      continue;
    }
    const double a = (box.lower[k] - from[k]) / along[k], b = (box.upper[k] - from[k]) / along[k];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return {begin, end};
}

}  // namespace dismantle
