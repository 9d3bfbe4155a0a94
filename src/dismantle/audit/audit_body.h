// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace dismantle::audit {

/// A node of a tree of boxes, depth first: the left child is the next node.
struct BoxNode {
  Vec3 center;              ///< Centre of the box [mm, body frame].
  Vec3 half;                ///< Half sizes of the box [mm].
  double radius = 0;        ///< Radius of the sphere around the box [mm].
  double reach = 0;         ///< Largest distance of a point of the box from the body's origin [mm].
  std::uint32_t right = 0;  ///< Index of the right child; 0 for a leaf.
  std::uint32_t face = 0;   ///< Face of a leaf.
  /// True for a leaf.
  bool leaf() const { return right == 0; }
};

/// The distance of a point from a surface.
struct SurfacePoint {
  double distance = 0;     ///< [mm]
  std::uint32_t face = 0;  ///< The nearest face.
};

/// The signed number of faces that a ray crosses: for a closed surface, the winding number of the ray's start.
struct RayCrossings {
  int number = 0;       ///< Faces that are crossed from their inner side, minus those from their outer side.
  Vec3 direction;       ///< Of the ray, of unit length.
  bool certain = true;  ///< False if it passes an edge too closely to tell, in all directions.
};

/// The distance of `point` from the closed triangle `t` [mm].
double distance_to_triangle(const Triangle& t, Vec3 point);

/// A component for the audit: its mesh in the body's frame, the assembled state with the centre of its box as origin
/// (in which coordinates are small wherever the assembly is), and a tree of boxes with one triangle in each leaf.
class AuditBody {
 public:
  /// Builds the tree; it depends on the component alone.
  explicit AuditBody(const Component& component);

  /// The origin of the body's frame [mm, assembly frame].
  Vec3 center() const { return center_; }
  /// The transform from the body's frame to the world at a pose.
  RigidTransform world_from_body(const Pose& pose) const;
  ///@{ The mesh [mm, body frame].
  std::size_t vertex_count() const { return mesh_.vertices.size(); }
  Vec3 vertex(std::uint32_t v) const { return mesh_.vertices[v]; }
  std::uint32_t face_count() const { return static_cast<std::uint32_t>(mesh_.faces.size()); }
  const Face& face(std::uint32_t f) const { return mesh_.faces[f]; }
  Triangle triangle(std::uint32_t f) const { return mesh_.triangle(f); }
  ///@}
  /// True for a component without triangles.
  bool empty() const { return nodes_.empty(); }
  /// A node of the tree; 0 is the root. @pre !empty()
  const BoxNode& node(std::uint32_t i) const { return nodes_[i]; }
  /// True if the surface bounds a volume, so that contains() is defined.
  bool closed() const { return closed_; }
  /// One vertex of each connected piece of the surface.
  const std::vector<std::uint32_t>& piece_vertices() const { return piece_vertices_; }
  /// Bound of the coordinates of the assembled vertices in the assembly frame [mm], which their rounding is relative
  /// to.
  double coordinate_bound() const { return coordinate_bound_; }

  /// The distance of a point [mm, body frame] from the surface. @param hint a face to start from @pre !empty()
  SurfacePoint closest(Vec3 point, std::uint32_t hint = 0) const;
  /// The distance of a point [mm, body frame] from the box of the surface, which is no more than that from the surface.
  /// @pre !empty()
  double distance_from_box(Vec3 point) const;
  /// Some face that is no further from a point [mm, body frame] than `distance`; nothing where there is none.
  /// @param hint a face to start from @pre !empty()
  std::optional<std::uint32_t> face_within(Vec3 point, double distance, std::uint32_t hint = 0) const;
  /// True if the surface's winding number about the point is not 0, by a ray in general position; undefined on the
  /// surface.
  /// @pre closed()
  bool contains(Vec3 point) const;
  /// Number of directions of rays.
  static constexpr int kRayDirections = 5;
  /// The crossings of a ray from a point, in the first direction from number `first` on in which it passes no edge too
  /// closely. @pre 0 <= first < kRayDirections
  RayCrossings ray_crossings(Vec3 point, int first = 0) const;
  /// The signed number of faces between two points, so that it is the difference of their winding numbers; nothing
  /// where the segment passes an edge, or ends at a face, too closely to tell. @pre the surface is closed; where there
  /// are cracks, the segment may pass through one
  std::optional<int> crossings_between(Vec3 from, Vec3 to) const;

 private:
  std::uint32_t build(std::uint32_t first, std::uint32_t count, std::vector<std::uint32_t>& order,
                      const std::vector<Vec3>& centroids);
  void find_pieces();
  /// Visits the faces of the leaves that may_meet(node) admits, below nodes that it admits, until visit(face) is false.
  /// @return whether it never was
  template <class MayMeet, class Visit>
  bool visit_faces(const MayMeet& may_meet, const Visit& visit) const;
  /// The winding number of the surface about a point, by one ray; not certain where the ray passes too close to an
  /// edge.
  struct Winding {
    int number = 0;
    bool certain = true;
  };
  Winding winding(Vec3 point, const Mat3& frame) const;
  /// Where the line through a point along the third axis of a frame passes a face.
  struct Crossing {
    int number = 0;       // 1 or -1 by the side that it comes from; 0 if it passes by
    double height = 0;    // along the line, from the point
    bool certain = true;  // it does not pass too close to an edge
  };
  Crossing crossing(std::uint32_t face, Vec3 point, const Mat3& frame) const;

  TriangleMesh mesh_;
  Vec3 center_;
  std::vector<BoxNode> nodes_;
  std::vector<std::uint32_t> piece_vertices_;
  double coordinate_bound_ = 0;
  bool closed_ = false;
};

}  // namespace dismantle::audit
