// SPDX-License-Identifier: Apache-2.0
#include "dismantle/loading/estimated_deflection.h"

#include "dismantle/formats/import/import_options.h"
#include "dismantle/geometry/half_edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

namespace dismantle {

namespace {

/// Edges with an angle in this range are taken for the tessellation of a curved surface [rad]; sharper ones may be
/// edges of the part.
constexpr double kSmallestAngle = 1e-3, kLargestAngle = 0.6;
/// The estimate covers this share of the edges, by length; the rest are outliers, such as chamfers and drafts.
constexpr double kShare = 0.95;
/// Ratio of the deflection given to OpenCASCADE to the resulting height of arcs above their chords (2.00 to 2.06 for
/// nine assemblies).
constexpr double kDeflectionOfHeight = 2;
/// Assemblies with more edges are sampled.
constexpr std::size_t kMaxEdges = 1000000;

/// An edge between facets of a curved surface.
struct CurvedEdge {
  double height;  ///< Of the arc above its chord [mm].
  double length;  ///< [mm]
};

/// Adds the edges of a mesh that are between facets of a curved surface. @param stride samples every stride-th edge
void add_curved_edges(const TriangleMesh& mesh, std::size_t stride, std::vector<CurvedEdge>& edges) {
  const std::vector<HalfEdge> half_edges = sorted_half_edges(mesh.faces);
  std::size_t next = 0;
  for_each_edge(half_edges, [&](const HalfEdge* first, const HalfEdge* last) {
    if (last - first != 2 || next++ % stride != 0) return;
    const Vec3 normal[2] = {normal_unscaled(mesh.triangle(first[0].face)),
                            normal_unscaled(mesh.triangle(first[1].face))};
    const double angle = std::atan2(length(cross(normal[0], normal[1])), dot(normal[0], normal[1]));
    if (!(angle > kSmallestAngle && angle < kLargestAngle)) return;
    const double along = length(mesh.vertices[first->low] - mesh.vertices[first->high]);
    if (!(along > 0)) return;
    // The radius of curvature is width / angle, the height of the arc width^2 / (8 radius).
    const double width = std::min(length(normal[0]), length(normal[1])) / along;
    edges.push_back({width * angle / 8, along});
  });
}

}  // namespace

double estimated_deflection(const Assembly& assembly) {
  std::set<const TriangleMesh*> meshes;
  std::vector<const TriangleMesh*> in_order;
  std::size_t faces = 0;
  for (const Component& c : assembly.components) {
    if (!meshes.insert(c.mesh.get()).second) continue;
    in_order.push_back(c.mesh.get());
    faces += c.mesh->faces.size();
  }
  std::vector<CurvedEdge> edges;
  for (const TriangleMesh* mesh : in_order) add_curved_edges(*mesh, 3 * faces / (2 * kMaxEdges) + 1, edges);
  if (edges.empty()) return 0;
  std::sort(edges.begin(), edges.end(), [](const CurvedEdge& x, const CurvedEdge& y) { return x.height < y.height; });
  double whole = 0, sum = 0;
  for (const CurvedEdge& e : edges) whole += e.length;
  std::size_t at = 0;
  while (at + 1 < edges.size() && (sum += edges[at].length) < kShare * whole) ++at;
  return std::min(kDeflectionOfHeight * edges[at].height,
                  kDefaultRelativeDeflection * diagonal(assembled_bounds(assembly)));
}

}  // namespace dismantle
