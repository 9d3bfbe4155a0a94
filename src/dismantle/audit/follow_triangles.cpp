// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/follow_triangles.h"

#include <algorithm>
#include <cmath>

namespace dismantle::audit {

struct MovingTriangle {
  Triangle now;
  Vec3 velocity[3];
  double acceleration[3];
  double speed = 0;  // largest of its points

  MovingTriangle(const RelativeMotion& motion, const Triangle& at_s) : now(at_s) {
    for (int i = 0; i < 3; ++i) {
      velocity[i] = motion.velocity(now[i]);
      acceleration[i] = motion.acceleration(velocity[i]);
      speed = std::max(speed, length(velocity[i]));
    }
  }

  /// A lower bound of corner i's projection on `axis` during the next `duration`; the bound is concave in time.
  double lowest_projection(int i, Vec3 axis, double duration) const {
    const double at_start = dot(axis, now[i]);
    const double at_end = at_start + duration * dot(axis, velocity[i]) - 0.5 * acceleration[i] * duration * duration;
    return std::min(at_start, at_end);
  }

  /// The time, `horizon` at most, during which no corner's projection on `axis` falls below `floor`.
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

namespace {

/// Merges the crossings of each vertex and segment into one, from the earliest to the latest time.
void merge(std::vector<CrossingVertex>& crossings) {
  std::sort(crossings.begin(), crossings.end(), [](const CrossingVertex& p, const CrossingVertex& q) {
    return p.vertex != q.vertex ? p.vertex < q.vertex : p.segment < q.segment;
  });
  std::size_t count = 0;
  for (const CrossingVertex& crossing : crossings) {
    CrossingVertex* last = count > 0 ? &crossings[count - 1] : nullptr;
    if (last != nullptr && last->vertex == crossing.vertex && last->segment == crossing.segment) {
      last->from = std::min(last->from, crossing.from);
      last->to = std::max(last->to, crossing.to);
    } else {
      crossings[count++] = crossing;
    }
  }
  crossings.resize(count);
}

/// True if a point may touch a stationary triangle within `duration`, by the triangle's plane and the planes through
/// its edges perpendicular to it.
bool may_touch(const Triangle& t, Vec3 normal, Vec3 point, Vec3 velocity, double acceleration, double duration,
               double rounding) {
  const auto beyond = [&](Vec3 out, Vec3 from) {
    const double height = dot(out, point - from);
    const double at_end = height + duration * dot(out, velocity) - 0.5 * acceleration * duration * duration;
    return height > rounding && at_end > rounding;
  };
  if (beyond(normal, t[0]) || beyond(-normal, t[0])) return false;
  for (int k = 0; k < 3; ++k)
    if (beyond(unit_cross(t[(k + 1) % 3] - t[k], normal), t[k])) return false;
  return true;
}

}  // namespace

TriangleFollower::TriangleFollower(const PairSweep& pair)
    : pair_(pair), may_enter_{pair.b->closed(), pair.a->closed()} {}

TriangleFindings TriangleFollower::take() {
  for (std::vector<CrossingVertex>& crossings : findings_.crossing) merge(crossings);
  return std::move(findings_);
}

Vec3 TriangleFollower::follow(const ScrewStretch& stretch, std::uint32_t face_a, std::uint32_t face_b, Vec3 axis) {
  const std::uint32_t segment = stretch.segment;
  const RelativeMotion& motion = pair_.motions[segment];
  const double end = stretch.to;
  const Triangle a = pair_.a->triangle(face_a);
  const Triangle b = pair_.b->triangle(face_b);
  for (double s = stretch.from;;) {
    const RigidTransform a_from_b = s == stretch.from ? stretch.a_from_b : motion.at(s);
    const MovingTriangle moving(motion, transformed(a_from_b, b));
    const PairCertificate found = certificate(a, moving, end - s, axis);
    if (found.axis.gap < -limit()) {
      findings_.breach.add(segment, s, -found.axis.gap);
      end_ = findings_.breach.segment + 1;
      mark_all(segment, face_a, face_b);
      return found.axis.axis;
    }
    axis = found.axis.axis;
    const double min_step = moving.speed > 0 ? pair_.resolution / moving.speed : 1;
    const double step = std::min(end - s, std::max(found.time, min_step));
    mark_crossing({segment, s, s + step, a_from_b}, face_a, face_b, a, moving, axis);
    s += step;
    if (!(s < end)) return axis;
  }
}

PairCertificate TriangleFollower::certificate(const Triangle& a, const MovingTriangle& moving, double horizon,
                                              Vec3 first) {
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
  PairCertificate best;
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
  return best.time >= 0 ? best : PairCertificate{widest, 0};
}

void TriangleFollower::mark_crossing(const ScrewStretch& stretch, std::uint32_t face_a, std::uint32_t face_b,
                                     const Triangle& a, const MovingTriangle& moving, Vec3 axis) {
  const RelativeMotion& motion = pair_.motions[stretch.segment];
  const double duration = stretch.to - stretch.from;
  const double top_a = highest(a, axis);
  double lowest_b = 1e300;
  bool below[3];
  for (int i = 0; i < 3; ++i) {
    const double low = moving.lowest_projection(i, axis, duration);
    lowest_b = std::min(lowest_b, low);
    below[i] = low <= top_a + pair_.rounding;
  }
  if (lowest_b > top_a + pair_.rounding) return;
  const Vec3 normal_a = unit_normal(a), normal_b = unit_normal(moving.now);
  for (int i = 0; i < 3; ++i) {
    if (below[i] &&
        may_touch(a, normal_a, moving.now[i], moving.velocity[i], moving.acceleration[i], duration, pair_.rounding))
      mark(1, pair_.b->face(face_b).v[i], stretch);
    if (dot(axis, a[i]) < lowest_b - pair_.rounding) continue;
    const Vec3 velocity = -motion.velocity(a[i]);  // relative to b
    if (may_touch(moving.now, normal_b, a[i], velocity, motion.acceleration(velocity), duration, pair_.rounding))
      mark(0, pair_.a->face(face_a).v[i], stretch);
  }
}

void TriangleFollower::mark_all(std::uint32_t segment, std::uint32_t face_a, std::uint32_t face_b) {
  for (int i = 0; i < 3; ++i) {
    mark(0, pair_.a->face(face_a).v[i], {segment, 0, 1, {}});
    mark(1, pair_.b->face(face_b).v[i], {segment, 0, 1, {}});
  }
}

void TriangleFollower::mark(int side, std::uint32_t vertex, const ScrewStretch& when) {
  if (!may_enter_[side]) return;
  std::vector<CrossingVertex>& crossings = findings_.crossing[side];
  crossings.push_back({vertex, when.segment, when.from, when.to});
  if (crossings.size() < capacity_[side]) return;
  merge(crossings);
  capacity_[side] = std::max(capacity_[side], 2 * crossings.size());
}

}  // namespace dismantle::audit
