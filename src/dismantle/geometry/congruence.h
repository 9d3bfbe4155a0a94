// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"
#include "dismantle/math/rigid_transform.h"

#include <optional>
#include <vector>

namespace dismantle {

/// Tolerance of equal shapes: the share of the largest distance of a vertex from the origin that vertices may deviate
/// by. Rounding to six significant digits, as in text files, moves them by half of it at most.
inline constexpr double kCongruenceTolerance = 2e-5;

/// Quantities of a mesh that rigid motions and the order of its vertices and faces do not change, with bounds of what
/// the tolerance of equal shapes changes them by.
struct MeshInvariants {
  std::size_t vertices = 0;       ///< Number of vertices.
  std::size_t faces = 0;          ///< Number of faces.
  double reach = 0;               ///< Largest distance of a vertex from the origin [mm].
  double edge_length = 0;         ///< Sum of the perimeters of the faces [mm].
  double area = 0;                ///< [mm^2]
  double volume = 0;              ///< Signed; of an open surface with the cone to the mean of the vertices [mm^3].
  Vec3 center;                    ///< Mean of the vertices; follows the motion [mm].
  double mean_square = 0;         ///< Mean square of the distances of the vertices from the center [mm^2].
  double largest_moment = 0;      ///< Largest principal second moment of the vertices about the center [mm^2].
  double smallest_moment = 0;     ///< Smallest principal second moment of the vertices about the center [mm^2].
  std::vector<double> distances;  ///< Of the vertices from the center, ascending [mm].
};

/// The right-handed orthonormal frame of two vectors that are not parallel, as the rows of a matrix: x along `first`, y
/// on the side of `second`.
inline Mat3 frame_of(Vec3 first, Vec3 second) {
  const Vec3 x = normalized(first), z = normalized(cross(first, second));
  return {{x, cross(z, x), z}};
}

/// Measures a mesh.
MeshInvariants mesh_invariants(const TriangleMesh& mesh);

/// True if the invariants admit that two meshes are congruent: a necessary condition.
bool may_be_congruent(const MeshInvariants& a, const MeshInvariants& b);

/// The largest distance by which the area of a mesh may differ from that of a congruent one [mm^2].
double area_play(const MeshInvariants& a);

/// The rigid motion, without reflection, that takes mesh `a` onto mesh `b`, if there is one: it takes each vertex of
/// `a` to a vertex of `b` of its own within kCongruenceTolerance, and the faces to faces of `b` of the same
/// orientation. Plane polygons of one boundary may be divided into triangles in other ways. Vertices and faces may be
/// in any order. There are no false positives. Equal shapes that are tessellated with other vertices are not found, and
/// those of very many equally far vertices may be missed (docs/formats.md, "Equal shapes").
std::optional<RigidTransform> congruence(const TriangleMesh& a, const TriangleMesh& b);

/// The same with invariants that are known. @pre `of_a` and `of_b` are the invariants of `a` and `b`
std::optional<RigidTransform> congruence(const TriangleMesh& a, const MeshInvariants& of_a, const TriangleMesh& b,
                                         const MeshInvariants& of_b);

}  // namespace dismantle
