// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/motion/helical_motion.h"

#include <algorithm>
#include <cmath>

namespace dismantle::audit {

namespace {

/// Smallest angle of a run; trees of its own do not pay for less [rad].
constexpr double kMinTurn = 2;
/// Smallest angle of a segment from which its axis is determined [rad].
constexpr double kMinAngle = 1e-3;

/// An advance along the axis of less than this part of the resolution in all counts as none.
constexpr double kFlatPart = 1e-3;

/// The velocity field of a body in a segment, per radian.
struct Twist {
  Vec3 velocity, axis;

  Twist(const Screw& screw, Vec3 point)
      : velocity((screw.velocity + cross(screw.angle * screw.axis, point - screw.reference)) / screw.angle),
        axis(screw.axis) {}
};

double largest_change(const Mat3& m, const Mat3& n) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += dot(m.row[i] - n.row[i], m.row[i] - n.row[i]);
  return std::sqrt(sum);
}

/// The motion without `deviation` and `angles`, from the run's first segment.
HelicalMotion motion_of(const RelativeMotion& first, const SegmentRun& run) {
  HelicalMotion motion;
  motion.run = run;
  const Vec3 axis = first.screw.axis;
  const Vec3 velocity = first.screw.velocity / first.screw.angle;
  motion.origin = cross(axis, velocity);
  motion.pitch = dot(axis, velocity);
  const Vec3 other = std::fabs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = normalized(cross(axis, other));
  motion.frame = {{across, cross(axis, across), axis}};
  return motion;
}

}  // namespace

std::vector<SegmentRun> helical_runs(const std::vector<MotionSegment>& segments, const AuditBody& body,
                                     double tolerance) {
  std::vector<SegmentRun> runs;
  if (body.empty()) return runs;
  const auto count = static_cast<std::uint32_t>(segments.size());
  for (std::uint32_t first = 0, next = 0; first < count; first = next) {
    next = first + 1;
    const Screw& screw = segments[first].screw;
    if (screw.angle < kMinAngle) continue;
    const Vec3 center = transform_from_pose(segments[first].start) * body.center();
    const Twist twist(screw, center);
    double angle = screw.angle;
    for (; next < count && segments[next].screw.angle >= kMinAngle; ++next) {
      const Twist other(segments[next].screw, center);
      const double off = length(other.velocity - twist.velocity) + length(other.axis - twist.axis) * body.node(0).reach;
      if (off > tolerance) break;
      angle += segments[next].screw.angle;
    }
    if (angle >= kMinTurn) runs.push_back({first, next - first});
  }
  return runs;
}

std::optional<HelicalMotion> helical_motion(const PairSweep& pair, const SegmentRun& run) {
  const RelativeMotion& first = pair.motions[run.first];
  HelicalMotion motion = motion_of(first, run);
  const Vec3 axis = first.screw.axis;
  const double reach = pair.b->node(0).reach;
  motion.angles.push_back(0);
  for (std::uint32_t k = run.first; k < run.first + run.count; ++k) {
    const RelativeMotion& actual = pair.motions[k];
    const double angle = motion.angles.back();
    const Mat3 turn = mat3_from_quat(quat_about(axis, angle));
    const Vec3 center = motion.origin + turn * (first.start.translation - motion.origin) + angle * motion.pitch * axis;
    const double at_start = length(actual.start.translation - center) +
                            largest_change(actual.start.rotation, turn * first.start.rotation) * reach;
    // Two motions diverge at the rate by which their twists differ at the one's position.
    const Vec3 velocity = actual.velocity(actual.start.translation);
    const Vec3 expected =
        actual.screw.angle * (motion.pitch * axis + cross(axis, actual.start.translation - motion.origin));
    const double turning = actual.screw.angle * length(actual.screw.axis - axis);
    const double during = length(velocity - expected) + turning * (reach + length(velocity));
    motion.deviation = std::max(motion.deviation, at_start + during);
    motion.angles.push_back(angle + actual.screw.angle);
  }
  const double climb = std::fabs(motion.pitch) * motion.angles.back();
  if (climb < kFlatPart * pair.resolution) {
    motion.deviation += climb;
    motion.pitch = 0;
  }
  if (!(motion.deviation <= pair.resolution)) return std::nullopt;
  return motion;
}

}  // namespace dismantle::audit
