// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/geometry/half_edges.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <vector>

namespace dismantle {

/// The ghost surface of a closed mesh (docs/design/0012-ghost-surfaces.md): its vertices are displaced into the solid
/// by at most `max_length`, so that every face is retracted by the same distance, max_length / sqrt(2), where the edges
/// at a vertex allow it: on faces, smooth surfaces and right-angled edges. Sharper corners are retracted by less.
/// Vertices at the same position are displaced alike; a vertex whose faces cannot all be retracted stays.
/// @param vertices [mm]
/// @return the displaced vertices [mm]
std::vector<Vec3> ghost_vertices(Span<const Vec3> vertices, Span<const Face> faces, double max_length);

/// A face that is displaced as its neighbours need, out of the solid, too.
inline constexpr double kFollowsOthers = -1;

/// How far the faces of a mesh are to be retracted into the solid, and how long displacements may be.
struct FaceRetractions {
  /// Of each face [mm]; 0 for faces that need none, kFollowsOthers for those that are of no account at corners where
  /// others need some. Empty: no face needs any.
  Span<const double> needed;
  double extra = 0;       ///< More than that for faces that need some [mm].
  double usual = 0;       ///< For the others [mm].
  double max_length = 0;  ///< Largest displacement of a vertex [mm].
};

/// A surface whose faces can be retracted, each by a distance of its own. Vertices at one position, T-junctions and the
/// directions of faces are found once, for any number of retractions.
class RetractableSurface {
 public:
  /// @param vertices [mm]
  /// @param faces with normals that point out of the solid
  RetractableSurface(Span<const Vec3> vertices, Span<const Face> faces);

  /// As ghost_vertices(), with distances for each face. Where a displacement would be too long, `extra` and `usual` are
  /// shortened there first.
  std::vector<Vec3> retracted(const FaceRetractions& retractions) const;
  /// The slot of the first vertex at the same position, for each vertex.
  const std::vector<std::uint32_t>& first() const { return first_; }
  /// For the first vertex at each position, if it is an end of one of open_edges().
  const std::vector<bool>& beside_open_edge() const { return beside_open_edge_; }

 private:
  struct DirectionOf {
    std::uint32_t face, direction;
  };
  void add(std::uint32_t face, Vec3 inwards);

  std::vector<Vec3> vertices_;
  std::vector<std::uint32_t> first_;
  std::vector<bool> beside_open_edge_;
  std::vector<Vec3> directions_;            // into the solid, unit, distinct at each vertex
  std::vector<std::uint32_t> begin_;        // of each vertex's range of directions
  std::vector<DirectionOf> directions_of_;  // of the faces at all vertices
};

/// Faces whose normals point out of the solid: those of an inside-out mesh turned round.
std::vector<Face> outward_faces(Span<const Face> faces, bool inside_out);

/// The slot of the first vertex at the same position, for each vertex.
std::vector<std::uint32_t> first_at_position(Span<const Vec3> vertices);

/// The half edges of a mesh in which vertices at one position are one, sorted as sorted_half_edges() has them; without
/// the sides that have no length.
/// @param first as first_at_position() gives it
std::vector<HalfEdge> joined_half_edges(Span<const Face> faces, const std::vector<std::uint32_t>& first);

/// The open edges of a mesh in which vertices at one position are one: around holes, and at T-junctions.
/// @param first as first_at_position() gives it
/// @return between vertices that are the first at their positions
std::vector<HalfEdge> open_edges(Span<const Face> faces, const std::vector<std::uint32_t>& first);

}  // namespace dismantle
