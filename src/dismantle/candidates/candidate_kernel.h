// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/streams/narrow_phase_kernel.h"

namespace dismantle {

/// The nodes of a Bvh as a thread of a candidate sees them: what is in hand goes its way, all else stands.
struct CandidateScene {
  BvhView tree;
  Span<const Kdop16> bounds;               ///< Of all nodes at the start [world].
  Span<const Vec3> assembled, vertices;    ///< S_v0, and S_v at the start [mm].
  Span<const Face> faces;                  ///< In leaf order.
  Span<const NodeIndex> moving_roots;      ///< Of the components in hand.
  Span<const std::uint32_t> motion_class;  ///< Of each component: not 0 where it is in hand.
  PairRulesView rules;
  RigidTransform start;       ///< Of the set in hand.
  double path_deviation = 0;  ///< [mm]
};

/// The first contact of a candidate; free where `key` is kFree.
struct CandidateContact {
  static constexpr std::uint64_t kFree = ~std::uint64_t{0};
  double toi = 1;             ///< Fraction of the motion; 1 where it is free.
  std::uint64_t key = kFree;  ///< pair_key of the two leaves.
  friend bool operator==(const CandidateContact&, const CandidateContact&) = default;
};

/// Extents along axes, some of which change linearly and some stand: when all overlap, and from when on they may be
/// deeper in each other than is allowed.
struct OverlapTimes {
  double begin = 0, end = 1;
  double deep = 0;

  /// How much nearer extents are taken than they are, of all sizes that go into a distance: rounding is less than a
  /// thousandth of it.
  static constexpr double kRounding = 0x1p-40;

  /// Looks at an axis: [a_lower, a_upper] + s way against [b_lower, b_upper].
  /// @param allowed depth along it
  DISMANTLE_HOST_DEVICE void meet(const double (&a)[2], double way, const double (&b)[2], double allowed) {
    const double size = absolute(a[0]) + absolute(a[1]) + absolute(b[0]) + absolute(b[1]) + absolute(way);
    const double slack = kRounding * size;
    narrow(b[0] - a[1] - slack, way, allowed);
    narrow(a[0] - b[1] - slack, -way, allowed);
  }

  /// From when on they may be too deep; after the motion where they never are.
  DISMANTLE_HOST_DEVICE double contact() const { return begin <= end ? deep : kNever; }

  static constexpr double kNever = 2;

 private:
  DISMANTLE_HOST_DEVICE static double absolute(double x) { return x < 0 ? -x : x; }
  /// A gap that closes at speed `way`: it is closed from gap / way on, or until then. What goes through a thing without
  /// thickness is never deep in it on both sides, but comes to be so on one: `deep` asks for the side that it came
  /// from.
  DISMANTLE_HOST_DEVICE void narrow(double gap, double way, double allowed) {
    if (way > 0) {
      if (gap > begin * way) begin = gap / way;
      if (gap + allowed > deep * way) deep = (gap + allowed) / way;
    } else {
      if (gap + allowed > 0) deep = kNever;
      if (way < 0 && gap > end * way) end = gap / way;
    }
  }
};

/// The projections of a point on the axes of Kdop16.
struct KdopProjections {
  double along[Kdop16::kAxisCount];
  DISMANTLE_HOST_DEVICE explicit KdopProjections(Vec3 p)
      : along{p.x, p.y, p.z, p.x + p.y, p.x + p.z, p.y + p.z, p.x - p.y, p.x - p.z} {}
};

/// An allowed depth [mm] in the measure of an axis: the diagonal ones are sqrt(2) long, and 1.4 is less.
DISMANTLE_HOST_DEVICE inline double allowed_along(int axis, double allowed) {
  return (axis < 3 ? 1 : 1.4) * kAllowanceRounding * allowed;
}

/// A way straight on, by `way` [mm], from the start.
class StraightPiece {
 public:
  DISMANTLE_HOST_DEVICE StraightPiece(const CandidateScene&, Vec3 way) : way_(way), along_(way) {}

  /// @param allowed depth of two triangles in these nodes [mm]
  DISMANTLE_HOST_DEVICE OverlapTimes times(const CandidateScene& scene, NodePair p, double allowed) const {
    const Kdop16& a = scene.bounds[p.a];
    const Kdop16& b = scene.bounds[p.b];
    OverlapTimes times;
    for (int k = 0; k < Kdop16::kAxisCount; ++k)
      times.meet({a.lower[k], a.upper[k]}, along_.along[k], {b.lower[k], b.upper[k]}, allowed_along(k, allowed));
    return times;
  }
  DISMANTLE_HOST_DEVICE TriangleMotion motion(const CandidateScene& scene, NodeIndex leaf) const {
    TriangleMotion m;
    for (int k = 0; k < 3; ++k) {
      m.t0[k] = scene.vertices[scene.faces[leaf].v[k]];
      m.t1[k] = m.t0[k] + way_;
    }
    return m;
  }

 private:
  Vec3 way_;
  KdopProjections along_;
};

/// A way from one pose to another, the vertices along their chords.
class TurningPiece {
 public:
  /// @param start, end x = start * x_assembled
  DISMANTLE_HOST_DEVICE TurningPiece(const CandidateScene& scene, const RigidTransform& start,
                                     const RigidTransform& end)
      : start_(start), end_(end), from_start_(start * inverse(scene.start)), from_end_(end * inverse(scene.start)) {}

  DISMANTLE_HOST_DEVICE OverlapTimes times(const CandidateScene& scene, NodePair p, double allowed) const {
    const Kdop16& b = scene.bounds[p.b];
    const Turned at_start(from_start_, scene.bounds[p.a]), at_end(from_end_, scene.bounds[p.a]);
    OverlapTimes times;
    for (int k = 0; k < Kdop16::kAxisCount; ++k) {
      const double lower = at_start.lower(k), upper = at_start.upper(k);
      const double lower_end = at_end.lower(k), upper_end = at_end.upper(k);
      times.meet({lower < lower_end ? lower : lower_end, upper > upper_end ? upper : upper_end}, 0,
                 {b.lower[k], b.upper[k]}, allowed_along(k, allowed));
    }
    return times;
  }
  DISMANTLE_HOST_DEVICE TriangleMotion motion(const CandidateScene& scene, NodeIndex leaf) const {
    TriangleMotion m;
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = scene.assembled[scene.faces[leaf].v[k]];
      m.t0[k] = start_ * p;
      m.t1[k] = end_ * p;
    }
    return m;
  }

 private:
  /// The box of bounds, turned: its center, and its half edges as vectors.
  struct Turned {
    KdopProjections center, edge_x, edge_y, edge_z;

    DISMANTLE_HOST_DEVICE Turned(const RigidTransform& by, const Kdop16& box)
        : center(by * Vec3{middle(box, 0), middle(box, 1), middle(box, 2)}),
          edge_x(by.rotation * Vec3{half(box, 0), 0, 0}),
          edge_y(by.rotation * Vec3{0, half(box, 1), 0}),
          edge_z(by.rotation * Vec3{0, 0, half(box, 2)}) {}
    DISMANTLE_HOST_DEVICE double lower(int k) const { return center.along[k] - reach(k); }
    DISMANTLE_HOST_DEVICE double upper(int k) const { return center.along[k] + reach(k); }
    DISMANTLE_HOST_DEVICE double reach(int k) const {
      return absolute(edge_x.along[k]) + absolute(edge_y.along[k]) + absolute(edge_z.along[k]);
    }
    DISMANTLE_HOST_DEVICE static double absolute(double x) { return x < 0 ? -x : x; }
    DISMANTLE_HOST_DEVICE static double middle(const Kdop16& box, int k) {
      return 0.5 * (static_cast<double>(box.lower[k]) + static_cast<double>(box.upper[k]));
    }
    DISMANTLE_HOST_DEVICE static double half(const Kdop16& box, int k) {
      return 0.5 * (static_cast<double>(box.upper[k]) - static_cast<double>(box.lower[k]));
    }
  };

  RigidTransform start_, end_;            // of assembled vertices
  RigidTransform from_start_, from_end_;  // of bounds at the start
};

/// Room for a depth-first traversal: a subtree is at most kBvhHeuristicDepth + 31 levels deep, so is the tree above the
/// components, and each level leaves one pair open.
inline constexpr int kCandidateStackSize = 224;

/// The first contact of what is in hand on one piece of a way: depth-first, what meets first is looked at first, and
/// what meets later than the first contact known is not looked at.
template <class Piece>
class CandidateSearch {
 public:
  DISMANTLE_HOST_DEVICE CandidateSearch(const CandidateScene& scene, const Piece& piece)
      : scene_(scene), piece_(piece) {}

  DISMANTLE_HOST_DEVICE CandidateContact first() {
    const auto root = static_cast<NodeIndex>(scene_.bounds.size() - 1);
    for (const NodeIndex moving : scene_.moving_roots) {
      open({moving, root}, contact_of({moving, root}));
      while (open_count_ > 0) {
        const Open next = open_[--open_count_];
        if (!worth(next.contact)) continue;
        const bool leaves = scene_.tree.is_leaf(next.pair.a) && scene_.tree.is_leaf(next.pair.b);
        leaves ? test(next.pair) : expand(next.pair);
      }
    }
    return found_;
  }

 private:
  struct Open {
    NodePair pair;
    double contact;  ///< Not before this time.
  };

  DISMANTLE_HOST_DEVICE bool worth(double contact) const {
    return found_.key == CandidateContact::kFree ? contact <= 1 : contact < found_.toi;
  }
  DISMANTLE_HOST_DEVICE void open(NodePair p, double contact) {
    if (worth(contact)) open_[open_count_++] = {p, contact};
  }

  DISMANTLE_HOST_DEVICE void expand(NodePair p) {
    const NodePairChildren next = expanded(scene_.tree, scene_.bounds, p);  // two: no node meets itself
    const double contact[2] = {contact_of(next.pair[0]), contact_of(next.pair[1])};
    const int later = contact[0] < contact[1] ? 1 : 0;
    open(next.pair[later], contact[later]);
    open(next.pair[1 - later], contact[1 - later]);
  }

  /// Before which time no two triangles of the nodes are in contact.
  DISMANTLE_HOST_DEVICE double contact_of(NodePair p) const {
    if (scene_.tree.is_top(p.b)) return piece_.times(scene_, p, 0).contact();
    const std::uint32_t fixed = scene_.tree.component_of[p.b];
    if (scene_.motion_class[fixed] != 0) return OverlapTimes::kNever;
    const PairRule rule = rule_of(p);
    if (rule.test == PairTest::Discrete) return OverlapTimes::kNever;
    return piece_.times(scene_, p, allowed_of(rule)).contact();
  }

  /// @pre b is no top node
  DISMANTLE_HOST_DEVICE PairRule rule_of(NodePair p) const {
    const std::uint32_t a = scene_.tree.component_of[p.a], b = scene_.tree.component_of[p.b];
    return a < b ? scene_.rules.find(a, b) : scene_.rules.find(b, a);
  }
  DISMANTLE_HOST_DEVICE double allowed_of(const PairRule& rule) const {
    return allowed_on_chords(rule.allowed_penetration, scene_.path_deviation, true, false);
  }

  DISMANTLE_HOST_DEVICE void test(NodePair p) {
    TriangleMotion standing;
    for (int k = 0; k < 3; ++k) standing.t0[k] = standing.t1[k] = scene_.vertices[scene_.faces[p.b].v[k]];
    const double horizon = found_.toi;
    const CcdResult ccd =
        ccd_triangle_triangle(part_of(piece_.motion(scene_, p.a), 0, horizon), standing, allowed_of(rule_of(p)));
    if (ccd.status == CcdStatus::Contact) found_ = {horizon * ccd.toi, pair_key(p.a, p.b)};
  }

  const CandidateScene& scene_;
  const Piece& piece_;
  CandidateContact found_;
  int open_count_ = 0;
  Open open_[kCandidateStackSize];
};

/// Many ways straight on from one state. Item: a candidate.
struct SweepStraight {
  CandidateScene scene;
  Span<const Vec3> ways;  ///< [mm]
  Span<CandidateContact> found;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    const StraightPiece piece(scene, ways[i]);
    found[i] = CandidateSearch<StraightPiece>(scene, piece).first();
  }
};

/// Many ways along screws from one state, each cut into equal pieces. Item: a candidate.
struct SweepTurning {
  CandidateScene scene;
  Span<const RigidTransform> stations;  ///< Of candidate i: from stations_begin[i] on, its start first.
  Span<const std::uint32_t> stations_begin;
  Span<CandidateContact> found;

  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    const std::uint32_t begin = stations_begin[i], pieces = stations_begin[i + 1] - begin - 1;
    found[i] = {};
    for (std::uint32_t k = 0; k < pieces; ++k) {
      const TurningPiece piece(scene, stations[begin + k], stations[begin + k + 1]);
      const CandidateContact contact = CandidateSearch<TurningPiece>(scene, piece).first();
      if (contact.key == CandidateContact::kFree) continue;
      found[i] = {(k + contact.toi) / pieces, contact.key};
      return;
    }
  }
};

}  // namespace dismantle
