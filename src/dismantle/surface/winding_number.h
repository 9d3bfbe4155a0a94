// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/surface/surface_tree.h"

#include <memory>
#include <optional>
#include <vector>

namespace dismantle {

/// A point where a ray crosses a surface.
struct SurfaceCrossing {
  double distance = 0;  ///< From the ray's origin, in units of the length of its direction.
  int winding = 0;      ///< By how much the winding number falls there: 1 where the ray leaves a solid.
};

/// The solid angle of a triangle seen from a point, over that of the sphere; positive seen from behind, where its
/// normal points away (Van Oosterom, Strackee 1983).
double winding_of(const Triangle& triangle, const Vec3& from);

/// The generalised winding number of a mesh: its solid angle seen from a point, over that of the whole sphere
/// (Jacobson, Kavan, Sorkine-Hornung 2013). 1 inside a closed mesh, -1 inside one that is inside out, 0 outside and in
/// a void bounded by a shell of its own; in between where the mesh has holes, and continuous off the surface.
///
/// Exact up to rounding: the boundary of a mesh consists of closed loops. With each of them closed by a fan of
/// triangles about its centroid the mesh has an integer winding number, that of the crossings of any ray; from it the
/// solid angles of the fans are taken off (Martens, Bessmeltsev 2025, without their projection). Where rounding hides
/// on which side of the surface or of a fan a point is, up to kPlacement, it is either.
///
/// Cracks, which are loops that are narrower than kCrackWidth in all, are taken as closed by their fans. Of a mesh with
/// cracks only, that changes the side of no point that is further than their width from them.
class WindingNumber {
 public:
  /// Widths of cracks in all, as a part of the diagonal: a few loops that the rounding of single precision, or of
  /// seven digits of text, leaves open.
  static constexpr double kCrackWidth = 1e-6;
  /// Largest distance, as a part of the diagonal, at which a point may be taken to be on the other side of a surface.
  static constexpr double kPlacement = 1e-9;

  /// @param surface of `mesh`; must outlive this
  WindingNumber(const TriangleMesh& mesh, const SurfaceTree& surface);

  /// True if the mesh has no holes (cracks do not count): winding numbers are integers.
  bool closed() const { return holes_.empty(); }
  /// Number of edges around holes: what a winding number costs.
  std::size_t rim_edge_count() const { return rim_edge_count_; }
  /// The winding number at a point of the mesh's frame; either one on the surface.
  double at(Vec3 point) const { return at(point, 0); }
  /// Points further than this from the surface are on the side of it that they are taken to be [mm].
  double placement() const { return kPlacement * diagonal_; }
  /// True where the winding number is above 1/2 or below -1/2.
  bool inside(Vec3 point) const;
  /// All crossings of the ray from `point` along `direction` with the mesh whose holes are closed by their fans, by
  /// distance; nothing where the ray passes too near to an edge to decide.
  std::optional<std::vector<SurfaceCrossing>> crossings(Vec3 point, Vec3 direction) const;
  /// The fans that close the mesh; null where there are none.
  const SurfaceTree* fans() const { return fans_.get(); }
  /// A bound of the absolute winding number in a set of points, where the mesh closed by its fans has winding number 0:
  /// a fan that is flat and simple covers no more than half of what can be seen, a far or a narrow one less; infinite
  /// where that mesh has another winding number. @param center, radius a ball around the set; the center is a point of
  /// it
  /// @pre the set is connected and meets neither the mesh nor a fan
  double bound_outside_fans(Vec3 center, double radius) const;
  /// A bound of the change of the winding number from `center` to any point within `radius` [mm], by the law of Biot
  /// and Savart; infinite near the edge of a hole. @pre the surface is further than `radius` from `center`
  double max_change(Vec3 center, double radius) const;

 private:
  /// A loop of boundary edges that is no crack.
  struct Hole {
    std::vector<Vec3> rim;     // corners in order
    Vec3 center;               // apex of the fan
    double radius = 0;         // of the fan about the center
    double area = 0;           // of the fan
    double circumference = 0;  // of the loop
    double width = 0;          // of the fan: the heights of its triangles
    Vec3 spine[2];             // corners that are far apart
    double thickness = 0;      // of the fan about the segment between them
    bool flat = false;         // the fan lies in a plane and covers no point twice

    double bound(Vec3 around, double reach) const;
  };

  double at(Vec3 point, double negligible) const;
  double at(Vec3 point, double negligible, int closed) const;
  std::optional<int> closed_at(Vec3& point) const;
  double fan_winding(const Hole& hole, Vec3 point) const;
  double change_at_rim(const Hole& hole, Vec3 center, double radius) const;

  const SurfaceTree& surface_;
  std::unique_ptr<const SurfaceTree> fans_;  // null where there are none
  std::vector<Hole> holes_;
  std::size_t rim_edge_count_ = 0;
  double diagonal_ = 0;
};

}  // namespace dismantle
