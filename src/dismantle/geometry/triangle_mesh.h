// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/aabb.h"
#include "dismantle/geometry/triangle.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dismantle {

/// The three vertex indices of a triangle.
struct Face {
  std::uint32_t v[3] = {0, 0, 0};
  friend bool operator==(const Face&, const Face&) = default;
};

/// An indexed triangle mesh. Positions [mm]; every index is below the vertex count.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<Face> faces;
  friend bool operator==(const TriangleMesh&, const TriangleMesh&) = default;

  Triangle triangle(std::size_t face) const {
    const Face& f = faces[face];
    return {{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}};
  }
};

/// The box of all vertices; empty for an empty mesh.
Aabb bounds(const TriangleMesh& mesh);

/// The enclosed volume [mm^3] by the divergence theorem; positive where the normals point out. Meaningful for closed
/// meshes.
double signed_volume(const TriangleMesh& mesh);

/// What is unusual about a mesh; found and counted, never a reason to refuse it.
struct MeshFaults {
  std::size_t welded_vertices = 0;    ///< Vertices merged because their coordinates were equal.
  std::size_t degenerate_faces = 0;   ///< Triangles dropped: two equal corners, or zero area.
  std::size_t boundary_edges = 0;     ///< Edges with one triangle: the mesh is open there.
  std::size_t nonmanifold_edges = 0;  ///< Edges with more than two triangles.
  std::size_t misoriented_edges = 0;  ///< Edges whose two triangles run through it the same way.
  std::size_t open_edges = 0;         ///< Of all these, the ones that are not merely cracks: EdgeFaults::open.
  bool inside_out = false;            ///< Without open edges, but with negative volume.
  friend bool operator==(const MeshFaults&, const MeshFaults&) = default;
  /// A closed, consistently oriented surface: "inside" means something.
  bool closed() const { return boundary_edges == 0 && nonmanifold_edges == 0 && misoriented_edges == 0; }
  /// The faces' normals point out of a volume that the surface encloses, but for cracks.
  bool bounds_solid() const { return open_edges == 0 && !inside_out; }
};

/// A cleaned mesh and what was found on the way.
struct CleanedMesh {
  TriangleMesh mesh;
  MeshFaults faults;
};

/// Welds vertices of equal coordinates (exactly equal; -0 equals 0), drops triangles that are degenerate (two equal
/// corners, or corners exactly on a line), drops vertices without triangles, and counts faults. Keeps the order of
/// faces and vertices.
CleanedMesh clean_mesh(const TriangleMesh& mesh);

}  // namespace dismantle
