// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/obb_tree.h"
#include "dismantle/features/axis_frame.h"
#include "dismantle/features/thread_axes.h"

#include <vector>

namespace dismantle {

/// The profile plane of the threads about an axis. Its coordinates are the distance from the axis and the axial offset,
/// which is given up to whole periods.
struct ThreadFrame {
  /// Directions that are bounded, at most.
  static constexpr int kMaxDirections = 6;

  AxisFrame axis;                               ///< Its angles are those of the helices.
  double lead = 0;                              ///< Advance along the axis per turn [mm]; not 0.
  double period = 0;                            ///< Of the axial offset [mm]; above 0, the lead is a multiple of it.
  int direction_count = 1;                      ///< Directions that nodes are bounded along.
  ProfileDirection directions[kMaxDirections];  ///< The first is the axial one.

  /// Adds a direction if there is room, and none that is nearly the same.
  void add_direction(ProfileDirection direction);
};

/// Bounds of the triangles of a tree's node in a thread's frame. Certain, despite float32.
struct ThreadBounds {
  float min_radius = 0;  ///< No point is nearer to the axis [mm].
  float max_radius = 0;  ///< No point is further from the axis [mm].
  float begin = 0;       ///< Lower bound of the position along the axis [mm].
  float end = 0;         ///< Upper bound of the position along the axis [mm].
  /// Lower bounds of (distance, axial offset) along each direction, with a whole number of periods added to the offsets
  /// of each triangle [mm]; minus infinity if nothing is known.
  float low[ThreadFrame::kMaxDirections];
  float high[ThreadFrame::kMaxDirections];  ///< Upper bounds of the same; infinity if nothing is known [mm].
};

/// The bounds of a tree's nodes in one thread's frame. Small nodes are unbounded.
class ThreadBoundsList {
 public:
  /// Nodes of at least so many faces are large: only they are bounded.
  static constexpr std::uint32_t kLargeNode = 4;

  /// @param nodes of the tree of the faces; not empty
  ThreadBoundsList(const ThreadFrame& frame, Span<const Vec3> vertices, Span<const Face> faces,
                   Span<const ObbNode> nodes);

  /// The bounds of a node.
  const ThreadBounds& operator[](std::uint32_t node) const { return nodes_[slots_[node]]; }
  /// Distances and positions along the axis of all nodes that are bounded along the directions; begin > end if none is.
  const ThreadBounds& whole() const { return whole_; }
  ///@{ Prefetch the memory of a node's bounds: first the slot that they are found by, some calls later the bounds.
  void prefetch_slot(std::uint32_t node) const { __builtin_prefetch(&slots_[node]); }
  void prefetch(std::uint32_t node) const { __builtin_prefetch(&nodes_[slots_[node]]); }
  ///@}

 private:
  std::vector<std::uint32_t> slots_;  // of each node, among the large ones; 0 for a small one
  std::vector<ThreadBounds> nodes_;   // the first stands for the small ones
  ThreadBounds whole_;
};

}  // namespace dismantle
