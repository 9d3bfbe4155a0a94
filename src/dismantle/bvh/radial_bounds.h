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

/// Bounds, in cylindrical coordinates about an axis, of the triangles of a tree's node. Certain, despite float32.
struct RadialBounds {
  float min_radius = 0;  ///< No point is nearer to the axis [mm].
  float max_radius = 0;  ///< No point is further from the axis [mm].
  float begin = 0;       ///< Lower bound of the position along the axis, from the axis' point [mm].
  float end = 0;         ///< Upper bound of the position along the axis [mm].
  Vec3f toward;          ///< Middle of the sector about the axis that the triangles are in; unit.
  float cosine = -1;     ///< Of half the sector's angle; -1 for all around.
  float sine = 0;        ///< Of half the sector's angle; 0 for all around.
  /// All outward normals are within 45 degrees of pointing away from the axis, apart from faces across the axis: a
  /// shaft with its ends.
  bool clear_out = false;
  /// The same for normals that point to the axis: a bore with the faces that it opens in.
  bool clear_in = false;
  /// Difference between the largest and the smallest distance from the axis, if the node is one whole cylinder without
  /// gaps, perhaps with its ends; infinite otherwise [mm].
  float radial_deviation = std::numeric_limits<float>::infinity();
};

/// The bounds of a tree's nodes about one axis. Small nodes are unbounded: their distances are from 0 to infinity.
class RadialBoundsList {
 public:
  /// The bounds of a node.
  const RadialBounds& operator[](std::uint32_t node) const { return nodes_[(*slots_)[node]]; }
  /// The number of the tree's nodes.
  std::size_t size() const { return slots_->size(); }

 private:
  friend class RevolutionSurface;
  const std::vector<std::uint32_t>* slots_ = nullptr;  ///< Of each node, among the large ones; 0 for a small one.
  std::vector<RadialBounds> nodes_;                    ///< The first stands for the small ones.
};

/// A component's surface with its axes and threads, and the bounds of its tree's nodes about each axis, which are
/// computed when first needed. Safe to use from several threads at the same time. The spans must outlive it.
class RevolutionSurface {
 public:
  /// Nodes of at least so many faces are large: only they are bounded.
  static constexpr std::uint32_t kLargeNode = 4;

  /// @param nodes of the tree of the faces; not empty
  /// @param axes of the faces
  /// @param threads of the faces
  RevolutionSurface(Span<const Vec3> vertices, Span<const Face> faces, Span<const ObbNode> nodes,
                    std::vector<RevolutionAxis> axes, std::vector<ThreadAxis> threads);

  /// The axes given.
  Span<const RevolutionAxis> axes() const { return axes_; }
  /// The threads given.
  Span<const ThreadAxis> threads() const { return threads_; }
  /// Positions [mm, the mesh's frame].
  Span<const Vec3> vertices() const { return vertices_; }
  /// The mesh's faces.
  Span<const Face> faces() const { return faces_; }
  /// The nodes of the faces' tree.
  Span<const ObbNode> nodes() const { return nodes_; }
  /// The largest extent of the tree's root box [mm].
  double size() const;
  /// The bounds of the tree's nodes about an axis. @param axis index into axes()
  const RadialBoundsList& bounds_about(std::size_t axis) const;

 private:
  /// The tree's nodes, parents before their children.
  std::vector<std::uint32_t> node_order() const;
  struct BoundsAbout {
    std::once_flag once;
    RadialBoundsList nodes;
  };

  Span<const Vec3> vertices_;
  Span<const Face> faces_;
  Span<const ObbNode> nodes_;
  std::vector<RevolutionAxis> axes_;
  std::vector<ThreadAxis> threads_;
  std::vector<std::uint32_t> slots_;  ///< As RadialBoundsList has them.
  std::uint32_t large_count_ = 0;
  std::unique_ptr<BoundsAbout[]> bounds_about_;
};

}  // namespace dismantle
