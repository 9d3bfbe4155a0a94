// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/candidates/near_lists.h"
#include "dismantle/streams/narrow_phase_kernel.h"

namespace dismantle {

/// The state from which candidate motions start: the moving set moves, all other components are stationary.
struct CandidateScene {
  BvhView tree;                            ///< The hierarchy of all components.
  Span<const Kdop16> bounds;               ///< At the start, shape [node_count] [mm, world].
  Span<const Vec3> assembled;              ///< S_v0 [mm, assembled].
  Span<const Vec3> vertices;               ///< S_v at the start [mm, world].
  Span<const Face> faces;                  ///< In leaf order.
  Span<const NodeIndex> moving_roots;      ///< Roots of the components of the moving set.
  Span<const std::uint32_t> motion_class;  ///< Not 0 for the moving set, shape [component_count].
  GhostTriangles ghosts;                   ///< At the start, twice.
  PairRulesView rules;                     ///< The rules of the component pairs.
  RigidTransform start;                    ///< Of the moving set: world from assembled.

  /// The rule of two nodes. @pre the second is no top node
  DISMANTLE_HOST_DEVICE PairRule rule_of(NodePair p) const {
    const std::uint32_t a = tree.component_of[p.a], b = tree.component_of[p.b];
    return a < b ? rules.find(a, b) : rules.find(b, a);
  }
  /// False if what is below the second node never stops the first: it moves along, or the pair may overlap.
  DISMANTLE_HOST_DEVICE bool can_meet(NodePair p) const {
    if (tree.is_top(p.b)) return true;
    if (motion_class[tree.component_of[p.b]] != 0) return false;
    const PairTest test = rule_of(p).test;
    return test != PairTest::Discrete && test != PairTest::None;
  }
  /// The triangle of the second leaf and its ghost, which stay. @param rule of the pair
  DISMANTLE_HOST_DEVICE GhostMotion fixed_leaf(NodePair p, const PairRule& rule) const {
    const std::uint32_t a = tree.component_of[p.a], b = tree.component_of[p.b];
    const Face& face = faces[p.b];
    GhostMotion fixed{{}, ghosts.motion(face, b, a < b ? rule.ghost_b : rule.ghost_a)};
    for (int k = 0; k < 3; ++k) fixed.triangle.t0[k] = fixed.triangle.t1[k] = vertices[face.v[k]];
    return fixed;
  }
  /// The triangle of the first leaf and its ghost on a piece of a motion. @param rule of the pair
  template <class Piece>
  DISMANTLE_HOST_DEVICE GhostMotion moving_leaf(NodePair p, const PairRule& rule, const Piece& piece) const {
    const std::uint32_t a = tree.component_of[p.a], b = tree.component_of[p.b];
    return {piece.motion(*this, p.a), piece.ghost(*this, p.a, a < b ? rule.ghost_a : rule.ghost_b)};
  }
};

/// The first contact of a candidate; free if `key` is kFree.
struct CandidateContact {
  static constexpr std::uint64_t kFree = ~std::uint64_t{0};  ///< Key without contact.

  double toi = 1;             ///< Fraction of the motion; 1 if it is free.
  std::uint64_t key = kFree;  ///< pair_key of the two leaves.
  friend bool operator==(const CandidateContact&, const CandidateContact&) = default;
};

/// The time interval in which two objects overlap along all axes, while one of them translates, and the time from which
/// on they may overlap by more than allowed.
struct OverlapTimes {
  double begin = 0;  ///< Start of the overlap.
  double end = 1;    ///< End of the overlap.
  double deep = 0;   ///< Time from which on the overlap may be deeper than allowed; kNever if it never is.

  /// Enlargement of extents, relative to all values that enter a distance; rounding is less than a thousandth of it.
  static constexpr double kRounding = 0x1p-40;
  /// A time after the motion.
  static constexpr double kNever = 2;

  /// Takes an axis into account: extents a + s * displacement, s in [0, 1], and b.
  /// @param a, b lower and upper bound
  /// @param allowed depth along the axis
  DISMANTLE_HOST_DEVICE void meet(const double (&a)[2], double displacement, const double (&b)[2], double allowed) {
    const double size = absolute(a[0]) + absolute(a[1]) + absolute(b[0]) + absolute(b[1]) + absolute(displacement);
    const double slack = kRounding * size;
    narrow(b[0] - a[1] - slack, displacement, allowed);
    narrow(a[0] - b[1] - slack, -displacement, allowed);
  }

  /// The time from which on they may be too deep; kNever if they never are.
  DISMANTLE_HOST_DEVICE double contact() const { return begin <= end ? deep : kNever; }

 private:
  DISMANTLE_HOST_DEVICE static double absolute(double x) { return x < 0 ? -x : x; }
  /// Takes a gap into account that closes at `speed`: it is closed from the time gap / speed on, or until then. An
  /// object that passes through a sheet without thickness is never deep in it from both sides, but from the side that
  /// it comes from: this side decides `deep`.
  DISMANTLE_HOST_DEVICE void narrow(double gap, double speed, double allowed) {
    if (speed > 0) {
      if (gap > begin * speed) begin = gap / speed;
      if (gap + allowed > deep * speed) deep = (gap + allowed) / speed;
    } else {
      if (gap + allowed > 0) deep = kNever;
      if (speed < 0 && gap > end * speed) end = gap / speed;
    }
  }
};

/// The projections of a point on the axes of Kdop16.
struct KdopProjections {
  double along[Kdop16::kAxisCount];  ///< Not normalised: diagonal axes are sqrt(2) long.
  /// Projects `p`.
  DISMANTLE_HOST_DEVICE explicit KdopProjections(Vec3 p)
      : along{p.x, p.y, p.z, p.x + p.y, p.x + p.z, p.y + p.z, p.x - p.y, p.x - p.z} {}
};

/// Lower bound of an allowed depth [mm] in the units of an axis: the diagonal ones are sqrt(2) long, and 1.4 is less.
DISMANTLE_HOST_DEVICE inline double allowed_along(int axis, double allowed) {
  return (axis < 3 ? 1 : 1.4) * kPlayRounding * allowed;
}

/// A translation of the moving set from the start.
class StraightPiece {
 public:
  /// @param displacement [mm, world]
  DISMANTLE_HOST_DEVICE StraightPiece(const CandidateScene&, Vec3 displacement)
      : displacement_(displacement), along_(displacement) {}

  /// Overlap of the bounds of a pair of nodes, the first of the moving set.
  /// @param allowed overlap of these bounds [mm]
  DISMANTLE_HOST_DEVICE OverlapTimes times(const CandidateScene& scene, NodePair p, double allowed) const {
    const Kdop16& a = scene.bounds[p.a];
    const Kdop16& b = scene.bounds[p.b];
    OverlapTimes times;
    for (int k = 0; k < Kdop16::kAxisCount; ++k)
      times.meet({a.lower[k], a.upper[k]}, along_.along[k], {b.lower[k], b.upper[k]}, allowed_along(k, allowed));
    return times;
  }
  /// The motion of the triangle of a leaf of the moving set [mm, world].
  DISMANTLE_HOST_DEVICE TriangleMotion motion(const CandidateScene& scene, NodeIndex leaf) const {
    TriangleMotion m;
    for (int k = 0; k < 3; ++k) {
      m.t0[k] = scene.vertices[scene.faces[leaf].v[k]];
      m.t1[k] = m.t0[k] + displacement_;
    }
    return m;
  }
  /// The motion of its ghost. @param slot PairRule::ghost_a or ghost_b
  DISMANTLE_HOST_DEVICE TriangleMotion ghost(const CandidateScene& scene, NodeIndex leaf, std::uint32_t slot) const {
    TriangleMotion m;
    for (int k = 0; k < 3; ++k) {
      m.t0[k] = scene.start * scene.ghosts.displaced[scene.faces[leaf].v[k] + slot];
      m.t1[k] = m.t0[k] + displacement_;
    }
    return m;
  }

 private:
  Vec3 displacement_;
  KdopProjections along_;
};

/// A piece of a screw of the moving set, with the vertices along chords.
class TurningPiece {
 public:
  /// @param start, end world from assembled
  DISMANTLE_HOST_DEVICE TurningPiece(const CandidateScene& scene, const RigidTransform& start,
                                     const RigidTransform& end)
      : start_(start), end_(end), from_start_(start * inverse(scene.start)), from_end_(end * inverse(scene.start)) {}

  /// As StraightPiece::times(), by the bounds of both ends: overlap for the whole piece, or not at all.
  DISMANTLE_HOST_DEVICE OverlapTimes times(const CandidateScene& scene, NodePair p, double allowed) const {
    const Kdop16& b = scene.bounds[p.b];
    const RotatedBox at_start(from_start_, scene.bounds[p.a]), at_end(from_end_, scene.bounds[p.a]);
    OverlapTimes times;
    for (int k = 0; k < Kdop16::kAxisCount; ++k) {
      const double lower = at_start.lower(k), upper = at_start.upper(k);
      const double lower_end = at_end.lower(k), upper_end = at_end.upper(k);
      times.meet({lower < lower_end ? lower : lower_end, upper > upper_end ? upper : upper_end}, 0,
                 {b.lower[k], b.upper[k]}, allowed_along(k, allowed));
    }
    return times;
  }
  /// Lower bound of the time at which near leaves meet; kNever if they do not on this piece.
  DISMANTLE_HOST_DEVICE double contact_of_near(const CandidateScene& scene, const NearLeaves& near,
                                               const NearLevels& levels) const {
    const GhostMotion moving = scene.moving_leaf(near.leaves, scene.rule_of(near.leaves), *this);
    const double first = apart_until(moving.ghost, near.of_moving_ghost, levels.of_moving_ghost);
    const double second = apart_until(moving.triangle, near.of_fixed_ghost, levels.of_fixed_ghost);
    return first < second ? first : second;
  }
  /// As StraightPiece::motion().
  DISMANTLE_HOST_DEVICE TriangleMotion motion(const CandidateScene& scene, NodeIndex leaf) const {
    return moved(scene.assembled, scene.faces[leaf], 0);
  }
  /// As StraightPiece::ghost().
  DISMANTLE_HOST_DEVICE TriangleMotion ghost(const CandidateScene& scene, NodeIndex leaf, std::uint32_t slot) const {
    return moved(scene.ghosts.displaced, scene.faces[leaf], slot);
  }

 private:
  /// The time until which one of two axes certainly separates. Between its values at both ends, a gap is never smaller
  /// than by linear interpolation.
  DISMANTLE_HOST_DEVICE static double apart_until(const TriangleMotion& motion, const AxisPair& pair,
                                                  const double (&levels)[2]) {
    double until = 0;
    for (int k = 0; k < 2 && pair.axes[k].separates(); ++k) {
      const double at_start = pair.axes[k].gap_left(motion.t0, levels[k]),
                   at_end = pair.axes[k].gap_left(motion.t1, levels[k]);
      if (!(at_start > 0)) continue;
      if (at_end > 0) return OverlapTimes::kNever;
      const double closed = (1 - kClosingRounding) * at_start / (at_start - at_end);
      until = closed > until ? closed : until;
    }
    return until;
  }
  static constexpr double kClosingRounding = 1e-12;  // more than that of a quotient

  DISMANTLE_HOST_DEVICE TriangleMotion moved(Span<const Vec3> assembled, const Face& face, std::uint32_t slot) const {
    TriangleMotion m;
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = assembled[face.v[k] + slot];
      m.t0[k] = start_ * p;
      m.t1[k] = end_ * p;
    }
    return m;
  }

  /// A rotated box: its center, and its half edges as vectors.
  struct RotatedBox {
    KdopProjections center, edge_x, edge_y, edge_z;

    DISMANTLE_HOST_DEVICE RotatedBox(const RigidTransform& by, const Kdop16& box)
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

/// Size of the stack of the depth-first traversal: a subtree has at most kBvhHeuristicDepth + 31 levels, as does the
/// tree above the components, and each level leaves one pair on the stack.
inline constexpr int kCandidateStackSize = 224;

/// How far the points of the moving set are from where they were at the state of the lists, at most, on a piece of a
/// screw [mm].
struct Reach {
  double start;  ///< At its start.
  double end;    ///< At its end; in between, by linear interpolation.

  /// Until a time of the piece.
  DISMANTLE_HOST_DEVICE double until(double time) const {
    if (time >= 1) return start > end ? start : end;
    const double there = (1 - time) * start + time * end;
    return start > there ? start : there;
  }
};

/// The search for the first contact of the moving set on one piece of a motion: depth-first, the pair that may meet
/// earlier first, without pairs that meet later than the first known contact.
/// @tparam Piece StraightPiece or TurningPiece
template <class Piece>
class CandidateSearch {
 public:
  /// @param scene, piece must outlive this
  DISMANTLE_HOST_DEVICE CandidateSearch(const CandidateScene& scene, const Piece& piece)
      : scene_(scene), piece_(piece) {}

  /// Goes on from a contact that is known, or from the end of the piece.
  DISMANTLE_HOST_DEVICE CandidateSearch(const CandidateScene& scene, const Piece& piece, const CandidateContact& known)
      : scene_(scene), piece_(piece), found_(known) {}

  /// The contact of two leaves, if it is before the known one; otherwise that.
  DISMANTLE_HOST_DEVICE CandidateContact first_of(NodePair leaves) {
    test(leaves);
    return found_;
  }
  /// The first contact of what is not listed as near, on a translation, if it is before the known one; otherwise that.
  /// To be called once.
  DISMANTLE_HOST_DEVICE CandidateContact first_of_far(const NearLists& lists, const StraightMotion& motion) {
    for (const FarNodes& far : lists.far) {
      if (far.gap > found_.toi * motion.distance) break;
      open(far.nodes, contact_of(far.nodes));
      for (NodePair leaves; next_leaves(leaves);) test(leaves);
    }
    return found_;
  }
  /// The first contact of near pairs. To be called once.
  DISMANTLE_HOST_DEVICE CandidateContact first_of_near(const NearLists& lists, const Reach& reach) {
    // First the pair that may meet first; most often that is the contact, and no other is earlier.
    std::size_t soonest = 0;
    double least = OverlapTimes::kNever;
    for (std::size_t i = 0; i < lists.near.size() && lists.near[i].gap <= reach.until(least); ++i) {
      const double contact = piece_.contact_of_near(scene_, lists.near[i], lists.levels[i]);
      if (!(contact < least)) continue;
      least = contact;
      soonest = i;
    }
    if (!worth(least)) return found_;
    test(lists.near[soonest].leaves);
    // On a GPU, the threads of a warp look for their next pairs together, and then test them together.
    for (std::size_t i = 0; worth(least) && next_near(lists, reach, i); ++i)
      if (i != soonest) test(lists.near[i].leaves);
    return found_;
  }
  /// The first contact, as a fraction of the piece. To be called once.
  DISMANTLE_HOST_DEVICE CandidateContact first() {
    const auto root = static_cast<NodeIndex>(scene_.bounds.size() - 1);
    for (const NodeIndex moving : scene_.moving_roots) {
      open({moving, root}, contact_of({moving, root}));
      for (NodePair leaves; next_leaves(leaves);) test(leaves);
    }
    return found_;
  }

 private:
  /// A contact counts as a millionth earlier. Where flat faces meet, hundreds of pairs do at the same time; then none
  /// of them is earlier than the first that is tested.
  static constexpr double kEarlier = 1 - 1e-6;

  struct Open {
    NodePair pair;
    double contact;  ///< Lower bound of the time of contact.
  };

  /// Goes on to the next near pair that may meet before the first known contact. @return false if there is none
  DISMANTLE_HOST_DEVICE bool next_near(const NearLists& lists, const Reach& reach, std::size_t& i) const {
    const double limit = reach.until(found_.toi);
    for (; i < lists.near.size() && lists.near[i].gap <= limit; ++i)
      if (worth(piece_.contact_of_near(scene_, lists.near[i], lists.levels[i]))) return true;
    return false;
  }
  /// Expands pairs until the next one is of two leaves. On a GPU, the threads of a warp do this together, and then test
  /// their leaves together (Aila and Laine 2009). @return false if there is none
  DISMANTLE_HOST_DEVICE bool next_leaves(NodePair& leaves) {
    while (open_count_ > 0) {
      const Open next = open_[--open_count_];
      if (!worth(next.contact)) continue;
      if (scene_.tree.is_leaf(next.pair.a) && scene_.tree.is_leaf(next.pair.b)) {
        leaves = next.pair;
        return true;
      }
      expand(next.pair);
    }
    return false;
  }

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

  /// Lower bound of the time at which triangles of the nodes are in contact.
  DISMANTLE_HOST_DEVICE double contact_of(NodePair p) const {
    if (!scene_.can_meet(p)) return OverlapTimes::kNever;
    const bool leaves = scene_.tree.is_leaf(p.a) && scene_.tree.is_leaf(p.b);
    return piece_.times(scene_, p, leaves ? scene_.ghosts.play(p) : 0).contact();
  }

  DISMANTLE_HOST_DEVICE void test(NodePair p) {
    const PairRule rule = scene_.rule_of(p);
    const double horizon = found_.toi;
    GhostMotion moving = scene_.moving_leaf(p, rule, piece_);
    moving = {part_of(moving.triangle, 0, horizon), part_of(moving.ghost, 0, horizon)};
    const CcdResult ccd = ccd_with_ghosts(moving, scene_.fixed_leaf(p, rule));
    if (ccd.status == CcdStatus::Contact) found_ = {kEarlier * horizon * ccd.toi, pair_key(p.a, p.b)};
  }

  const CandidateScene& scene_;
  const Piece& piece_;
  CandidateContact found_;
  int open_count_ = 0;
  Open open_[kCandidateStackSize];
};

}  // namespace dismantle
