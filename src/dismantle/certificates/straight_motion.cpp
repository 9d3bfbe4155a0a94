// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/straight_motion.h"

#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace dismantle {

namespace {

/// The search ends undecided after this many pairs of nodes.
constexpr std::size_t kMaxShadows = 20'000;
/// Bound of the rounding of a gap, relative to the coordinates.
constexpr double kRounding = 1e-5;

/// A box to be projected along the displacement.
struct BoxShadow {
  Vec3 center, half[3];  // [mm]
  double radius;

  BoxShadow(const ObbTree& tree, const ObbNode& node)
      : center(tree.origin + to_double(node.box.center)), radius(node.radius) {
    half[0] = node.box.half[0] * to_double(node.box.axis[0]);
    half[1] = node.box.half[1] * to_double(node.box.axis[1]);
    half[2] = node.box.half[2] * to_double(node.box.third_axis());
  }
  BoxShadow(const ObbTree& tree, const ObbNode& node, const RigidTransform& at) : BoxShadow(tree, node) {
    center = at * center;
    for (Vec3& h : half) h = at.rotation * h;
  }
  double reach(Vec3 w) const {
    return std::abs(dot(w, half[0])) + std::abs(dot(w, half[1])) + std::abs(dot(w, half[2]));
  }
};

/// Separates shadows along one displacement.
class Shadows {
 public:
  Shadows(const StraightMover& moving, const SolidTree& fixed)
      : moving_(moving), fixed_(fixed), whole_(length(moving.displacement)), ahead_(moving.displacement / whole_) {}

  bool apart(std::uint32_t a, std::uint32_t b) const {
    const ObbNode &node_a = moving_.solid.tree.nodes[a], &node_b = fixed_.tree.nodes[b];
    if (node_a.leaf() && node_b.leaf() && triangles_apart(node_a.child, node_b.child)) return true;
    const BoxShadow box_a(moving_.solid.tree, node_a, moving_.at), box_b(fixed_.tree, node_b);
    const Vec3 between = box_b.center - box_a.center;
    const double along = dot(ahead_, between), margin = kRounding * (box_a.radius + box_b.radius + length(between));
    const double spheres = box_a.radius + box_b.radius + margin;
    if (length(between - along * ahead_) > spheres) return true;
    const double reach = box_a.reach(ahead_) + box_b.reach(ahead_) + margin;
    if (-along > reach || along - whole_ > reach) return true;
    const auto separates = [&](Vec3 half) {
      const Vec3 w = cross(ahead_, half);
      const double scale = length(w);
      return std::abs(dot(w, between)) > box_a.reach(w) + box_b.reach(w) + margin * scale && scale > 0;
    };
    return std::any_of(box_a.half, box_a.half + 3, separates) || std::any_of(box_b.half, box_b.half + 3, separates);
  }

 private:
  bool triangles_apart(std::uint32_t face_a, std::uint32_t face_b) const {
    Triangle a = moving_.solid.triangle(face_a);
    const Triangle b = fixed_.triangle(face_b);
    for (Vec3& p : a.corner) p = moving_.at * p;
    const double margin = kRounding * (norm_one(a[0]) + norm_one(b[0]));
    const auto span = [](const Triangle& t, Vec3 w) {
      const double x = dot(w, t[0]), y = dot(w, t[1]), z = dot(w, t[2]);
      return std::pair(std::min({x, y, z}), std::max({x, y, z}));
    };
    const auto [from_a, to_a] = span(a, ahead_);
    const auto [from_b, to_b] = span(b, ahead_);
    if (from_a > to_b + margin || from_b - whole_ > to_a + margin) return true;
    const auto separates = [&](Vec3 edge) {
      const Vec3 w = cross(ahead_, edge);
      const auto [min_a, max_a] = span(a, w);
      const auto [min_b, max_b] = span(b, w);
      return std::max(min_a - max_b, min_b - max_a) > margin * length(w);
    };
    for (int k = 0; k < 3; ++k)
      if (separates(a[(k + 1) % 3] - a[k]) || separates(b[(k + 1) % 3] - b[k])) return true;
    return false;
  }

  const StraightMover& moving_;
  const SolidTree& fixed_;
  double whole_;
  Vec3 ahead_;
};

}  // namespace

bool passes_by(const StraightMover& moving, const SolidTree& fixed) {
  const ObbTree& tree = moving.solid.tree;
  if (tree.empty() || fixed.tree.empty()) return true;
  if (!(length(moving.displacement) > 0)) return false;
  const Shadows shadows(moving, fixed);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open{{0, 0}};
  for (std::size_t seen = 0; !open.empty(); ++seen) {
    const auto [a, b] = open.back();
    open.pop_back();
    if (shadows.apart(a, b)) continue;
    const ObbNode &node_a = tree.nodes[a], &node_b = fixed.tree.nodes[b];
    if ((node_a.leaf() && node_b.leaf()) || seen == kMaxShadows) return false;
    const bool split_a = node_a.size >= node_b.size;
    for (std::uint32_t k = 0; k < 2; ++k)
      split_a ? open.emplace_back(node_a.child + k, b) : open.emplace_back(a, node_b.child + k);
  }
  return true;
}

}  // namespace dismantle
