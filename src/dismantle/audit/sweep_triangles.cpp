// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/sweep_triangles.h"

#include "dismantle/audit/interval_tree.h"
#include "dismantle/audit/triangle_axes.h"

#include <algorithm>
#include <cmath>

namespace dismantle::audit {

namespace {

/// A triangle of b at an instant, as a sees it, and how its corners move.
struct MovingTriangle {
  Triangle now;
  Vec3 velocity[3];
  double acceleration[3];
  double speed = 0;  // the largest of its points

  MovingTriangle(const RelativeMotion& motion, const Triangle& at_s) : now(at_s) {
    for (int i = 0; i < 3; ++i) {
      velocity[i] = motion.velocity(now[i]);
      acceleration[i] = motion.acceleration(velocity[i]);
      speed = std::max(speed, length(velocity[i]));
    }
  }

  /// A lower bound of corner i's projection on `axis` for all of the next `duration`; the bound is concave in time.
  double lowest_projection(int i, Vec3 axis, double duration) const {
    const double at_start = dot(axis, now[i]);
    const double at_end = at_start + duration * dot(axis, velocity[i]) - 0.5 * acceleration[i] * duration * duration;
    return std::min(at_start, at_end);
  }

  /// How long, `horizon` at most, no corner's projection on `axis` falls below `floor`.
  double certified_time(Vec3 axis, double floor, double horizon) const {
    double time = horizon;
    for (int i = 0; i < 3; ++i) {
      const double above = dot(axis, now[i]) - floor, rate = dot(axis, velocity[i]), a = acceleration[i];
      if (above + rate * time - 0.5 * a * time * time >= 0) continue;
      if (above <= 0) return 0;
      const double root = std::sqrt(rate * rate + 2 * a * above);
      time = rate > 0 ? (rate + root) / a : 2 * above / (root - rate);
    }
    return time;
  }
};

Triangle transformed(const RigidTransform& transform, const Triangle& t) {
  return {{transform * t[0], transform * t[1], transform * t[2]}};
}

/// One direction that allows the pair to go on, and for how long.
struct Certificate {
  AxisGap axis;
  double time = -1;
};

class TriangleSweep {
 public:
  TriangleSweep(const PairSweep& pair, const std::vector<MotionSpan>& spans)
      : pair_(pair), times_(pair, spans), first_segment_(spans[0].first) {
    if (pair.b->closed()) marks_[0].resize(pair.a->vertex_count());
    if (pair.a->closed()) marks_[1].resize(pair.b->vertex_count());
  }

  TriangleFindings run() {
    visit(0, 0, 0);
    for (int side = 0; side < 2; ++side) {
      std::sort(marked_[side].begin(), marked_[side].end());
      for (const std::uint32_t v : marked_[side])
        findings_.crossing[side].push_back({v, first_segment_, marks_[side][v]});
    }
    return std::move(findings_);
  }

 private:
  /// How far a box moves in an interval, in sizes of what is tested, from which on time is split before the boxes.
  static constexpr double kSplitTime = 0.5;

  bool looked_at(const Interval& time) const {
    return time.first + time.count > pair_.first_active && time.first < end_;
  }

  /// The second largest half size: what decides how many others a long thin box is near to.
  static double width(const BoxNode& node) {
    const Vec3 h = node.half;
    return std::max(std::min(h.x, h.y), std::min(std::max(h.x, h.y), h.z));
  }

  void visit(std::uint32_t i, std::uint32_t a, std::uint32_t b) {
    const Interval& time = times_[i];
    if (!looked_at(time)) return;
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

  /// @param axis a direction to try first, zero for none
  /// @return the direction that held last
  Vec3 visit_leaves(std::uint32_t i, const BoxNode& leaf_a, const BoxNode& leaf_b, Vec3 axis) {
    const Interval& time = times_[i];
    if (!looked_at(time)) return axis;
    if (time.one_segment()) return advance(time, leaf_a.face, leaf_b.face, axis);

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

  /// Follows a triangle pair through an interval in one segment. @param axis a direction to try first, zero for none
  /// @return the direction that held last
  Vec3 advance(const Interval& time, std::uint32_t face_a, std::uint32_t face_b, Vec3 axis) {
    const std::uint32_t segment = time.first;
    const RelativeMotion& motion = pair_.motions[segment];
    const double end = time.s + time.duration;
    const Triangle a = pair_.a->triangle(face_a);
    const Triangle b = pair_.b->triangle(face_b);
    for (double s = time.s;;) {
      const RigidTransform a_from_b = s == time.s ? time.a_from_b : motion.at(s);
      const MovingTriangle moving(motion, transformed(a_from_b, b));
      const Certificate found = certificate(a, moving, end - s, axis);
      if (found.axis.gap < -limit()) {
        findings_.breach.add(segment, s, -found.axis.gap);
        end_ = findings_.breach.segment + 1;
        mark_all(segment, face_a, face_b);
        return found.axis.axis;
      }
      axis = found.axis.axis;
      const double least = moving.speed > 0 ? pair_.resolution / moving.speed : 1;
      const double step = std::min(end - s, std::max(found.time, least));
      mark_crossing(segment, face_a, face_b, a, moving, axis, step);
      s += step;
      if (!(s < end)) return axis;
    }
  }

  double limit() const { return pair_.allowed * (1 + 1e-9) + pair_.rounding; }

  /// The direction along which the pair may go on longest; where none may, the one of the exact depth.
  Certificate certificate(const Triangle& a, const MovingTriangle& moving, double horizon, Vec3 first) {
    const double slack = pair_.allowed + pair_.resolution / 2;
    const auto time_of = [&](const AxisGap& axis) {
      return moving.certified_time(axis.axis, highest(a, axis.axis) - slack, horizon);
    };
    if (!(first == Vec3{})) {
      const AxisGap known{first, lowest(moving.now, first) - highest(a, first)};
      if (known.gap >= -findings_.deepest && known.gap >= -limit()) {
        const double time = time_of(known);
        if (time >= horizon) return {known, time};
      }
    }

    ++findings_.samples;
    Certificate best;
    AxisGap widest{{}, -1e300};
    for_each_axis(a, moving.now, [&](Vec3 w) {
      for (const Vec3& axis : {w, -w}) {
        const AxisGap candidate{axis, lowest(moving.now, axis) - highest(a, axis)};
        if (candidate.gap > widest.gap) widest = candidate;
        if (candidate.gap < -limit()) continue;
        const double time = time_of(candidate);
        if (time > best.time || (time == best.time && candidate.gap > best.axis.gap)) best = {candidate, time};
      }
      return best.time < horizon || best.axis.gap <= 0;
    });
    findings_.deepest = std::max(findings_.deepest, -widest.gap);
    return best.time >= 0 ? best : Certificate{widest, 0};
  }

  /// Marks the vertices that may touch the other triangle within the next `duration`.
  void mark_crossing(std::uint32_t segment, std::uint32_t face_a, std::uint32_t face_b, const Triangle& a,
                     const MovingTriangle& moving, Vec3 axis, double duration) {
    const double top_a = highest(a, axis);
    double lowest_b = 1e300;
    for (int i = 0; i < 3; ++i) {
      const double low = moving.lowest_projection(i, axis, duration);
      lowest_b = std::min(lowest_b, low);
      if (low <= top_a + pair_.rounding) mark(1, pair_.b->face(face_b).v[i], segment);
    }
    if (lowest_b > top_a + pair_.rounding) return;
    for (int i = 0; i < 3; ++i)
      if (dot(axis, a[i]) >= lowest_b - pair_.rounding) mark(0, pair_.a->face(face_a).v[i], segment);
  }

  void mark_all(std::uint32_t segment, std::uint32_t face_a, std::uint32_t face_b) {
    for (int i = 0; i < 3; ++i) {
      mark(0, pair_.a->face(face_a).v[i], segment);
      mark(1, pair_.b->face(face_b).v[i], segment);
    }
  }

  void mark(int side, std::uint32_t vertex, std::uint32_t segment) {
    if (marks_[side].empty()) return;
    std::uint32_t& bits = marks_[side][vertex];
    if (bits == 0) marked_[side].push_back(vertex);
    bits |= 1u << (segment - first_segment_);
  }

  const PairSweep& pair_;
  IntervalTree times_;
  const std::uint32_t first_segment_;
  std::uint32_t end_ = 0xffffffffu;  // segments from here on are not looked at
  TriangleFindings findings_;
  std::vector<std::uint32_t> marks_[2];   // by vertex: bit k for segment first_segment_ + k
  std::vector<std::uint32_t> marked_[2];  // vertices with any bit
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
