// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh.h"
#include "dismantle/core/span.h"
#include "dismantle/geometry/aabb.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// A BVH with up to four children a node (BVH4), whose boxes are tested at once in single precision. Queries are
/// conservative: their bounds hold for the boxes in double, despite rounding.
class WideBvh {
 public:
  static constexpr int kWidth = 4;                   ///< Children of a node.
  static constexpr std::uint32_t kLeaf = 1u << 31u;  ///< Flag of a child that is a triangle.

  /// The children of a node, side by side.
  struct alignas(64) Node {
    ///@{ Of the boxes [mm, from the origin], shape [axis][child]; rounded outwards; empty where there is no child.
    float lower[3][kWidth];
    float upper[3][kWidth];
    ///@}
    std::uint32_t child[kWidth];  ///< Index of a node, or a triangle with kLeaf.
  };

  /// Without nodes.
  WideBvh() = default;
  /// Merges the nodes of a binary BVH. @param boxes of its nodes [mm] @pre not empty; fewer than 2^31 triangles
  WideBvh(const Bvh& bvh, Span<const Aabb> boxes);

  /// The root.
  const Node& root() const { return nodes_.front(); }
  /// A node.
  const Node& operator[](std::uint32_t index) const { return nodes_[index]; }

  /// Distances from a point to the boxes of nodes.
  class Distances {
   public:
    /// @param point [mm, frame of the boxes]
    Distances(const WideBvh& bvh, Vec3 point);
    /// Bit i is set if the squared distance to the box of child i may be at most `limit` [mm^2].
    /// @param squared gets lower bounds of the squared distances, infinite where there is no child [mm^2]
    unsigned within(const Node& node, float limit, float (&squared)[kWidth]) const;

   private:
    float point_[3], margin_;
  };

  /// Finds the boxes of nodes that a ray may meet.
  class Ray {
   public:
    /// @param point, direction [mm, frame of the boxes]; the direction of any length but zero
    Ray(const WideBvh& bvh, Vec3 point, Vec3 direction);
    /// Bit i is set if the ray may meet the box of child i.
    unsigned met(const Node& node) const;

   private:
    float point_[3], per_length_[3], margin_;
    bool is_across_[3];
  };

 private:
  /// Bound of the rounding of differences of coordinates to a point.
  float margin(Vec3 point) const;

  Vec3 origin_;      // middle of the root's box
  double size_ = 0;  // bound of the coordinates of the boxes, from there [mm]
  std::vector<Node> nodes_;
};

}  // namespace dismantle
