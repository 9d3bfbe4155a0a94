// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/bvh_build.h"

#include <algorithm>
#include <numeric>

namespace dismantle {

namespace {

constexpr int kBinCount = 16;
constexpr std::uint32_t kMedianLeafCount = 4;          // ranges up to this size are halved: bins would be mostly empty
constexpr std::uint32_t kSerialLeafCount = 16 * 1024;  // subtrees up to this size are one task

/// A subtree to build: positions [begin, end) of the order become leaves [leaf_base + begin, ...); its inner nodes are
/// the end - begin - 1 ones from `inner_begin` on, the last of them its root.
struct Subtree {
  std::uint32_t begin = 0, end = 0;
  NodeIndex inner_begin = 0;
  int depth = 0;
  std::uint32_t size() const { return end - begin; }
};

struct Bin {
  Aabb box;
  std::uint32_t count = 0;
};

double half_area(const Aabb& box) {
  if (box.empty()) return 0;
  const Vec3 s = box.size();
  return s.x * s.y + s.y * s.z + s.z * s.x;
}

struct Split {
  double cost = std::numeric_limits<double>::infinity();
  int axis = -1;
  int bin = 0;  // bins below this one go left
};

/// The bin that a coordinate falls into.
int bin_of(double value, double low, double scale) {
  const int bin = static_cast<int>((value - low) * scale);
  return std::clamp(bin, 0, kBinCount - 1);
}

/// Builds trees over primitives that are given by their boxes.
class Builder {
 public:
  Builder(Span<const Aabb> boxes, Span<std::uint32_t> order, Span<BvhChildren> children, NodeIndex leaf_count)
      : boxes_(boxes), order_(order), children_(children), leaf_count_(leaf_count) {}

  /// Splits the subtree once and links its root; the two halves are still to build. @pre size() >= 2
  std::pair<Subtree, Subtree> split(const Subtree& s) const {
    const std::uint32_t middle = partition(s);
    Subtree left{s.begin, middle, s.inner_begin, s.depth + 1};
    Subtree right{middle, s.end, s.inner_begin + left.size() - 1, s.depth + 1};
    const NodeIndex root = s.inner_begin + s.size() - 2;
    children_[root - leaf_count_] = {root_of(left), root_of(right)};
    return {left, right};
  }

  void build(const Subtree& whole) const {
    std::vector<Subtree> open{whole};
    while (!open.empty()) {
      const Subtree s = open.back();
      open.pop_back();
      if (s.size() < 2) continue;
      const auto [left, right] = split(s);
      open.push_back(left);
      open.push_back(right);
    }
  }

  static NodeIndex root_of(const Subtree& s) { return s.size() == 1 ? s.begin : s.inner_begin + s.size() - 2; }

 private:
  Vec3 center(std::uint32_t position) const { return boxes_[order_[position]].center(); }

  std::uint32_t partition(const Subtree& s) const {
    Aabb centers;
    for (std::uint32_t i = s.begin; i < s.end; ++i) centers.extend(center(i));
    const Vec3 size = centers.size();
    if (s.size() > kMedianLeafCount && s.depth < kBvhHeuristicDepth) {
      const Split best = best_split(s, centers);
      if (best.axis >= 0) return partition_at(s, centers, best);
    }
    const int longest = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const std::uint32_t middle = s.begin + s.size() / 2;
    std::nth_element(order_.begin() + s.begin, order_.begin() + middle, order_.begin() + s.end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double x = boxes_[a].center()[longest], y = boxes_[b].center()[longest];
                       return x != y ? x < y : a < b;
                     });
    return middle;
  }

  Split best_split(const Subtree& s, const Aabb& centers) const {
    Bin bins[3][kBinCount];
    const Vec3 size = centers.size();
    double scale[3];
    for (int axis = 0; axis < 3; ++axis) scale[axis] = size[axis] > 0 ? kBinCount / size[axis] : 0;
    for (std::uint32_t i = s.begin; i < s.end; ++i) {
      const Aabb& box = boxes_[order_[i]];
      const Vec3 c = box.center();
      for (int axis = 0; axis < 3; ++axis) {
        Bin& bin = bins[axis][bin_of(c[axis], centers.lower[axis], scale[axis])];
        bin.box.extend(box);
        ++bin.count;
      }
    }
    Split best;
    for (int axis = 0; axis < 3; ++axis)
      if (scale[axis] > 0) improve(best, bins[axis], axis);
    return best;
  }

  /// Replaces `best` by the cheapest split of these bins if that is cheaper.
  static void improve(Split& best, const Bin (&bins)[kBinCount], int axis) {
    double right_cost[kBinCount];
    Aabb box;
    std::uint32_t count = 0;
    for (int b = kBinCount - 1; b > 0; --b) {
      box.extend(bins[b].box);
      count += bins[b].count;
      right_cost[b] = count > 0 ? half_area(box) * count : -1;
    }
    box = Aabb{};
    count = 0;
    for (int b = 1; b < kBinCount; ++b) {
      box.extend(bins[b - 1].box);
      count += bins[b - 1].count;
      if (count == 0 || right_cost[b] < 0) continue;
      const double cost = half_area(box) * count + right_cost[b];
      if (cost < best.cost) best = {cost, axis, b};
    }
  }

  std::uint32_t partition_at(const Subtree& s, const Aabb& centers, const Split& split) const {
    const double low = centers.lower[split.axis];
    const double scale = kBinCount / centers.size()[split.axis];
    const auto middle = std::partition(order_.begin() + s.begin, order_.begin() + s.end, [&](std::uint32_t primitive) {
      return bin_of(boxes_[primitive].center()[split.axis], low, scale) < split.bin;
    });
    return static_cast<std::uint32_t>(middle - order_.begin());
  }

  Span<const Aabb> boxes_;
  Span<std::uint32_t> order_;
  Span<BvhChildren> children_;
  NodeIndex leaf_count_;
};

/// Builds all component subtrees: large ones are split level by level until their parts are small enough for one task.
void build_components(const Builder& builder, std::vector<Subtree> open, const Executor& executor) {
  while (!open.empty()) {
    std::vector<std::pair<Subtree, Subtree>> halves(open.size());
    executor.for_each_heavy(open.size(), [&](std::size_t i) {
      if (open[i].size() <= kSerialLeafCount) {
        builder.build(open[i]);
      } else {
        halves[i] = builder.split(open[i]);
      }
    });
    std::vector<Subtree> next;
    for (const auto& [left, right] : halves) {
      if (left.size() >= 2) next.push_back(left);
      if (right.size() >= 2) next.push_back(right);
    }
    open = std::move(next);
  }
}

/// Lays out the component ranges: leaves and inner nodes, component after component.
std::vector<BvhComponent> component_ranges(Span<const std::uint32_t> begin, NodeIndex leaf_count) {
  std::vector<BvhComponent> ranges(begin.size() - 1);
  NodeIndex inner = leaf_count;
  for (std::size_t c = 0; c < ranges.size(); ++c) {
    BvhComponent& range = ranges[c];
    range.leaf_begin = begin[c];
    range.leaf_end = begin[c + 1];
    range.inner_begin = inner;
    if (range.leaf_count() > 1) inner += range.leaf_count() - 1;
    range.inner_end = inner;
    if (range.leaf_count() > 0) range.root = range.leaf_count() == 1 ? range.leaf_begin : inner - 1;
  }
  return ranges;
}

/// Builds the tree over the component roots into the inner nodes from top_begin on.
void build_top(Bvh& bvh, Span<const Aabb> triangle_boxes) {
  std::vector<Aabb> boxes;
  std::vector<NodeIndex> roots;
  for (const BvhComponent& c : bvh.components) {
    if (c.leaf_count() == 0) continue;
    Aabb box;
    for (NodeIndex i = c.leaf_begin; i < c.leaf_end; ++i) box.extend(triangle_boxes[i]);
    boxes.push_back(box);
    roots.push_back(c.root);
  }
  if (roots.size() < 2) return;
  const auto count = static_cast<NodeIndex>(roots.size());
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::vector<BvhChildren> top(count - 1);
  // Built as a separate tree with `count` leaves, whose indices are then mapped to those of the hierarchy.
  Builder(boxes, order, top, count).build({0, count, count, 0});
  const auto moved = [&](NodeIndex node) { return node < count ? roots[order[node]] : bvh.top_begin + (node - count); };
  for (NodeIndex i = 0; i < count - 1; ++i)
    bvh.children[bvh.top_begin - bvh.leaf_count() + i] = {moved(top[i].left), moved(top[i].right)};
}

}  // namespace

Bvh bvh_build(const BvhInput& input, const Executor& executor) {
  DISMANTLE_EXPECT(!input.component_begin.empty());
  DISMANTLE_EXPECT(input.triangle_boxes.size() < (std::size_t{1} << 31));
  Bvh bvh;
  const auto leaf_count = static_cast<NodeIndex>(input.triangle_boxes.size());
  bvh.components = component_ranges(input.component_begin, leaf_count);
  if (leaf_count == 0) return bvh;
  bvh.leaf_triangle.resize(leaf_count);
  std::iota(bvh.leaf_triangle.begin(), bvh.leaf_triangle.end(), 0u);
  bvh.children.resize(leaf_count - 1);
  bvh.component_of.assign(2 * std::size_t{leaf_count} - 1, ComponentId::kInvalid);

  const Builder builder(input.triangle_boxes, bvh.leaf_triangle, bvh.children, leaf_count);
  std::vector<Subtree> open;
  bvh.top_begin = leaf_count;
  for (std::uint32_t c = 0; c < bvh.components.size(); ++c) {
    const BvhComponent& range = bvh.components[c];
    std::fill(bvh.component_of.begin() + range.leaf_begin, bvh.component_of.begin() + range.leaf_end, c);
    std::fill(bvh.component_of.begin() + range.inner_begin, bvh.component_of.begin() + range.inner_end, c);
    if (range.leaf_count() > 1) open.push_back({range.leaf_begin, range.leaf_end, range.inner_begin, 0});
    bvh.top_begin = range.inner_end;
  }
  build_components(builder, std::move(open), executor);
  build_top(bvh, input.triangle_boxes);
  return bvh;
}

}  // namespace dismantle
