// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/motion/helical_motion.h"

#include <algorithm>
#include <cmath>

namespace dismantle::audit {

namespace {

/// A run that turns less is not worth trees of its own [rad].
constexpr double kMinTurn = 2;
/// Segments that turn less say too little about their axis [rad].
constexpr double kMinAngle = 1e-3;

/// What climbs by less than this part of the resolution in all does not climb.
constexpr double kFlatPart = 1e-3;

/// The velocity field of a body in a segment, for each radian.
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

/// The motion without `astray`, by the run's first segment.
HelicalMotion motion_of(const RelativeMotion& first, const SegmentRun& run) {
  HelicalMotion motion;
  motion.run = run;
  const Vec3 axis = first.screw.axis;
  const Vec3 velocity = first.screw.velocity / first.screw.angle;
  motion.origin = cross(axis, velocity);
  motion.pitch = dot(axis, velocity);
  const Vec3 least = std::fabs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = normalized(cross(axis, least));
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
    double turned = screw.angle;
    for (; next < count && segments[next].screw.angle >= kMinAngle; ++next) {
      const Twist other(segments[next].screw, center);
      const double off = length(other.velocity - twist.velocity) + length(other.axis - twist.axis) * body.node(0).reach;
      if (off > tolerance) break;
      turned += segments[next].screw.angle;
    }
    if (turned >= kMinTurn) runs.push_back({first, next - first});
  }
  return runs;
}

std::optional<HelicalMotion> helical_motion(const PairSweep& pair, const SegmentRun& run) {
  const RelativeMotion& first = pair.motions[run.first];
  HelicalMotion motion = motion_of(first, run);
  const Vec3 axis = first.screw.axis;
  const double reach = pair.b->node(0).reach;
  motion.turned.push_back(0);
  for (std::uint32_t k = run.first; k < run.first + run.count; ++k) {
    const RelativeMotion& actual = pair.motions[k];
    const double angle = motion.turned.back();
    const Mat3 turn = mat3_from_quat(quat_about(axis, angle));
    const Vec3 center = motion.origin + turn * (first.start.translation - motion.origin) + angle * motion.pitch * axis;
    const double at_start = length(actual.start.translation - center) +
                            largest_change(actual.start.rotation, turn * first.start.rotation) * reach;
    // Two motions part at the rate by which their twists differ where the one is.
    const Vec3 velocity = actual.velocity(actual.start.translation);
    const Vec3 wanted =
        actual.screw.angle * (motion.pitch * axis + cross(axis, actual.start.translation - motion.origin));
    const double turning = actual.screw.angle * length(actual.screw.axis - axis);
    const double on_the_way = length(velocity - wanted) + turning * (reach + length(velocity));
    motion.astray = std::max(motion.astray, at_start + on_the_way);
    motion.turned.push_back(angle + actual.screw.angle);
  }
  const double climb = std::fabs(motion.pitch) * motion.turned.back();
  if (climb < kFlatPart * pair.resolution) {
    motion.astray += climb;
    motion.pitch = 0;
  }
  if (!(motion.astray <= pair.resolution)) return std::nullopt;
  return motion;
}

}  // namespace dismantle::audit
