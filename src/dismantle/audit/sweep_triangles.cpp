// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/sweep_triangles.h"

#include "dismantle/audit/follow_triangles.h"
#include "dismantle/audit/interval_tree.h"

#include <algorithm>

namespace dismantle::audit {

namespace {

/// Descends two trees of boxes and a tree of intervals, and follows the triangle pairs that may meet.
class TriangleSweep {
 public:
  TriangleSweep(const PairSweep& pair, const std::vector<MotionSpan>& spans)
      : pair_(pair), times_(pair, spans), follower_(pair) {}

  TriangleFindings run() {
    visit(0, 0, 0);
    return follower_.take();
  }

 private:
  /// The interval is split before the boxes where a box moves further than this many times the size of the larger one.
  static constexpr double kSplitTime = 0.5;

  bool is_active(const Interval& time) const { return follower_.is_active(time.first, time.count); }

  /// The second largest half size, which determines how many other boxes a long thin box is near to.
  static double width(const BoxNode& node) {
    const Vec3 h = node.half;
    return std::max(std::min(h.x, h.y), std::min(std::max(h.x, h.y), h.z));
  }

  void visit(std::uint32_t i, std::uint32_t a, std::uint32_t b) {
    const Interval& time = times_[i];
    if (!is_active(time)) return;
    const BoxNode& node_a = pair_.a->node(a);
    const BoxNode& node_b = pair_.b->node(b);
    if (time.clearance(node_a, node_b) > pair_.rounding) return;
    if (times_.can_split(i) && time.reach(node_b) > kSplitTime * std::max(width(node_a), width(node_b))) {
      for (const std::uint32_t half : times_.halves(i)) visit(half, a, b);
    } else if (node_a.leaf() && node_b.leaf()) {
      visit_leaves(i, node_a, node_b, {});
    } else if (node_b.leaf() || (!node_a.leaf() && node_a.radius >= node_b.radius)) {
      visit(i, a + 1, b);
      visit(i, node_a.right, b);
    } else {
      visit(i, a, b + 1);
      visit(i, a, node_b.right);
    }
  }

  /// @param axis an axis to try first; zero for none
  /// @return the last certified axis
  Vec3 visit_leaves(std::uint32_t i, const BoxNode& leaf_a, const BoxNode& leaf_b, Vec3 axis) {
    const Interval& time = times_[i];
    if (!is_active(time)) return axis;
    if (time.one_segment()) {
      const ScrewStretch stretch{time.first, time.s, time.s + time.duration, time.a_from_b};
      return follower_.follow(stretch, leaf_a.face, leaf_b.face, axis);
    }

    const Triangle a = pair_.a->triangle(leaf_a.face);
    const Triangle b = transformed(time.a_from_b, pair_.b->triangle(leaf_b.face));
    const double needed = time.reach(leaf_b) + pair_.rounding;
    const AxisGap widest = axis == Vec3{} ? widest_gap(a, b, needed) : wider_gap(a, b, axis);
    if (widest.gap > needed) return widest.axis;
    axis = widest.axis;
    for (const std::uint32_t half : times_.halves(i)) {
      if (times_[half].clearance(leaf_a, leaf_b) > pair_.rounding) continue;
      axis = visit_leaves(half, leaf_a, leaf_b, axis);
    }
    return axis;
  }

  const PairSweep& pair_;
  IntervalTree times_;
  TriangleFollower follower_;
};

}  // namespace

void Breach::add(std::uint32_t other_segment, double other_s, double other_depth) {
  if (depth == 0 || other_segment < segment) {
    *this = {other_segment, other_s, other_depth};
  } else if (other_segment == segment) {
    s = std::min(s, other_s);
    depth = std::max(depth, other_depth);
  }
}

void Breach::add(const Breach& other) {
  if (other.depth > 0) add(other.segment, other.s, other.depth);
}

TriangleFindings sweep_triangles(const PairSweep& pair, const std::vector<MotionSpan>& spans) {
  if (pair.a->empty() || pair.b->empty()) return {};
  return TriangleSweep(pair, spans).run();
}

bool surfaces_apart(const AuditBody& a, const AuditBody& b, const RigidTransform& a_from_b, double margin) {
  if (a.empty() || b.empty()) return true;
  const Interval time = interval_of({a_from_b, Screw{}});
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stack{{0, 0}};
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    const BoxNode& node_a = a.node(i);
    const BoxNode& node_b = b.node(j);
    if (time.clearance(node_a, node_b) > margin) continue;
    if (node_a.leaf() && node_b.leaf()) {
      const Triangle other = transformed(a_from_b, b.triangle(node_b.face));
      if (widest_gap(a.triangle(node_a.face), other, margin).gap <= margin) return false;
    } else if (node_b.leaf() || (!node_a.leaf() && node_a.radius >= node_b.radius)) {
      stack.push_back({i + 1, j});
      stack.push_back({node_a.right, j});
    } else {
      stack.push_back({i, j + 1});
      stack.push_back({i, node_b.right});
    }
  }
  return true;
}

}  // namespace dismantle::audit
