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

/// Facets that meet at an angle between these stand for a curved surface [rad]; at a larger one, the edge may be meant.
constexpr double kSmallestAngle = 1e-3, kLargestAngle = 0.6;
/// This share of the edges, by length, is off by no more than the estimate: single edges may be off by anything.
constexpr double kShare = 0.95;
/// The deflection that a kernel is asked for is this many times the height that arcs have above their chords then
/// (measured on nine assemblies that OpenCASCADE tessellated: 1.97 to 2.06).
constexpr double kOfKernels = 2;
/// About this many edges are looked at.
constexpr std::size_t kEnoughEdges = 1000000;

/// An edge between facets of a curved surface.
struct CurvedEdge {
  double height;  ///< Of the arc above its chord [mm].
  double length;  ///< [mm]
};

/// Adds the edges of a mesh that are between facets of a curved surface. @param stride takes each edge of so many
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
    // A facet of width w that turns by the angle has the radius w / angle.
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
  for (const TriangleMesh* mesh : in_order) add_curved_edges(*mesh, 3 * faces / (2 * kEnoughEdges) + 1, edges);
  if (edges.empty()) return 0;
  std::sort(edges.begin(), edges.end(), [](const CurvedEdge& x, const CurvedEdge& y) { return x.height < y.height; });
  double whole = 0, sum = 0;
  for (const CurvedEdge& e : edges) whole += e.length;
  std::size_t at = 0;
  while (at + 1 < edges.size() && (sum += edges[at].length) < kShare * whole) ++at;
  return std::min(kOfKernels * edges[at].height, kDefaultRelativeDeflection * diagonal(assembled_bounds(assembly)));
}

}  // namespace dismantle
