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
  std::uint32_t v[3] = {0, 0, 0};  ///< Counter-clockwise seen from outside.
  friend bool operator==(const Face&, const Face&) = default;
};

/// An indexed triangle mesh.
struct TriangleMesh {
  std::vector<Vec3> vertices;  ///< Positions [mm].
  std::vector<Face> faces;     ///< Every index is below the vertex count.
  friend bool operator==(const TriangleMesh&, const TriangleMesh&) = default;

  /// The corners of a face.
  Triangle triangle(std::size_t face) const {
    const Face& f = faces[face];
    return {{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}};
  }
};

/// The box of all vertices; empty for an empty mesh.
Aabb bounds(const TriangleMesh& mesh);

/// The enclosed volume by the divergence theorem, positive if the normals point out [mm^3]. Meaningful for closed
/// meshes only.
double signed_volume(const TriangleMesh& mesh);

/// Counts of irregularities of a mesh. They are reported, but never a reason to reject it.
struct MeshFaults {
  std::size_t welded_vertices = 0;    ///< Vertices merged because their coordinates were equal.
  std::size_t degenerate_faces = 0;   ///< Triangles dropped: two equal corners, or zero area.
  std::size_t boundary_edges = 0;     ///< Edges of one triangle: the mesh is open there.
  std::size_t nonmanifold_edges = 0;  ///< Edges of more than two triangles.
  std::size_t misoriented_edges = 0;  ///< Edges that their two triangles run along in the same direction.
  std::size_t open_edges = 0;         ///< Those of all these that are not merely cracks: EdgeFaults::open.
  bool inside_out = false;            ///< No open edges, but negative volume.
  friend bool operator==(const MeshFaults&, const MeshFaults&) = default;
  /// True for a closed, consistently oriented surface: it has an inside.
  bool closed() const { return boundary_edges == 0 && nonmanifold_edges == 0 && misoriented_edges == 0; }
  /// True if the surface encloses a volume, up to cracks, and its normals point out of it.
  bool bounds_solid() const { return open_edges == 0 && !inside_out; }
};

/// A cleaned mesh and its faults.
struct CleanedMesh {
  TriangleMesh mesh;  ///< Without duplicate vertices and degenerate triangles.
  MeshFaults faults;  ///< Both removed and remaining.
};

/// Welds vertices of equal coordinates (exactly equal; -0 equals 0), drops triangles that are degenerate (two equal
/// corners, or corners exactly on a line), drops vertices without triangles, and counts faults. Keeps the order of
/// faces and vertices.
CleanedMesh clean_mesh(const TriangleMesh& mesh);

}  // namespace dismantle
