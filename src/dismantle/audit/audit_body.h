// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace dismantle::audit {

/// A node of a tree of boxes, depth first: the left child is the next node.
struct BoxNode {
  Vec3 center, half;        ///< The box [mm], body frame.
  double radius = 0;        ///< Of the sphere around the box.
  double reach = 0;         ///< The largest distance of a point of the box from the body's origin.
  std::uint32_t right = 0;  ///< The right child; 0 in a leaf.
  std::uint32_t face = 0;   ///< The triangle of a leaf.
  bool leaf() const { return right == 0; }
};

/// The point of a surface that is closest to some point.
struct SurfacePoint {
  double distance = 0;  ///< [mm]
  std::uint32_t face = 0;
};

/// The distance of `point` from the closed triangle `t`.
double distance_to_triangle(const Triangle& t, Vec3 point);

/// A component as the audit sees it: its assembled vertices about the centre of their box (the body's frame, in which
/// coordinates are small wherever the assembly stands) under a tree of boxes, a triangle a leaf.
class AuditBody {
 public:
  explicit AuditBody(const Component& component);

  /// The origin of the body's frame, in the assembly frame.
  Vec3 center() const { return center_; }
  /// From the body's frame to the world at a pose.
  RigidTransform world_from_body(const Pose& pose) const;
  std::size_t vertex_count() const { return mesh_.vertices.size(); }
  Vec3 vertex(std::uint32_t v) const { return mesh_.vertices[v]; }
  std::uint32_t face_count() const { return static_cast<std::uint32_t>(mesh_.faces.size()); }
  const Face& face(std::uint32_t f) const { return mesh_.faces[f]; }
  Triangle triangle(std::uint32_t f) const { return mesh_.triangle(f); }
  bool empty() const { return nodes_.empty(); }
  const BoxNode& node(std::uint32_t i) const { return nodes_[i]; }
  /// "Inside" means something.
  bool closed() const { return closed_; }
  /// A vertex of each connected piece of the surface.
  const std::vector<std::uint32_t>& piece_vertices() const { return piece_vertices_; }
  /// Bound of the coordinates that the assembled vertices were given in [mm]: what their rounding is relative to.
  double coordinate_bound() const { return coordinate_bound_; }

  /// The closest triangle; `hint` is a triangle that may be close. @pre !empty()
  SurfacePoint closest(Vec3 point, std::uint32_t hint = 0) const;
  /// True where the surface winds around the point. Decided by a ray in general position; meaningless on the surface.
  /// @pre closed()
  bool contains(Vec3 point) const;

 private:
  std::uint32_t build(std::uint32_t first, std::uint32_t count, std::vector<std::uint32_t>& order,
                      const std::vector<Vec3>& centroids);
  void find_pieces();
  /// How often the surface winds around a point, by one ray; not certain where the ray passes too close to an edge.
  struct Winding {
    int number = 0;
    bool certain = true;
  };
  Winding winding(Vec3 point, const Mat3& frame) const;

  TriangleMesh mesh_;
  Vec3 center_;
  std::vector<BoxNode> nodes_;
  std::vector<std::uint32_t> piece_vertices_;
  double coordinate_bound_ = 0;
  bool closed_ = false;
};

}  // namespace dismantle::audit
