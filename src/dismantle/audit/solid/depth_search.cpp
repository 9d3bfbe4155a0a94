// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/depth_search.h"

#include "dismantle/audit/interval_tree.h"
#include "dismantle/audit/solid/piece_search.h"

#include <algorithm>

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
    visit(0, 0, {0, 1, pieces_.limit()});
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
  };

  double clearance(std::uint32_t interval, const BoxNode& of_points, const BoxNode& of_solid) const {
    return of_b_ ? tree_[interval].clearance(of_solid, of_points) : tree_[interval].clearance(of_points, of_solid);
  }

  /// The nodes of `solid` that may come within the limit of a node, not larger than it unless leaves.
  Range near_nodes(std::uint32_t interval, const BoxNode& box, const Range& parent, bool leaves) {
    Range near{nodes_.size(), 0, std::min(parent.reach, pieces_.limit())};
    stack_.assign(nodes_.begin() + static_cast<std::ptrdiff_t>(parent.first),
                  nodes_.begin() + static_cast<std::ptrdiff_t>(parent.first + parent.count));
    while (!stack_.empty()) {
      const std::uint32_t i = stack_.back();
      stack_.pop_back();
      const BoxNode& node = solid_.surface().node(i);
      if (clearance(interval, box, node) > near.reach) continue;
      if (node.leaf() || (!leaves && node.radius <= box.radius)) {
        nodes_.push_back(i);
      } else {
        stack_.push_back(node.right);
        stack_.push_back(i + 1);
      }
    }
    near.count = nodes_.size() - near.first;
    return near;
  }

  /// True if all of a box certainly stays within the limit of the surface of `solid`.
  bool near_surface(const BoxNode& box, std::uint32_t interval) {
    const double radius = box.radius + movement(interval, box), limit = pieces_.limit() - pair_.motion.rounding;
    if (radius >= limit) return false;
    const SurfacePoint closest = solid_.surface().closest(center(interval, box), last_face_);
    last_face_ = closest.face;
    return closest.distance + radius <= limit;
  }

  /// The centre of a box of `points` at the reference of an interval, in the frame of `solid` [mm].
  Vec3 center(std::uint32_t interval, const BoxNode& box) const {
    const RigidTransform& a_from_b = tree_[interval].a_from_b;
    return of_b_ ? a_from_b * box.center : inverse(a_from_b) * box.center;
  }

  /// True if a box that stays clear of the surface of `solid` during an interval is certainly outside.
  bool outside(std::uint32_t interval, const BoxNode& box, double gap) const {
    return solid_.outside_throughout(center(interval, box), solid_.closed() ? 0 : box.radius + movement(interval, box),
                                     gap);
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
    if (near_surface(box, interval)) return;
    const std::size_t before = nodes_.size();
    const Range near = near_nodes(interval, box, parent, false);
    if (near.count > 0 || !outside(interval, box, near.reach)) divide(node, interval, near);
    nodes_.resize(before);
  }

  void divide(std::uint32_t node, std::uint32_t interval, const Range& near) {
    const BoxNode& box = points_.surface().node(node);
    const bool far_moving = movement(interval, box) > box.radius;
    if (tree_.can_split(interval) && (far_moving || (box.leaf() && !tree_[interval].one_segment()))) {
      const std::uint32_t halves[2] = {tree_.halves(interval)[0], tree_.halves(interval)[1]};
      for (const std::uint32_t half : halves) visit(node, half, near);
    } else if (box.leaf()) {
      search_face(box, interval, near);
    } else {
      visit(node + 1, interval, near);
      visit(box.right, interval, near);
    }
  }

  void search_face(const BoxNode& box, std::uint32_t interval, const Range& near) {
    const Interval& time = tree_[interval];
    const Range leaves = near_nodes(interval, box, near, true);
    faces_.clear();
    for (std::size_t i = 0; i < leaves.count; ++i)
      faces_.push_back(solid_.surface().node(nodes_[leaves.first + i]).face);
    TimeSlice slice;
    slice.segment = time.first;
    slice.from = time.s;
    slice.to = time.s + time.duration;
    slice.motion = &motions_[time.first - first_segment_];
    slice.start = slice.motion->at(slice.from);
    slice.end = slice.motion->at(slice.to);
    pieces_.search(slice, points_.surface().triangle(box.face), {faces_, leaves.reach});
  }

  const DepthPair& pair_;
  bool of_b_;
  const SolidBody& points_;
  const SolidBody& solid_;
  IntervalTree tree_;
  PieceSearch pieces_;
  std::uint32_t first_segment_;
  std::uint32_t last_face_ = 0;
  std::vector<bool> done_;               // by node of `points`; empty for none
  std::vector<RelativeMotion> motions_;  // of `points` in the frame of `solid`
  std::vector<std::uint32_t> nodes_;     // a stack of ranges of nodes of `solid`
  std::vector<std::uint32_t> stack_, faces_;
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
