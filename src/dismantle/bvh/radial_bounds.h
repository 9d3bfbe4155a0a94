// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/obb_tree.h"
#include "dismantle/features/revolution_axes.h"
#include "dismantle/features/thread_axes.h"

#include <limits>
#include <memory>
#include <mutex>
#include <vector>

namespace dismantle {

/// Where the triangles of a tree's node are about an axis; certain, despite float32.
struct RadialBounds {
  float least = 0, most = 0;  ///< Every point's distance from the axis is between these [mm].
  float begin = 0, end = 0;   ///< And its place along the axis, from the axis' point [mm].
  /// Seen from the axis all of it is within an angle of the unit vector `toward`: its cosine and sine; -1 and 0 for all
  /// around.
  Vec3f toward;
  float cosine = -1, sine = 0;
  bool faces_out = false;  ///< All outward normals are within 45 degrees of pointing away from the axis,
  bool faces_in = false;   ///< or to it.
  bool clear_out = false;  ///< All are, but for those of faces that lie across the axis: a shaft with its ends;
  bool clear_in = false;   ///< or to it: a bore with the faces that it opens in.
  /// Of one whole cylinder, without gaps, and perhaps its ends: how much its distances differ [mm]. Infinite for all
  /// else.
  float spread = std::numeric_limits<float>::infinity();
};

/// The nodes of a tree about one axis. Of small nodes nothing is known: their distances are from 0 to without end.
class RadialBoundsList {
 public:
  const RadialBounds& operator[](std::uint32_t node) const { return nodes_[(*places_)[node]]; }
  std::size_t size() const { return places_->size(); }

 private:
  friend class RevolutionSurface;
  const std::vector<std::uint32_t>* places_ = nullptr;  ///< Of each node among the large ones; 0 for a small one.
  std::vector<RadialBounds> nodes_;                     ///< The first stands for the small ones.
};

/// A component's axes and threads, and its tree's nodes about each, which are worked out when first asked for. May be
/// asked by several threads at the same time. What the spans look at must outlive it.
class RevolutionSurface {
 public:
  /// Nodes of at least so many faces are large: what parts two surfaces of revolution is for them.
  static constexpr std::uint32_t kLargeNode = 4;

  /// @param nodes of the faces' tree; not empty
  /// @param axes, threads of the faces
  RevolutionSurface(Span<const Vec3> vertices, Span<const Face> faces, Span<const ObbNode> nodes,
                    std::vector<RevolutionAxis> axes, std::vector<ThreadAxis> threads);

  Span<const RevolutionAxis> axes() const { return axes_; }
  Span<const ThreadAxis> threads() const { return threads_; }
  Span<const Vec3> vertices() const { return vertices_; }
  Span<const Face> faces() const { return faces_; }
  Span<const ObbNode> nodes() const { return nodes_; }
  /// The largest extent of the tree's root box [mm].
  double size() const;
  /// The nodes of the tree about one axis.
  const RadialBoundsList& about(std::size_t axis) const;

 private:
  struct About {
    std::once_flag once;
    RadialBoundsList nodes;
  };

  Span<const Vec3> vertices_;
  Span<const Face> faces_;
  Span<const ObbNode> nodes_;
  std::vector<RevolutionAxis> axes_;
  std::vector<ThreadAxis> threads_;
  std::vector<std::uint32_t> order_;   ///< The tree's nodes, parents before their children.
  std::vector<std::uint32_t> places_;  ///< As RadialBoundsList has it.
  std::uint32_t large_count_ = 0;
  std::unique_ptr<About[]> about_;
};

}  // namespace dismantle
