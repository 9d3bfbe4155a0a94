// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/exec/device_array.h"
#include "dismantle/streams/device/device_kernels.h"
#include "dismantle/surface/assembly_triangles.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

namespace dismantle::device_code {

/// AssemblyTriangles in a device's memory: what stays the same from step to step.
struct Geometry {
  DeviceArray<Vec3> assembled;  ///< S_v0
  DeviceArray<Face> faces;
  DeviceArray<std::uint8_t> features;
  DeviceArray<BvhChildren> children;
  DeviceArray<BvhComponent> ranges;
  DeviceArray<std::uint32_t> component_of_vertex, component_of_node;
  DeviceArray<NodeIndex> parents;  ///< Of each node; kNoNode of the root.
  NodeIndex leaf_count, top_begin;
  int key_bits;                    ///< Low bits in which keys of leaf pairs differ.
  std::uint64_t first_front_node;  ///< kDeadNode where there are not two components to meet.

  template <class Queue>
  Geometry(Queue& queue, const AssemblyTriangles& fixed);

  BvhView tree() const {
    BvhView tree;
    tree.children = children.view();
    tree.component_of = component_of_node.view();
    tree.leaf_count = leaf_count;
    tree.top_begin = top_begin;
    return tree;
  }
};

inline std::vector<std::uint32_t> components_of_vertices(const AssemblyTriangles& fixed) {
  std::vector<std::uint32_t> component_of;
  for (std::uint32_t c = 0; c < fixed.component_count(); ++c) component_of.resize(fixed.vertex_begin[c + 1], c);
  return component_of;
}

inline std::vector<NodeIndex> parents_of_nodes(const Bvh& bvh) {
  std::vector<NodeIndex> parents(bvh.node_count(), kNoNode);
  for (NodeIndex i = 0; i < bvh.children.size(); ++i)
    parents[bvh.children[i].left] = parents[bvh.children[i].right] = bvh.leaf_count() + i;
  return parents;
}

template <class Queue>
Geometry::Geometry(Queue& queue, const AssemblyTriangles& fixed)
    : assembled(queue, Span<const Vec3>(fixed.vertices)),
      faces(queue, Span<const Face>(fixed.faces)),
      features(queue, Span<const std::uint8_t>(fixed.features)),
      children(queue, Span<const BvhChildren>(fixed.bvh.children)),
      ranges(queue, Span<const BvhComponent>(fixed.bvh.components)),
      component_of_vertex(queue, Span<const std::uint32_t>(components_of_vertices(fixed))),
      component_of_node(queue, Span<const std::uint32_t>(fixed.bvh.component_of)),
      parents(queue, Span<const NodeIndex>(parents_of_nodes(fixed.bvh))),
      leaf_count(fixed.bvh.leaf_count()),
      top_begin(fixed.bvh.top_begin),
      key_bits(32 + static_cast<int>(std::bit_width(leaf_count))),
      first_front_node(top_begin < fixed.bvh.node_count() ? pair_key(fixed.bvh.root(), fixed.bvh.root()) : kDeadNode) {}

/// What kernels append to, and what is made of it. Where something was full it grows, and the step is run again.
class Buffers {
 public:
  /// @param capacity that everything starts with, at least 1
  template <class Queue>
  Buffers(Queue& queue, std::size_t capacity)
      : front(queue, capacity),
        kept(queue, capacity),
        sprouted(queue, capacity),
        pending{DeviceArray<std::uint64_t>(queue, capacity), DeviceArray<std::uint64_t>(queue, capacity)},
        triangle_pairs(queue, capacity),
        sorted_pairs(queue, capacity),
        intersections(queue, capacity),
        contacts(queue, capacity),
        sort_scratch(queue, queue.sort_scratch_bytes(capacity)) {}

  DeviceArray<std::uint64_t> front;  ///< S_f
  DeviceArray<std::uint64_t> kept, sprouted, pending[2];
  DeviceArray<std::uint64_t> triangle_pairs, sorted_pairs;  ///< S_t, as it was appended and sorted
  DeviceArray<std::uint64_t> intersections;
  DeviceArray<TrianglePairContact> contacts;
  DeviceArray<std::byte> sort_scratch;

  StepCapacity capacity() const {
    return {front.size(), triangle_pairs.size(), kept.size(), sprouted.size(), pending[0].size()};
  }

  /// Makes room for what the front needed. What the front holds stays. @return true where it had not enough
  template <class Queue>
  bool grow_front(Queue& queue, const StepCounters& needed);
  /// Makes room for what the narrow phase found. @return true where it had not enough
  template <class Queue>
  bool grow_narrow_phase(Queue& queue, const StepCounters& needed) {
    const bool grown = grow(queue, contacts, needed.contacts);
    return grow(queue, intersections, needed.intersections) || grown;
  }

 private:
  template <class Queue, class T>
  static bool grow(Queue& queue, DeviceArray<T>& array, std::uint64_t needed) {
    if (needed <= array.size()) return false;
    array = DeviceArray<T>(queue, needed + needed / 2);
    return true;
  }
};

template <class Queue>
bool Buffers::grow_front(Queue& queue, const StepCounters& needed) {
  bool grown = false;
  if (const std::uint64_t nodes = StepCapacity::front_needed(needed); nodes > front.size()) {
    DeviceArray<std::uint64_t> larger(queue, nodes + nodes / 2);
    queue.copy(larger.view().data(), front.view().data(), front.size() * sizeof(std::uint64_t));
    queue.wait();
    front = std::move(larger);
    grown = true;
  }
  if (grow(queue, triangle_pairs, needed.triangle_pairs)) {
    sorted_pairs = DeviceArray<std::uint64_t>(queue, triangle_pairs.size());
    sort_scratch = DeviceArray<std::byte>(queue, queue.sort_scratch_bytes(triangle_pairs.size()));
    grown = true;
  }
  grown = grow(queue, kept, needed.kept) || grown;
  grown = grow(queue, sprouted, needed.sprouted) || grown;
  for (DeviceArray<std::uint64_t>& left : pending)
    grown = grow(queue, left, StepCapacity::max_pending(needed)) || grown;
  return grown;
}

}  // namespace dismantle::device_code
