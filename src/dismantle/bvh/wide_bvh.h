// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh.h"
#include "dismantle/core/span.h"
#include "dismantle/geometry/aabb.h"
#include "dismantle/math/lanes.h"
#include "dismantle/math/vec3f.h"

#include <cmath>
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

  /// Lower bounds of the squared distances from a point to the boxes of a node.
  class Distances {
   public:
    /// @param point [mm, frame of the boxes]
    Distances(const WideBvh& bvh, Vec3 point) : margin_(bvh.margin(point)) {
      const Vec3 from = point - bvh.origin_;
      for (int i = 0; i < 3; ++i) point_[i] = static_cast<float>(from[i]);
    }
    /// [mm^2] infinite where there is no child.
    Lanes<kWidth> to(const Node& node) const {
      Lanes<kWidth> squared(0);
      for (int i = 0; i < 3; ++i) {
        const Lanes<kWidth> below = Lanes<kWidth>::load(node.lower[i]) - point_[i];
        const Lanes<kWidth> above = point_[i] - Lanes<kWidth>::load(node.upper[i]);
        const Lanes<kWidth> outside = max(max(below, above) - margin_, Lanes<kWidth>(0));
        squared = squared + outside * outside;
      }
      return squared * Lanes<kWidth>(1 - kSquareRounding);
    }

   private:
    Lanes<kWidth> point_[3];
    Lanes<kWidth> margin_;
  };

  /// Finds the boxes of a node that a ray may meet.
  class Ray {
   public:
    /// @param point, direction [mm, frame of the boxes]; the direction of any length but zero
    Ray(const WideBvh& bvh, Vec3 point, Vec3 direction) : margin_(bvh.margin(point)) {
      const Vec3 from = point - bvh.origin_;
      const double size = max_abs(direction);
      for (int i = 0; i < 3; ++i) {
        point_[i] = static_cast<float>(from[i]);
        const auto along = static_cast<float>(direction[i] / size);
        // So small a component moves the ray by far less than the margin within the boxes.
        is_across_[i] = std::abs(along) < kAcross;
        per_length_[i] = is_across_[i] ? 0 : 1 / along;
      }
    }
    /// Bit i is set if the ray may meet the box of child i.
    unsigned met(const Node& node) const {
      Lanes<kWidth> enter(0), leave(kFar);
      LaneMask<kWidth> may = enter <= leave;
      for (int i = 0; i < 3; ++i) {
        const Lanes<kWidth> lower = Lanes<kWidth>::load(node.lower[i]) - point_[i] - margin_;
        const Lanes<kWidth> upper = Lanes<kWidth>::load(node.upper[i]) - point_[i] + margin_;
        may = may & (lower <= upper);
        if (is_across_[i]) {
          may = may & (lower <= Lanes<kWidth>(0)) & (upper >= Lanes<kWidth>(0));
          continue;
        }
        const Lanes<kWidth> a = lower * per_length_[i], b = upper * per_length_[i];
        enter = max(enter, min(a, b));
        leave = min(leave, max(a, b));
      }
      return bits(may & (enter <= leave));
    }

   private:
    static constexpr float kAcross = 1e-12f, kFar = 3e38f;
    Lanes<kWidth> point_[3], per_length_[3];
    bool is_across_[3];
    Lanes<kWidth> margin_;
  };

 private:
  // Rounding of a squared distance in single precision: three squares of differences, and their sum.
  static constexpr float kSquareRounding = 0x1p-20f;
  // Rounding of a difference of coordinates, relative to their sizes: 2^-24 each for the point, the difference, and
  // what is made of it.
  static constexpr double kPositionRounding = 0x1p-21;

  float margin(Vec3 point) const { return rounded_up(kPositionRounding * (size_ + norm_one(point - origin_))); }

  Vec3 origin_;      // middle of the root's box
  double size_ = 0;  // bound of the coordinates of the boxes, from there [mm]
  std::vector<Node> nodes_;
};

}  // namespace dismantle
