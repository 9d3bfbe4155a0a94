// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/solid_distance.h"

#include "dismantle/bvh/obb_tree.h"
#include "dismantle/math/vec3f.h"
#include "dismantle/narrowphase/distance_triangle_triangle.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dismantle {

namespace {

/// Rounding of positions, relative to coordinates.
constexpr double kPositionRounding = 1e-14;
/// Capacity reserved for the pairs of nodes that wait at the same time.
constexpr std::size_t kUsualDepth = 128;

/// A pair of nodes and a lower bound of the distance of their triangles [mm].
struct NodePair {
  std::uint32_t a = 0, b = 0;
  double bound = 0;
};

/// The half edges of a box, rotated into another frame.
struct HalfEdges {
  Vec3 along[3];
};

HalfEdges half_edges(const Obb& box, const Mat3& rotation) {
  return {{rotation * (box.half[0] * to_double(box.axis[0])), rotation * (box.half[1] * to_double(box.axis[1])),
           rotation * (box.half[2] * to_double(box.third_axis()))}};
}

/// Squared distance from `box` to the box that encloses another one along the axes of `box`, apart from the rounding of
/// the axes.
/// @param offset from the centre of `box` to that of the other
double squared_gap(const Obb& box, const Vec3& offset, const HalfEdges& other) {
  const Vec3 axes[3] = {to_double(box.axis[0]), to_double(box.axis[1]), to_double(box.third_axis())};
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    double reach = box.half[i];
    for (const Vec3& edge : other.along) reach += std::abs(dot(axes[i], edge));
    const double gap = std::max(0.0, std::abs(dot(axes[i], offset)) - reach);
    sum += gap * gap;
  }
  return sum;
}

/// Branch and bound for the nearest triangles of two trees.
class DistanceSearch {
 public:
  DistanceSearch(const PlacedSolid& a, const PlacedSolid& b)
      : a_(a),
        b_(b),
        a_from_b_(about_origins(inverse(a.world_from_assembled) * b.world_from_assembled)),
        b_from_a_(inverse(a_from_b_)),
        position_rounding_(kPositionRounding *
                           (max_abs(a.world_from_assembled.translation) + max_abs(a.solid->tree.origin) +
                            max_abs(b.world_from_assembled.translation) + max_abs(b.solid->tree.origin))) {}

  NodePair pair(std::uint32_t a, std::uint32_t b) const {
    const ObbNode &node_a = nodes_a()[a], &node_b = nodes_b()[b];
    const Vec3 center_a = to_double(node_a.box.center), center_b = to_double(node_b.box.center);
    const double squared =
        std::max(squared_gap(node_a.box, a_from_b_ * center_b - center_a, half_edges(node_b.box, a_from_b_.rotation)),
                 squared_gap(node_b.box, b_from_a_ * center_a - center_b, half_edges(node_a.box, b_from_a_.rotation)));
    const double rounding =
        kObbAxisRounding * (static_cast<double>(node_a.radius) + static_cast<double>(node_b.radius));
    return {a, b, std::max(0.0, std::sqrt(squared) * (1 - kObbAxisRounding) - rounding - position_rounding_)};
  }

  SolidDistance nearest(double limit) const {
    SolidDistance best;
    std::vector<NodePair> open;
    open.reserve(kUsualDepth);
    open.push_back(pair(0, 0));
    while (!open.empty()) {
      const NodePair now = open.back();
      open.pop_back();
      if (now.bound >= limit) continue;
      if (nodes_a()[now.a].leaf() && nodes_b()[now.b].leaf()) {
        try_faces(nodes_a()[now.a].child, nodes_b()[now.b].child, limit, best);
        continue;
      }
      auto [near, far] = halves(now);
      if (far.bound < near.bound) std::swap(near, far);
      if (far.bound < limit) open.push_back(far);
      open.push_back(near);
    }
    return best;
  }

 private:
  const std::vector<ObbNode>& nodes_a() const { return a_.solid->tree.nodes; }
  const std::vector<ObbNode>& nodes_b() const { return b_.solid->tree.nodes; }

  RigidTransform about_origins(RigidTransform a_from_b) const {
    a_from_b.translation = a_from_b * b_.solid->tree.origin - a_.solid->tree.origin;
    return a_from_b;
  }

  /// Splits the larger node.
  std::pair<NodePair, NodePair> halves(const NodePair& whole) const {
    const ObbNode &a = nodes_a()[whole.a], &b = nodes_b()[whole.b];
    if (a.size >= b.size) return {pair(a.child, whole.b), pair(a.child + 1, whole.b)};
    return {pair(whole.a, b.child), pair(whole.a, b.child + 1)};
  }

  static Triangle placed(const PlacedSolid& placed, std::uint32_t face) {
    const Triangle own = placed.solid->triangle(face);
    const RigidTransform& t = placed.world_from_assembled;
    return {{t * own[0], t * own[1], t * own[2]}};
  }

  void try_faces(std::uint32_t a, std::uint32_t b, double& limit, SolidDistance& best) const {
    const TriangleDistance found = distance_triangle_triangle(placed(a_, a), placed(b_, b));
    if (!(found.distance < limit)) return;
    limit = found.distance;
    best = {found.distance, FaceId(a), FaceId(b), found.point_a, found.point_b};
  }

  const PlacedSolid &a_, &b_;
  RigidTransform a_from_b_, b_from_a_;  // about the trees' origins
  double position_rounding_;
};

}  // namespace

double bounds_distance(const PlacedSolid& a, const PlacedSolid& b) {
  return DistanceSearch(a, b).pair(0, 0).bound;
}

SolidDistance solid_distance(const PlacedSolid& a, const PlacedSolid& b, double limit) {
  return DistanceSearch(a, b).nearest(limit);
}

}  // namespace dismantle
