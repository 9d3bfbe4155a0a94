// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/exec/executor.h"
#include "dismantle/geometry/obb.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// Bounds how far a box's axes are off unit length and right angles, and its float coordinates off doubles: relative to
/// the lengths that are computed with them, and to the box's radius.
inline constexpr double kObbAxisRounding = 2e-6;

/// A node of an ObbTree: one cache line.
struct ObbNode {
  static constexpr std::uint32_t kNone = 0xffffffffu;

  Obb box;           ///< About the tree's origin [mm].
  float radius = 0;  ///< Every point of the box is at most this far from its center [mm].
  /// The room that the box takes, a flat one being as thick as a thousandth of its radius [mm^3]: of two nodes the
  /// larger one is split first. Negative for a leaf.
  float size = -1;
  std::uint32_t child = 0;       ///< The first child, the second comes right behind it; for a leaf its face.
  std::uint32_t parent = kNone;  ///< kNone for the root.

  DISMANTLE_HOST_DEVICE bool leaf() const { return size < 0; }
};

/// The directions of a node's outward normals: every unit w with w.axis >= ahead has a cosine of at least kMinAhead
/// with each of them.
struct NormalCone {
  static constexpr double kMinAhead = 0.3;
  /// What `ahead` is where no direction has.
  static constexpr float kNever = 2;

  Vec3f axis;
  float ahead = kNever;
};

/// The corners of a face about the tree's origin, rounded [mm].
struct TriangleF {
  Vec3f corner[3];
};

/// A static tree of oriented boxes over one component's triangles, one triangle a leaf (Gottschalk, Lin, Manocha 1996).
/// Node 0 is the root; siblings are neighbours (2k - 1, 2k), k being the place between theirs in an order of the faces
/// in which those of every node are together. Every node's box contains its triangles as they are in double, about
/// `origin`: certain, despite float32.
struct ObbTree {
  Vec3 origin;  ///< [mm, the mesh's frame]
  std::vector<ObbNode> nodes;
  std::vector<NormalCone> cones;     ///< Of each node.
  std::vector<TriangleF> triangles;  ///< Of each face.

  bool empty() const { return nodes.empty(); }
};

/// A node and all below it.
struct ObbSubtree {
  std::uint32_t node = 0;
  std::uint32_t begin = 0, end = 0;  ///< The places of its faces in the tree's order.

  static ObbSubtree whole(const ObbTree& tree) { return {0, 0, static_cast<std::uint32_t>(tree.triangles.size())}; }
  bool holds(std::uint32_t other) const {
    const std::uint32_t place = (other + 1) / 2;
    return other == node || (begin < place && place < end);
  }
  /// The one below the first child (k = 0) or the second (k = 1). @pre the node is no leaf
  ObbSubtree half(const ObbTree& tree, std::uint32_t k) const {
    const std::uint32_t child = tree.nodes[node].child, place = (child + 1) / 2;
    return k == 0 ? ObbSubtree{child, begin, place} : ObbSubtree{child + 1, place, end};
  }
};

/// Builds the tree of a mesh. The same tree for every executor.
/// @param parts of each face, or empty: faces of different parts are parted first, whatever room that takes
ObbTree obb_tree_build(Span<const Vec3> vertices, Span<const Face> faces, const Executor& executor,
                       Span<const std::uint8_t> parts = {});

/// What is wrong with a tree over these triangles, in words for a test; empty where nothing is.
const char* obb_tree_fault(const ObbTree& tree, Span<const Vec3> vertices, Span<const Face> faces);

}  // namespace dismantle
