// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"

#include <cstdint>
#include <limits>
#include <vector>

/// Random families of scenes, and an oracle that shares no code with the engines or the audit but vectors.
namespace dismantle::families {

/// A triangle of a mesh and its distance from a point [mm].
struct NearestFace {
  double distance = std::numeric_limits<double>::infinity();
  std::uint32_t face = 0;
  Vec3 point;  ///< The nearest point of the face.
};

/// Queries on one mesh: nearest point, crossings of segments, and the generalised winding number.
class OracleMesh {
 public:
  /// @param solid the mesh is closed but for cracks: it has an inside
  /// @param simple it does not intersect itself
  OracleMesh(TriangleMesh mesh, bool solid, bool simple);

  const TriangleMesh& mesh() const { return mesh_; }
  /// True if the mesh has an inside.
  bool solid() const { return solid_; }
  const Aabb& bounds() const { return nodes_.front().box; }
  double radius() const { return radius_; }  ///< Of a ball about the origin that holds the mesh [mm].

  /// The nearest face, if it is nearer than `limit` [mm].
  NearestFace nearest(Vec3 point, double limit = std::numeric_limits<double>::infinity()) const;
  /// The distance to one face [mm].
  double distance_to(std::uint32_t face, Vec3 point) const;
  /// True if a segment meets a face. Watertight: nothing slips through between faces with common vertices.
  bool crossed(Vec3 from, Vec3 to) const;
  /// The winding number, to within a few hundredths.
  double winding(Vec3 point) const;
  /// True if the mesh is solid and the point inside it.
  bool inside(Vec3 point) const { return solid_ && inside(point, nearest(point)); }
  /// As above. @param near the face nearest to the point
  bool inside(Vec3 point, const NearestFace& near) const;

 private:
  struct Node {
    Aabb box;
    std::uint32_t first = 0, count = 0;  // faces of a leaf
    std::uint32_t left = 0, right = 0;   // children
    Vec3 center, area;                   // weighted center of the faces, sum of their area vectors
    double radius = 0;                   // of the faces about the center
  };

  std::uint32_t build(std::uint32_t first, std::uint32_t count);
  void sum_up(Node& node) const;

  TriangleMesh mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<Vec3> normals_;  // unit
  std::vector<Node> nodes_;
  double radius_ = 0;
  bool solid_ = false, simple_ = false;
};

/// True if a mesh is closed, but for cracks and small openings.
bool is_solid(const TriangleMesh& mesh);

}  // namespace dismantle::families
