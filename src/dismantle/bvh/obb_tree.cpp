// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/obb_tree.h"

#include "dismantle/bvh/obb_fit.h"
#include "dismantle/bvh/surface_moments.h"
#include "dismantle/core/contract.h"
#include "dismantle/geometry/aabb.h"
#include "dismantle/math/mat3.h"
#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace dismantle {

namespace {

/// The faces of a node, as a range of the tree's order.
struct NodeRange {
  std::uint32_t begin, end, node, parent;
  std::uint32_t size() const { return end - begin; }
};

/// Boxes count as at least so thick, relative to their radius.
constexpr float kThin = 1e-3f;

TriangleF local_triangle(const Triangle& local) {
  return {{to_float(local[0]), to_float(local[1]), to_float(local[2])}};
}

Triangle relative_to(Vec3 origin, Span<const Vec3> vertices, const Face& face) {
  return {{vertices[face.v[0]] - origin, vertices[face.v[1]] - origin, vertices[face.v[2]] - origin}};
}

/// Sets a node but for its child.
void set_node(ObbNode& node, const Obb& box, const NodeRange& range) {
  node.box = box;
  node.radius = obb_radius(box);
  node.parent = range.parent;
  const float thin = kThin * node.radius;
  node.size = range.size() == 1 ? -1 : 8 * (box.half.x + thin) * (box.half.y + thin) * (box.half.z + thin);
}

/// Builds ranges of `order_` into nodes. A range of n triangles is split once at each of its n - 1 inner positions, so
/// the children that a split at position m makes are nodes 2m - 1 and 2m: subtrees can be built in any order, side by
/// side.
class Builder {
 public:
  using Range = NodeRange;

  Builder(Span<const Vec3> vertices, Span<const Face> faces, Span<const std::uint8_t> parts, ObbTree& tree)
      : vertices_(vertices),
        faces_(faces),
        parts_(parts),
        tree_(tree),
        order_(faces.size()),
        centroids_(faces.size()),
        normals_(faces.size()),
        moments_(faces.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!parts.empty())
      std::stable_sort(order_.begin(), order_.end(),
                       [parts](std::uint32_t f, std::uint32_t g) { return parts[f] < parts[g]; });
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const Face& face = faces[f];
      const Triangle local = relative_to(tree.origin, vertices, face);
      centroids_[f] = (1.0 / 3) * (local[0] + local[1] + local[2]);
      normals_[f] = normalized(normal_unscaled(local));
      moments_[f] = surface_moments(local);
      tree.triangles.push_back(local_triangle(local));
    }
  }

  /// Builds the node of the range and splits it; false for a leaf.
  bool build(const Range& range, Range (&halves)[2]) {
    ObbNode& node = tree_.nodes[range.node];
    const Span<const std::uint32_t> order(order_.data() + range.begin, range.size());
    set_node(node, obb_fit(vertices_, faces_, order, tree_.origin), range);
    if (range.size() == 1) {
      node.child = order_[range.begin];
      return false;
    }
    const std::uint32_t middle = split(range, node.box);
    node.child = 2 * middle - 1;
    halves[0] = {range.begin, middle, node.child, range.node};
    halves[1] = {middle, range.end, node.child + 1, range.node};
    return true;
  }

 private:
  /// A cut of a range: triangles of which `of` (centroids or normals) is less than `border` along `axis` come
  /// first.
  struct Cut {
    const std::vector<Vec3>* of = nullptr;
    Vec3 axis;
    double border = 0;
    bool before(std::uint32_t f) const { return dot(axis, (*of)[f]) < border; }
  };

  /// Partitions the range by the cut whose halves are thinnest; if none makes them much thinner, at the mean of the
  /// centroids along the box's longest axis.
  std::uint32_t split(const Range& range, const Obb& box) {
    if (!parts_.empty() && parts_[order_[range.begin]] != parts_[order_[range.end - 1]]) return between_parts(range);
    const Vec3 axes[3] = {to_double(box.axis[0]), to_double(box.axis[1]), to_double(box.third_axis())};
    int longest = 0;
    for (int i = 1; i < 3; ++i)
      if (box.half[i] > box.half[longest]) longest = i;
    Cut best = at_mean(range, axes[longest]);
    if (range.size() > 2) {
      const double floor = kFlat * static_cast<double>(box.half[longest]);
      double best_thickness = kThinner * thickness(range, best, floor);
      for (int i = 0; i < 3; ++i)
        for (const Cut& cut : {at_mean(range, axes[i]), by_normals(range, axes[i])}) {
          const double found = thickness(range, cut, floor);
          if (found >= best_thickness) continue;
          best_thickness = found;
          best = cut;
        }
    }
    return apply(range, best);
  }

  /// The border between two parts that is nearest to the middle of a range, which is sorted by part and has several.
  std::uint32_t between_parts(const Range& range) const {
    const auto part = [this](std::uint32_t i) { return parts_[order_[i]]; };
    std::uint32_t middle = range.begin + range.size() / 2;
    for (std::uint32_t off = 0;; ++off)
      for (const std::uint32_t i : {middle - off, middle + off})
        if (range.begin < i && i < range.end && part(i - 1) != part(i)) return i;
  }

  Cut at_mean(const Range& range, Vec3 axis) const {
    double sum = 0;
    for (std::uint32_t i = range.begin; i < range.end; ++i) sum += dot(axis, centroids_[order_[i]]);
    return {&centroids_, axis, sum / range.size()};
  }

  /// The cut by normals at two thirds between the extremes: separates one end of a shaft from its side and other end.
  Cut by_normals(const Range& range, Vec3 axis) const {
    double low = 1, high = -1;
    for_samples(range, [&](std::uint32_t f) {
      const double x = dot(axis, normals_[f]);
      low = std::min(low, x);
      high = std::max(high, x);
    });
    return {&normals_, axis, low + (high - low) * (2.0 / 3)};
  }

  /// The mean thickness of a cut's two sides, weighted by triangles; infinite if one side is empty.
  /// @param floor sides count as at least so thick [mm]
  double thickness(const Range& range, const Cut& cut, double floor) const {
    SurfaceMoments moments[2];
    std::size_t count[2] = {0, 0};
    for_samples(range, [&](std::uint32_t f) {
      const bool before = cut.before(f);
      moments[before] += moments_[f];
      ++count[before];
    });
    if (count[0] == 0 || count[1] == 0) return std::numeric_limits<double>::infinity();
    double sum = 0;
    for (int k = 0; k < 2; ++k) sum += static_cast<double>(count[k]) * surface_volume(moments[k], floor);
    return sum / static_cast<double>(count[0] + count[1]);
  }

  /// Visits the triangles of a range; of a large one an evenly spaced sample.
  template <class Visit>
  void for_samples(const Range& range, Visit visit) const {
    const std::uint32_t stride = 1 + range.size() / kMaxSamples;
    for (std::uint32_t i = range.begin; i < range.end; i += stride) visit(order_[i]);
  }

  /// Partitions the range by a cut. If one side were nearly empty, it is cut at the median of the centroids instead;
  /// ties are broken by index, so the result is unique. @return the first position of the second half
  std::uint32_t apply(const Range& range, const Cut& cut) {
    const auto begin = order_.begin() + range.begin, end = order_.begin() + range.end;
    auto middle = std::partition(begin, end, [&](std::uint32_t f) { return cut.before(f); });
    const std::ptrdiff_t smaller = std::min(middle - begin, end - middle);
    if (smaller == 0 || (cut.of == &centroids_ && smaller * kMinShare < end - begin)) {
      middle = begin + range.size() / 2;
      std::nth_element(begin, middle, end, [&](std::uint32_t f, std::uint32_t g) {
        const double x = dot(cut.axis, centroids_[f]), y = dot(cut.axis, centroids_[g]);
        return x != y ? x < y : f < g;
      });
    }
    return static_cast<std::uint32_t>(middle - order_.begin());
  }

  /// A cut other than along the longest axis is taken if it makes the halves thinner than this share of that one's.
  static constexpr double kThinner = 0.7;
  /// Boxes thinner than this are flat, relative to the longest half edge.
  static constexpr double kFlat = 1e-4;
  static constexpr std::uint32_t kMaxSamples = 1024;
  static constexpr std::ptrdiff_t kMinShare = 64;

  Span<const Vec3> vertices_;
  Span<const Face> faces_;
  Span<const std::uint8_t> parts_;
  ObbTree& tree_;
  std::vector<std::uint32_t> order_;
  std::vector<Vec3> centroids_, normals_;  // of each face
  std::vector<SurfaceMoments> moments_;
};

/// Fits the boxes of a tree whose splits are known.
class Refitter {
 public:
  Refitter(const ObbTree& like, Span<const Vec3> vertices, Span<const Face> faces, ObbTree& tree)
      : like_(like), vertices_(vertices), faces_(faces), tree_(tree), order_(faces.size()) {
    // Leaves are met in the order of their faces.
    std::size_t met = 0;
    std::vector<std::uint32_t> waiting{0};
    while (!waiting.empty()) {
      const ObbNode& node = like.nodes[waiting.back()];
      waiting.pop_back();
      if (node.leaf()) {
        order_[met++] = node.child;
      } else {
        waiting.insert(waiting.end(), {node.child + 1, node.child});
      }
    }
    for (const Face& face : faces) tree.triangles.push_back(local_triangle(relative_to(tree.origin, vertices, face)));
  }

  /// Fits the node of the range; false for a leaf.
  bool build(const NodeRange& range, NodeRange (&halves)[2]) {
    const ObbNode& like = like_.nodes[range.node];
    ObbNode& node = tree_.nodes[range.node];
    const Span<const std::uint32_t> order(order_.data() + range.begin, range.size());
    set_node(node, obb_fit_along(like.box, vertices_, faces_, order, tree_.origin), range);
    node.child = like.child;
    if (like.leaf()) return false;
    const std::uint32_t middle = (node.child + 1) / 2;
    halves[0] = {range.begin, middle, node.child, range.node};
    halves[1] = {middle, range.end, node.child + 1, range.node};
    return true;
  }

 private:
  const ObbTree& like_;
  Span<const Vec3> vertices_;
  Span<const Face> faces_;
  ObbTree& tree_;
  std::vector<std::uint32_t> order_;
};

/// Ranges at or below this size are built by one task.
constexpr std::uint32_t kTaskSize = 4096;

/// Builds all nodes of a tree. @param builder has build(range, halves), which is false for a leaf
template <class NodeBuilder>
void build_nodes(NodeBuilder& builder, std::uint32_t face_count, const Executor& executor) {
  std::vector<NodeRange> level{{0, face_count, 0, ObbNode::kNone}}, tasks;
  while (!level.empty()) {
    std::vector<NodeRange> large;
    for (const NodeRange& r : level) (r.size() > kTaskSize ? large : tasks).push_back(r);
    std::vector<NodeRange> halves(2 * large.size());
    executor.for_each_heavy(large.size(), [&](std::size_t i) {
      NodeRange two[2];
      builder.build(large[i], two);
      halves[2 * i] = two[0];
      halves[2 * i + 1] = two[1];
    });
    level = std::move(halves);
  }
  executor.for_each_heavy(tasks.size(), [&](std::size_t i) {
    std::vector<NodeRange> waiting{tasks[i]};
    while (!waiting.empty()) {
      const NodeRange range = waiting.back();
      waiting.pop_back();
      NodeRange two[2];
      if (builder.build(range, two)) waiting.insert(waiting.end(), {two[1], two[0]});
    }
  });
}

/// A tree without nodes' contents.
ObbTree empty_tree(Span<const Vec3> vertices, Span<const Face> faces) {
  ObbTree tree;
  Aabb box;
  for (const Vec3& p : vertices) box.extend(p);
  tree.origin = box.center();
  tree.nodes.resize(2 * faces.size() - 1);
  tree.triangles.reserve(faces.size());
  return tree;
}

bool contains(const ObbNode& node, Vec3 local) {
  const Obb& box = node.box;
  const Vec3 u0 = to_double(box.axis[0]), u1 = to_double(box.axis[1]), u2 = to_double(box.third_axis());
  const Vec3 x = local - to_double(box.center);
  const double volume = dot(u0, cross(u1, u2));
  const double slack = 0x1p-50 * (max_abs(local) + max_abs(to_double(box.center)));
  return std::abs(dot(x, cross(u1, u2)) / volume) <= box.half.x + slack &&
         std::abs(dot(x, cross(u2, u0)) / volume) <= box.half.y + slack &&
         std::abs(dot(x, cross(u0, u1)) / volume) <= box.half.z + slack && length(x) <= node.radius + slack;
}

}  // namespace

ObbTree obb_tree_build(Span<const Vec3> vertices, Span<const Face> faces, const Executor& executor,
                       Span<const std::uint8_t> parts) {
  if (faces.empty()) return {};
  ObbTree tree = empty_tree(vertices, faces);
  Builder builder(vertices, faces, parts, tree);
  build_nodes(builder, static_cast<std::uint32_t>(faces.size()), executor);
  return tree;
}

ObbTree obb_tree_refit(const ObbTree& like, Span<const Vec3> vertices, Span<const Face> faces,
                       const Executor& executor) {
  DISMANTLE_EXPECT(like.triangles.size() == faces.size());
  if (faces.empty()) return {};
  ObbTree tree = empty_tree(vertices, faces);
  Refitter refitter(like, vertices, faces, tree);
  build_nodes(refitter, static_cast<std::uint32_t>(faces.size()), executor);
  return tree;
}

const char* obb_tree_fault(const ObbTree& tree, Span<const Vec3> vertices, Span<const Face> faces) {
  if (faces.empty()) return tree.empty() ? "" : "nodes without triangles";
  if (tree.nodes.size() != 2 * faces.size() - 1) return "wrong number of nodes";
  std::vector<bool> seen(faces.size());
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const ObbNode& node = tree.nodes[n];
    if ((node.parent == ObbNode::kNone) != (n == 0)) return "wrong root";
    if (!node.leaf()) {
      for (const std::uint32_t c : {node.child, node.child + 1})
        if (c >= tree.nodes.size() || tree.nodes[c].parent != n) return "a child with a different parent";
      continue;
    }
    if (node.child >= faces.size() || seen[node.child]) return "a triangle in two leaves";
    seen[node.child] = true;
    for (std::uint32_t up = n; up != ObbNode::kNone; up = tree.nodes[up].parent)
      for (const std::uint32_t v : faces[node.child].v)
        if (!contains(tree.nodes[up], vertices[v] - tree.origin)) return "a box that does not contain its triangle";
  }
  return std::find(seen.begin(), seen.end(), false) == seen.end() ? "" : "a triangle in no leaf";
}

}  // namespace dismantle
