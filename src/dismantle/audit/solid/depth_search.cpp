// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/depth_search.h"

#include "dismantle/audit/interval_tree.h"
#include "dismantle/audit/solid/piece_search.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace dismantle::audit {

namespace {

/// The search of one side: nodes of the tree of `points` in intervals, each with the nodes of `solid` that may come
/// within the limit of it.
class DepthSearch {
 public:
  DepthSearch(const DepthPair& pair, const std::vector<MotionSpan>& spans, bool of_b, const DepthGoal& goal,
              const std::vector<bool>& done)
      : pair_(pair),
        of_b_(of_b),
        points_(of_b ? *pair.b : *pair.a),
        solid_(of_b ? *pair.a : *pair.b),
        tree_(pair.motion, spans),
        pieces_(solid_, goal, pair.motion.rounding),
        first_segment_(spans.front().first) {
    for (std::uint32_t k = 0; k < spans.front().count; ++k) {
      const RelativeMotion& motion = pair.motion.motions[first_segment_ + k];
      motions_.push_back(of_b ? motion : reversed_roles(motion));
    }
    if (!done.empty()) find_done(0, done);
  }

  DepthFindings run() {
    nodes_.push_back(0);
    visit(0, 0, {0, 1, pieces_.limit(), std::numeric_limits<double>::infinity()});
    DepthFindings found = pieces_.findings();
    found.bound = pieces_.limit();
    found.complete = !pieces_.ended();
    for (DepthSample* sample : {&found.deepest, &found.first}) {
      sample->of_b = of_b_;
      if (sample->depth > 0 && !of_b_)
        sample->point_a = pair_.motion.motions[sample->segment].at(sample->s) * sample->point_a;
    }
    return found;
  }

 private:
  /// Finds the nodes below node i of which all faces are done. @return whether node i is one
  bool find_done(std::uint32_t i, const std::vector<bool>& faces) {
    const BoxNode& node = points_.surface().node(i);
    if (done_.size() <= i) done_.resize(i + 1, false);
    if (node.leaf()) return done_[i] = faces[node.face];
    const bool left = find_done(i + 1, faces), right = find_done(node.right, faces);
    return done_[i] = left && right;
  }

  /// Nodes in `nodes_`, and the distance up to which they are all.
  struct Range {
    std::size_t first = 0, count = 0;
    double reach = 0;
    double size = 0;  ///< Of what they are near to: its radius and its movement.
  };
  /// A list of near nodes is computed again once box and movement have shrunk to this share of what it was made for.
  /// Before that, nearly all of its nodes would stay in it.
  static constexpr double kSmaller = 0.7;

  /// The nodes of `solid` that may come within the limit of a node, not larger than it or leaves.
  Range near_nodes(std::uint32_t interval, const BoxNode& box, double size, const Range& parent) {
    Range near{nodes_.size(), 0, std::min(parent.reach, pieces_.limit()), size};
    const BoxInInterval moving(tree_[interval], box, of_b_);
    stack_.assign(nodes_.begin() + static_cast<std::ptrdiff_t>(parent.first),
                  nodes_.begin() + static_cast<std::ptrdiff_t>(parent.first + parent.count));
    while (!stack_.empty()) {
      const std::uint32_t i = stack_.back();
      stack_.pop_back();
      const BoxNode& node = solid_.surface().node(i);
      if (moving.is_clear_of(node, near.reach)) continue;
      if (node.leaf() || node.radius <= box.radius) {
        nodes_.push_back(i);
      } else {
        stack_.push_back(node.right);
        stack_.push_back(i + 1);
      }
    }
    near.count = nodes_.size() - near.first;
    return near;
  }

  /// True if all of a box certainly stays within the limit of the surface of `solid`. @param size as of Range
  bool near_surface(const BoxNode& box, std::uint32_t interval, double size) {
    const double distance = pieces_.limit() - pair_.motion.rounding - size;
    if (distance <= 0) return false;
    const std::optional<std::uint32_t> face = solid_.surface().face_within(center(interval, box), distance, last_face_);
    if (face) last_face_ = *face;
    return face.has_value();
  }

  /// The centre of a box of `points` at the reference of an interval, in the frame of `solid` [mm].
  Vec3 center(std::uint32_t interval, const BoxNode& box) const {
    const RigidTransform& a_from_b = tree_[interval].a_from_b;
    return of_b_ ? a_from_b * box.center : inverse(a_from_b) * box.center;
  }

  /// True if a box that stays clear of the surface of `solid` during an interval is certainly outside.
  bool outside(std::uint32_t interval, const BoxNode& box, double gap) {
    const double radius = solid_.closed() ? 0 : box.radius + movement(interval, box);
    return solid_.outside_throughout(center(interval, box), radius, gap, last_point_);
  }

  /// Bound of the movement of a box of `points` relative to `solid` in an interval [mm].
  double movement(std::uint32_t interval, const BoxNode& box) const {
    if (of_b_) return tree_[interval].reach(box);
    const Interval& i = tree_[interval];
    BoxNode in_b = box;  // the sphere around it, in the frame of b
    in_b.center = center(interval, box);
    in_b.reach = length(in_b.center) + box.radius;
    return i.reach(in_b);
  }

  void visit(std::uint32_t node, std::uint32_t interval, const Range& parent) {
    if (pieces_.ended() || (!done_.empty() && done_[node])) return;
    const BoxNode& box = points_.surface().node(node);
    const double move = movement(interval, box), size = box.radius + move;
    if (near_surface(box, interval, size)) return;
    const bool in_time =
        tree_.can_split(interval) && (move > box.radius || (box.leaf() && !tree_[interval].one_segment()));
    if (box.leaf() && !in_time) {
      search_face(box, interval, parent);
      return;
    }
    const std::size_t before = nodes_.size();
    const bool anew = parent.count == 0 || size < kSmaller * parent.size;
    const Range near = anew ? near_nodes(interval, box, size, parent) : parent;
    if (near.count > 0 || !outside(interval, box, near.reach)) {
      if (in_time) {
        const std::uint32_t halves[2] = {tree_.halves(interval)[0], tree_.halves(interval)[1]};
        for (const std::uint32_t half : halves) visit(node, half, near);
      } else {
        visit(node + 1, interval, near);
        visit(box.right, interval, near);
      }
    }
    nodes_.resize(before);
  }

  void search_face(const BoxNode& box, std::uint32_t interval, const Range& parent) {
    const Interval& time = tree_[interval];
    TimeSlice slice;
    slice.segment = time.first;
    slice.from = time.s;
    slice.to = time.s + time.duration;
    slice.motion = &motions_[time.first - first_segment_];
    slice.start = slice.motion->at(slice.from);
    slice.end = slice.motion->at(slice.to);
    const Span<const std::uint32_t> nodes(nodes_.data() + parent.first, parent.count);
    pieces_.search(slice, points_.surface().triangle(box.face), {nodes, std::min(parent.reach, pieces_.limit())});
  }

  const DepthPair& pair_;
  bool of_b_;
  const SolidBody& points_;
  const SolidBody& solid_;
  IntervalTree tree_;
  PieceSearch pieces_;
  std::uint32_t first_segment_;
  std::uint32_t last_face_ = 0;
  SolidBody::LastPoint last_point_;
  std::vector<bool> done_;               // by node of `points`; empty for none
  std::vector<RelativeMotion> motions_;  // of `points` in the frame of `solid`
  std::vector<std::uint32_t> nodes_;     // a stack of ranges of nodes of `solid`
  std::vector<std::uint32_t> stack_;
};

}  // namespace

DepthFindings search_depth(const DepthPair& pair, const std::vector<MotionSpan>& spans, bool of_b,
                           const DepthGoal& goal, const std::vector<bool>& done) {
  const SolidBody& solid = of_b ? *pair.a : *pair.b;
  if (!solid.solid() || pair.a->surface().empty() || pair.b->surface().empty()) {
    DepthFindings none;
    none.bound = goal.floor + goal.slack;
    none.complete = true;
    return none;
  }
  return DepthSearch(pair, spans, of_b, goal, done).run();
}

}  // namespace dismantle::audit
