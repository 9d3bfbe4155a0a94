// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/solid/depth_search.h"
#include "dismantle/audit/solid/surface_piece.h"
#include "dismantle/core/span.h"
#include "dismantle/geometry/aabb.h"

#include <cstdint>
#include <vector>

namespace dismantle::audit {

/// Nodes of the tree of a body near something.
struct NearNodes {
  Span<const std::uint32_t> nodes;  ///< Indices of the nodes.
  double reach = 0;                 ///< All faces that come within this distance are below them [mm].
};

/// The part of a depth search that divides triangles and times: both below the boxes.
class PieceSearch {
 public:
  /// @param solid what the pieces may be inside; must outlive this @param rounding error bound of a depth [mm]
  PieceSearch(const SolidBody& solid, const DepthGoal& goal, double rounding);

  /// Depths up to this need not be found any more [mm].
  double limit() const;
  /// True if the search is to end.
  bool ended() const;
  /// Searches a triangle of the other body in a slice of time.
  /// @param near the nodes of `solid` near it during the slice
  void search(const TimeSlice& slice, const Triangle& triangle, const NearNodes& near);

  /// The findings; their `point_a` is in the frame of `solid`.
  const DepthFindings& findings() const { return findings_; }

 private:
  /// Faces in `faces_`, and the distance up to which they are all.
  struct Range {
    std::size_t first = 0, count = 0;
    double reach = 0;
  };
  /// The nearest face to the centre of a piece.
  struct Nearest {
    double distance = 0;
    std::uint32_t face = 0;
  };

  void check(const TimeSlice& slice, const Triangle& triangle, const Range& parent);
  void divide(const TimeSlice& slice, const SurfacePiece& piece, const Range& near);
  Range near_faces(const SurfacePiece& piece, const Range& parent);
  /// Adds the faces below some nodes whose boxes are within `reach` of a box.
  void add_faces(const Aabb& box, double reach, Span<const std::uint32_t> below);
  Nearest nearest_face(const SurfacePiece& piece, const Range& parent);
  /// True if all of the piece certainly stays within the limit of the surface.
  bool near_surface(const SurfacePiece& piece, const Nearest& nearest) const;
  /// True if the piece, or a copy of it shifted by no more than the limit, certainly stays outside.
  bool stays_outside(const SurfacePiece& piece, const Range& near, const Nearest& nearest);
  bool clear_when_shifted(const SurfacePiece& piece, Vec3 shift, const Range& near);
  bool ghost_is_clear(const SurfacePiece& piece, const Range& near, const Nearest& nearest, bool inside);
  void sample(const TimeSlice& slice, const SurfacePiece& piece);

  const SolidBody& solid_;
  DepthGoal goal_;
  double rounding_;
  std::vector<std::uint32_t> faces_;  // a stack of ranges
  std::vector<std::uint32_t> open_;   // of add_faces()
  std::uint32_t last_face_ = 0;
  SolidBody::LastPoint last_point_;
  DepthFindings findings_;
};

}  // namespace dismantle::audit
