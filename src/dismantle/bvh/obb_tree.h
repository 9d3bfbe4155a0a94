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
  static constexpr std::uint32_t kNone = 0xffffffffu;  ///< The index of no node.

  Obb box;           ///< About the tree's origin [mm].
  float radius = 0;  ///< Every point of the box is at most this far from its center [mm].
  /// Volume of the box, each side being at least a thousandth of its radius [mm^3]; -1 for a leaf. Of two nodes the
  /// larger one is split first.
  float size = -1;
  std::uint32_t child = 0;       ///< The first child, followed by the second; for a leaf its face.
  std::uint32_t parent = kNone;  ///< kNone for the root.

  /// True for a leaf.
  DISMANTLE_HOST_DEVICE bool leaf() const { return size < 0; }
};

/// A triangle in float32.
struct TriangleF {
  Vec3f corner[3];  ///< About the tree's origin, rounded [mm].
};

/// A static tree of oriented boxes over one component's triangles, one triangle a leaf (Gottschalk, Lin, Manocha 1996).
/// Node 0 is the root. Siblings are nodes 2k - 1 and 2k, k being the position between their faces in an order in which
/// the faces of every node are together. Every node's box certainly contains its triangles as given in double, relative
/// to `origin`, despite float32.
struct ObbTree {
  Vec3 origin;                       ///< That boxes and triangles are relative to [mm, the mesh's frame].
  std::vector<ObbNode> nodes;        ///< Shape [2 face_count - 1].
  std::vector<TriangleF> triangles;  ///< Of each face.

  /// True if there are no faces.
  bool empty() const { return nodes.empty(); }
};

/// A node and all nodes below it.
struct ObbSubtree {
  std::uint32_t node = 0;   ///< Its root.
  std::uint32_t begin = 0;  ///< Position of its first face in the tree's order.
  std::uint32_t end = 0;    ///< One past the position of its last face.

  /// The whole tree.
  static ObbSubtree whole(const ObbTree& tree) { return {0, 0, static_cast<std::uint32_t>(tree.triangles.size())}; }
  /// True if a node of the tree is in the subtree.
  bool holds(std::uint32_t other) const {
    const std::uint32_t split = (other + 1) / 2;
    return other == node || (begin < split && split < end);
  }
  /// The subtree of the first child (k = 0) or the second (k = 1). @pre the node is no leaf
  ObbSubtree half(const ObbTree& tree, std::uint32_t k) const {
    const std::uint32_t child = tree.nodes[node].child, split = (child + 1) / 2;
    return k == 0 ? ObbSubtree{child, begin, split} : ObbSubtree{child + 1, split, end};
  }
};

/// Builds the tree of a mesh. Every executor builds the same one.
/// @param parts part number of each face, or empty: faces of different parts are separated first, whatever the volume
ObbTree obb_tree_build(Span<const Vec3> vertices, Span<const Face> faces, const Executor& executor,
                       Span<const std::uint8_t> parts = {});

/// Builds the tree of the same faces with other positions of their vertices, with the splits and the directions of the
/// boxes of a known tree: for positions that differ little, such as those of a ghost surface. Takes a fraction of the
/// time. Boxes are fitted to the vertices as given, as all are.
/// @param like of the same faces
ObbTree obb_tree_refit(const ObbTree& like, Span<const Vec3> vertices, Span<const Face> faces,
                       const Executor& executor);

/// Checks the structure of a tree and that its boxes contain its triangles; for tests.
/// @return the fault in a few words; empty if there is none
const char* obb_tree_fault(const ObbTree& tree, Span<const Vec3> vertices, Span<const Face> faces);

}  // namespace dismantle
