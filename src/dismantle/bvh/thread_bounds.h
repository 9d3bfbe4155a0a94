// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/obb_tree.h"
#include "dismantle/features/axis_frame.h"
#include "dismantle/features/thread_axes.h"

#include <vector>

namespace dismantle {

/// The coordinates in which threads about an axis are seen: the distance from it, and the lift, which repeats.
struct ThreadFrame {
  static constexpr int kMaxDirections = 6;

  AxisFrame axis;
  double lead = 0;    ///< Along the axis a turn [mm]; not 0.
  double period = 0;  ///< Lifts that differ by it are the same [mm]; above 0, and the lead is a multiple of it.
  /// The directions in the plane of both along which nodes are bounded; the first is that of the lift.
  int direction_count = 1;
  ProfileDirection directions[kMaxDirections];

  /// Adds a direction if there is room, and none that is nearly the same.
  void add_direction(ProfileDirection direction);
};

/// Where the triangles of a tree's node are in a thread's frame; certain, despite float32.
struct ThreadNode {
  float least = 0, most = 0;  ///< Every point's distance from the axis is between these [mm].
  float begin = 0, end = 0;   ///< And its place along the axis [mm].
  /// And (distance, lift) along each direction, one whole number of periods added to all lifts of a triangle [mm];
  /// without bounds where nothing is known.
  float low[ThreadFrame::kMaxDirections], high[ThreadFrame::kMaxDirections];
};

/// The nodes of a tree in one thread's frame. Of small nodes nothing is known.
class ThreadNodes {
 public:
  /// Nodes of at least so many faces are large.
  static constexpr std::uint32_t kLargeNode = 4;

  /// @param nodes of the faces' tree; not empty
  ThreadNodes(const ThreadFrame& frame, Span<const Vec3> vertices, Span<const Face> faces, Span<const ObbNode> nodes);

  const ThreadNode& operator[](std::uint32_t node) const { return nodes_[places_[node]]; }
  /// Asks for the memory that a node is found by, and a while later for its own.
  void fetch_place(std::uint32_t node) const { __builtin_prefetch(&places_[node]); }
  void fetch(std::uint32_t node) const { __builtin_prefetch(&nodes_[places_[node]]); }

 private:
  std::vector<std::uint32_t> places_;  // of each node among the large ones; 0 for a small one
  std::vector<ThreadNode> nodes_;      // the first stands for the small ones
};

}  // namespace dismantle
