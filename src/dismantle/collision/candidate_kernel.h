// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/collision/narrow_phase_kernel.h"

namespace dismantle {

/// The nodes of a Bvh as a thread of a candidate sees them: what is in hand goes its way, all else stands.
struct CandidateScene {
  BvhView tree;
  Span<const BvhComponent> ranges;
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

/// Extents along one axis that change linearly, and those that stand: when they begin and end to overlap.
struct OverlapTimes {
  double begin = 0, end = 1;

  /// How much nearer extents are taken than they are, of all sizes that go into a distance: rounding is less than a
  /// thousandth of it.
  static constexpr double kRounding = 0x1p-40;

  /// Narrows the times to those at which [a_lower, a_upper] + s way meets [b_lower, b_upper].
  DISMANTLE_HOST_DEVICE void meet(double a_lower, double a_upper, double way, double b_lower, double b_upper) {
    const double size = absolute(a_lower) + absolute(a_upper) + absolute(b_lower) + absolute(b_upper) + absolute(way);
    const double slack = kRounding * size;
    narrow(b_lower - a_upper - slack, way);
    narrow(a_lower - b_upper - slack, -way);
  }

 private:
  DISMANTLE_HOST_DEVICE static double absolute(double x) { return x < 0 ? -x : x; }
  /// A gap that closes at speed `way`: it is closed from gap / way on, or until then.
  DISMANTLE_HOST_DEVICE void narrow(double gap, double way) {
    if (way > 0) {
      if (gap > begin * way) begin = gap / way;
    } else if (way < 0) {
      if (gap > end * way) end = gap / way;
    } else if (gap > 0) {
      begin = 2;
    }
  }
};

/// The projections of a point on the axes of Kdop16.
struct KdopProjections {
  double along[Kdop16::kAxisCount];
  DISMANTLE_HOST_DEVICE explicit KdopProjections(Vec3 p)
      : along{p.x, p.y, p.z, p.x + p.y, p.x + p.z, p.y + p.z, p.x - p.y, p.x - p.z} {}
};

/// A way straight on, by `way` [mm], from the start.
class StraightPiece {
 public:
  DISMANTLE_HOST_DEVICE StraightPiece(const CandidateScene&, Vec3 way) : way_(way), along_(way) {}

  DISMANTLE_HOST_DEVICE OverlapTimes times(const CandidateScene& scene, NodeIndex moving, NodeIndex fixed) const {
    const Kdop16& a = scene.bounds[moving];
    const Kdop16& b = scene.bounds[fixed];
    OverlapTimes times;
    for (int k = 0; k < Kdop16::kAxisCount; ++k)
      times.meet(a.lower[k], a.upper[k], along_.along[k], b.lower[k], b.upper[k]);
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

  DISMANTLE_HOST_DEVICE OverlapTimes times(const CandidateScene& scene, NodeIndex moving, NodeIndex fixed) const {
    const Kdop16& b = scene.bounds[fixed];
    const Turned at_start(from_start_, scene.bounds[moving]), at_end(from_end_, scene.bounds[moving]);
    OverlapTimes times;
    for (int k = 0; k < Kdop16::kAxisCount; ++k) {
      const double a0 = at_start.center.along[k] - at_start.reach(k), a1 = at_start.center.along[k] + at_start.reach(k);
      const double e0 = at_end.center.along[k] - at_end.reach(k), e1 = at_end.center.along[k] + at_end.reach(k);
      times.meet(a0 < e0 ? a0 : e0, a1 > e1 ? a1 : e1, 0, b.lower[k], b.upper[k]);
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
      open({moving, root}, begin_of({moving, root}));
      while (open_count_ > 0) {
        const Open next = open_[--open_count_];
        if (next.begin <= found_.toi) expand(next.pair);
      }
    }
    return found_;
  }

 private:
  struct Open {
    NodePair pair;
    double begin;
  };

  /// When the pair may first meet; after the end where it does not, or later than is worth knowing.
  DISMANTLE_HOST_DEVICE double begin_of(NodePair p) const {
    if (excluded(p)) return 2;
    const OverlapTimes times = piece_.times(scene_, p.a, p.b);
    return times.begin <= times.end && times.begin <= found_.toi ? times.begin : 2;
  }
  /// Puts the pair where it is looked at next; triangles are tested at once.
  DISMANTLE_HOST_DEVICE void open(NodePair p, double begin) {
    if (begin > found_.toi) return;
    if (scene_.tree.is_leaf(p.a) && scene_.tree.is_leaf(p.b)) {
      test(p);
    } else {
      open_[open_count_++] = {p, begin};
    }
  }

  DISMANTLE_HOST_DEVICE void expand(NodePair p) {
    const NodePairChildren next = expanded(scene_.tree, scene_.bounds, p);  // two: no node meets itself
    const double begin[2] = {begin_of(next.pair[0]), begin_of(next.pair[1])};
    const int later = begin[0] < begin[1] ? 1 : 0;
    open(next.pair[later], begin[later]);
    open(next.pair[1 - later], begin[1 - later]);
  }

  /// True of what is in hand itself, and of pairs that are free all the way.
  DISMANTLE_HOST_DEVICE bool excluded(NodePair p) const {
    if (scene_.tree.is_top(p.b)) return false;
    const std::uint32_t moving = scene_.tree.component_of[p.a], fixed = scene_.tree.component_of[p.b];
    if (p.b != scene_.ranges[fixed].root) return false;
    return scene_.motion_class[fixed] != 0 || rule(moving, fixed).test == PairTest::Discrete;
  }

  DISMANTLE_HOST_DEVICE PairRule rule(std::uint32_t a, std::uint32_t b) const {
    return a < b ? scene_.rules.find(a, b) : scene_.rules.find(b, a);
  }

  DISMANTLE_HOST_DEVICE void test(NodePair p) {
    const std::uint32_t moving = scene_.tree.component_of[p.a], fixed = scene_.tree.component_of[p.b];
    const double allowed =
        allowed_on_chords(rule(moving, fixed).allowed_penetration, scene_.path_deviation, true, false);
    TriangleMotion standing;
    for (int k = 0; k < 3; ++k) standing.t0[k] = standing.t1[k] = scene_.vertices[scene_.faces[p.b].v[k]];
    const double horizon = found_.toi;
    const CcdResult ccd = ccd_triangle_triangle(part_of(piece_.motion(scene_, p.a), 0, horizon), standing, allowed);
    if (ccd.status == CcdStatus::Free) return;
    const CandidateContact contact{horizon * ccd.toi, pair_key(p.a, p.b)};
    if (contact.toi < found_.toi || contact.key < found_.key) found_ = contact;
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
