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

/// AssemblyTriangles in a device's memory: the data that stays the same from step to step.
struct Geometry {
  DeviceArray<Vec3> assembled;                     ///< S_v0 [mm, assembled].
  DeviceArray<Face> faces;                         ///< In leaf order.
  DeviceArray<std::uint8_t> features;              ///< Features that each leaf represents.
  DeviceArray<BvhChildren> children;               ///< Of the inner nodes.
  DeviceArray<BvhComponent> ranges;                ///< Nodes of each component.
  DeviceArray<std::uint32_t> component_of_vertex;  ///< Shape [vertex_count].
  DeviceArray<std::uint32_t> component_of_node;    ///< As Bvh::component_of.
  DeviceArray<NodeIndex> parents;                  ///< Shape [node_count]; kNoNode for the root.
  NodeIndex leaf_count;                            ///< Number of leaves.
  NodeIndex top_begin;                             ///< First node above the components.
  int key_bits;                                    ///< Low bits in which keys of leaf pairs differ.
  std::uint64_t first_front_node;                  ///< Key of the root pair; kDeadNode with fewer than two components.

  /// Uploads everything.
  template <class Queue>
  Geometry(Queue& queue, const AssemblyTriangles& fixed);

  /// A view of the hierarchy for kernels.
  BvhView tree() const {
    BvhView tree;
    tree.children = children.view();
    tree.component_of = component_of_node.view();
    tree.leaf_count = leaf_count;
    tree.top_begin = top_begin;
    return tree;
  }
};

/// The component of each vertex.
inline std::vector<std::uint32_t> components_of_vertices(const AssemblyTriangles& fixed) {
  std::vector<std::uint32_t> component_of;
  for (std::uint32_t c = 0; c < fixed.component_count(); ++c) component_of.resize(fixed.vertex_begin[c + 1], c);
  return component_of;
}

/// The parent of each node; kNoNode for the root.
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

/// A view of what a step uploads, on the host or the device.
class UploadView {
 public:
  /// Words of 8 bytes for so many components.
  static std::size_t word_count(std::size_t components) {
    return components * (2 * kTransformWords + 1) + (components + 1) / 2 + 1;
  }

  /// @param words the memory, word_count() of them
  UploadView(Span<std::uint64_t> words, std::size_t components) : words_(words.data()), count_(components) {}

  ///@{ S_tm at the start and the end of the step: world from assembled, shape [component_count].
  Span<RigidTransform> start() const { return at<RigidTransform>(0); }
  Span<RigidTransform> end() const { return at<RigidTransform>(kTransformWords * count_); }
  ///@}
  /// Shape [component_count].
  Span<ComponentStep> components() const { return at<ComponentStep>(2 * kTransformWords * count_); }
  /// Equal for components without relative motion, shape [component_count].
  Span<std::uint32_t> motion_class() const { return at<std::uint32_t>((2 * kTransformWords + 1) * count_); }
  /// Of the whole step.
  StepInput& input() const { return *reinterpret_cast<StepInput*>(words_ + word_count(count_) - 1); }

 private:
  static constexpr std::size_t kTransformWords = sizeof(RigidTransform) / sizeof(std::uint64_t);
  static_assert(sizeof(ComponentStep) == sizeof(std::uint64_t) && sizeof(StepInput) <= sizeof(std::uint64_t));

  template <class T>
  Span<T> at(std::size_t word) const {
    return {reinterpret_cast<T*>(words_ + word), count_};
  }

  std::uint64_t* words_;
  std::size_t count_;
};

/// All that a step uploads, in one copy.
class Upload {
 public:
  /// Uninitialized. @param queue allocates the memory
  template <class Queue>
  Upload(Queue& queue, std::size_t components)
      : words_(queue, UploadView::word_count(components)), components_(components) {}

  ///@{ The content on the host and on the device.
  UploadView on_host() { return {words_.on_host(), components_}; }
  UploadView on_device() { return {words_.on_device(), components_}; }
  ///@}
  /// Enqueues the copy from the host to the device.
  template <class Queue>
  void copy_up(Queue& queue) {
    words_.copy_up(queue);
  }

 private:
  MirroredArray<std::uint64_t> words_;
  std::size_t components_;
};

/// The number of triangle pairs that recordings sort and test: it follows what the steps need.
class PairRoom {
 public:
  /// @param capacity of S_t
  explicit PairRoom(std::size_t capacity) : size_(std::min(kMin, capacity)) {}

  /// The number of pairs.
  std::size_t size() const { return size_; }
  /// True if all are tested in one round of the narrow phase: then their order does not matter.
  bool one_round() const { return size_ <= narrow_phase_round_end(0); }
  /// Makes room for the pairs of a step. @return true if there was too little: the narrow phase must be repeated
  bool grow(std::size_t count, std::size_t capacity) {
    if (count <= size_) return false;
    size_ = std::min(count + count / 2, capacity);
    return true;
  }
  /// Takes room back that steps have not needed for a while. @return true if it did
  bool shrink(std::size_t count) {
    steps_with_few_ = size_ > kMin && kShareOfFew * count < size_ ? steps_with_few_ + 1 : 0;
    if (steps_with_few_ < kSteps) return false;
    size_ = std::max(kMin, 2 * count);
    steps_with_few_ = 0;
    return true;
  }

 private:
  static constexpr std::size_t kMin = 2048, kShareOfFew = 8;
  static constexpr int kSteps = 64;

  std::size_t size_;
  int steps_with_few_ = 0;
};

/// The arrays that kernels append to, and those derived from them. Full arrays grow, and the step is run again.
class Buffers {
 public:
  /// @param capacity initial size of all arrays, at least 1
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

  DeviceArray<std::uint64_t> front;           ///< S_f
  DeviceArray<std::uint64_t> kept;            ///< New nodes of the front.
  DeviceArray<std::uint64_t> sprouted;        ///< Slots of the front that are replaced.
  DeviceArray<std::uint64_t> pending[2];      ///< Pairs for the next round; rounds alternate between the two.
  DeviceArray<std::uint64_t> triangle_pairs;  ///< S_t, in the order appended.
  DeviceArray<std::uint64_t> sorted_pairs;    ///< S_t, ascending.
  DeviceArray<std::uint64_t> intersections;   ///< Intersecting pairs of S_i.
  DeviceArray<TrianglePairContact> contacts;  ///< Pairs that block the motion.
  DeviceArray<std::byte> sort_scratch;        ///< For the queue's sort.

  /// The sizes of the arrays of the front.
  StepCapacity capacity() const {
    return {front.size(), triangle_pairs.size(), kept.size(), sprouted.size(), pending[0].size()};
  }

  /// Enlarges the arrays that were too small for the front, and keeps the front itself. @return true if some were
  template <class Queue>
  bool grow_front(Queue& queue, const StepCounters& needed);
  /// Enlarges the arrays that were too small for the narrow phase. @return true if some were
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
    queue.copy(larger.view().data(), front.view().data(), needed.front * sizeof(std::uint64_t));
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
