// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"
#include "dismantle/math/rigid_transform.h"
#include "dismantle/surface/surface_tree.h"

#include <optional>
#include <vector>

namespace dismantle {

/// A mesh whose surface is compared with others.
class ComparedSurface {
 public:
  /// @param mesh with a triangle; must outlive this
  explicit ComparedSurface(const TriangleMesh& mesh);

  /// The mesh.
  const TriangleMesh& mesh() const { return *mesh_; }
  /// The tree of its triangles.
  const SurfaceTree& tree() const { return tree_; }
  /// [mm^2]
  double area() const { return area_; }
  /// The centroid of the surface [mm].
  Vec3 center() const { return center_; }
  /// The largest distance of a vertex from the centroid [mm].
  double reach() const { return distances_[order_.back()]; }
  /// The distances of the vertices from the centroid [mm].
  const std::vector<double>& distances() const { return distances_; }
  /// The vertices by that distance, ascending.
  const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  const TriangleMesh* mesh_;
  SurfaceTree tree_;
  double area_ = 0;
  Vec3 center_;
  std::vector<double> distances_;
  std::vector<std::uint32_t> order_;
};

/// Two meshes of one shape have areas that differ by no more than this share: tessellations of equal faces with the
/// same deflection differ by a few 1e-5, cylinders whose diameters differ by a thousandth by 1e-3.
inline constexpr double kEqualArea = 1e-4;

/// The rigid motion, without reflection, that takes the surface of one mesh onto that of another which is tessellated
/// with other vertices, if one is found: their areas differ by no more than kEqualArea, and each vertex of either is no
/// further from the surface of the other one than `within`. Found from pairs of vertices that both have up to `within`,
/// as corners and the vertices of edges of CAD faces are; others may be missed. @param within [mm]; more than 0
std::optional<RigidTransform> surface_congruence(const ComparedSurface& a, const ComparedSurface& b, double within);

}  // namespace dismantle
