// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/obb_tree.h"

#include "dismantle/bvh/obb_fit.h"
#include "dismantle/geometry/aabb.h"
#include "dismantle/math/mat3.h"

#include <algorithm>
#include <numeric>

namespace dismantle {

namespace {

Vec3 to_double(Vec3f v) {
  return {v.x, v.y, v.z};
}

/// Builds ranges of `order_` into nodes. A range of n triangles is split once at each of its n - 1 inner places, so the
/// children that a split at place m makes are nodes 2m - 1 and 2m: subtrees can be built in any order, side by side.
class Builder {
 public:
  struct Range {
    std::uint32_t begin, end, node, parent;
    std::uint32_t size() const { return end - begin; }
  };

  Builder(Span<const Vec3> vertices, Span<const Face> faces, ObbTree& tree)
      : vertices_(vertices), faces_(faces), tree_(tree), order_(faces.size()), centroids_(faces.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const Face& face = faces[f];
      centroids_[f] = (1.0 / 3) * (vertices[face.v[0]] + vertices[face.v[1]] + vertices[face.v[2]]);
    }
  }

  /// Builds the node of the range and splits it; false for a leaf.
  bool build(const Range& range, Range (&halves)[2]) {
    ObbNode& node = tree_.nodes[range.node];
    const Span<const std::uint32_t> order(order_.data() + range.begin, range.size());
    node.box = obb_fit(vertices_, faces_, order, tree_.origin);
    node.radius = obb_radius(node.box);
    node.parent = range.parent;
    tree_.cones[range.node] = cone_of(order);
    if (range.size() == 1) {
      node.size = -1;
      node.child = order_[range.begin];
      return false;
    }
    node.size = range.parent == ObbNode::kNone ? node.radius : std::min(node.radius, tree_.nodes[range.parent].size);
    const std::uint32_t middle = split(range, node.box);
    node.child = 2 * middle - 1;
    halves[0] = {range.begin, middle, node.child, range.node};
    halves[1] = {middle, range.end, node.child + 1, range.node};
    return true;
  }

  void build_subtree(const Range& root) {
    std::vector<Range> waiting{root};
    while (!waiting.empty()) {
      const Range range = waiting.back();
      waiting.pop_back();
      Range halves[2];
      if (build(range, halves)) waiting.insert(waiting.end(), {halves[1], halves[0]});
    }
  }

 private:
  NormalCone cone_of(Span<const std::uint32_t> order) const {
    const auto normal = [&](std::uint32_t f) {
      const Face& face = faces_[f];
      return normal_unscaled({{vertices_[face.v[0]], vertices_[face.v[1]], vertices_[face.v[2]]}});
    };
    Vec3 sum;
    for (const std::uint32_t f : order) sum += normal(f);
    const Vec3 axis = normalized(sum);
    double cosine = 1;
    for (const std::uint32_t f : order) cosine = std::min(cosine, dot(axis, normalized(normal(f))));
    constexpr double kRounding = 1e-6;
    const auto to_float = [](double x) { return static_cast<float>(x); };
    return {{to_float(axis.x), to_float(axis.y), to_float(axis.z)}, to_float(std::max(-1.0, cosine - kRounding))};
  }

  /// Sorts the range into two along the box's longest axis, at the mean of the centroids, or at the median where that
  /// would leave one side with next to nothing. Ties are broken by index, so the result is unique.
  std::uint32_t split(const Range& range, const Obb& box) {
    int longest = 0;
    for (int i = 1; i < 3; ++i)
      if (box.half[i] > box.half[longest]) longest = i;
    const Vec3 axis = to_double(longest == 2 ? box.third_axis() : box.axis[longest]);
    const auto begin = order_.begin() + range.begin, end = order_.begin() + range.end;
    double mean = 0;
    for (auto i = begin; i != end; ++i) mean += dot(axis, centroids_[*i]);
    mean /= range.size();
    auto middle = std::partition(begin, end, [&](std::uint32_t f) { return dot(axis, centroids_[f]) < mean; });
    if (std::min(middle - begin, end - middle) * kLeastShare < end - begin) {
      middle = begin + range.size() / 2;
      std::nth_element(begin, middle, end, [&](std::uint32_t f, std::uint32_t g) {
        const double x = dot(axis, centroids_[f]), y = dot(axis, centroids_[g]);
        return x != y ? x < y : f < g;
      });
    }
    return static_cast<std::uint32_t>(middle - order_.begin());
  }

  static constexpr std::ptrdiff_t kLeastShare = 64;

  Span<const Vec3> vertices_;
  Span<const Face> faces_;
  ObbTree& tree_;
  std::vector<std::uint32_t> order_;
  std::vector<Vec3> centroids_;
};

/// Ranges at or below this size are built by one task.
constexpr std::uint32_t kTaskSize = 4096;

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

ObbTree obb_tree_build(Span<const Vec3> vertices, Span<const Face> faces, const Executor& executor) {
  ObbTree tree;
  if (faces.empty()) return tree;
  Aabb box;
  for (const Vec3& p : vertices) box.extend(p);
  tree.origin = box.center();
  tree.nodes.resize(2 * faces.size() - 1);
  tree.cones.resize(tree.nodes.size());

  Builder builder(vertices, faces, tree);
  std::vector<Builder::Range> level{{0, static_cast<std::uint32_t>(faces.size()), 0, ObbNode::kNone}}, tasks;
  while (!level.empty()) {
    std::vector<Builder::Range> large;
    for (const Builder::Range& r : level) (r.size() > kTaskSize ? large : tasks).push_back(r);
    std::vector<Builder::Range> halves(2 * large.size());
    executor.for_each_heavy(large.size(), [&](std::size_t i) {
      Builder::Range two[2];
      builder.build(large[i], two);
      halves[2 * i] = two[0];
      halves[2 * i + 1] = two[1];
    });
    level = std::move(halves);
  }
  executor.for_each_heavy(tasks.size(), [&](std::size_t i) { builder.build_subtree(tasks[i]); });
  return tree;
}

const char* obb_tree_fault(const ObbTree& tree, Span<const Vec3> vertices, Span<const Face> faces) {
  if (faces.empty()) return tree.empty() ? "" : "nodes without triangles";
  if (tree.nodes.size() != 2 * faces.size() - 1) return "wrong number of nodes";
  std::vector<bool> seen(faces.size());
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const ObbNode& node = tree.nodes[n];
    if ((node.parent == ObbNode::kNone) != (n == 0)) return "wrong root";
    if (n > 0 && node.size > tree.nodes[node.parent].size) return "a child is larger than its parent";
    if (!node.leaf()) {
      for (const std::uint32_t c : {node.child, node.child + 1})
        if (c >= tree.nodes.size() || tree.nodes[c].parent != n) return "a child that does not know its parent";
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
