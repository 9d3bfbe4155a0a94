// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/motion/helical_motion.h"

#include <algorithm>
#include <cmath>

namespace dismantle::audit {

namespace {

/// Smallest angle of a run; trees of its own do not pay for less [rad].
constexpr double kMinTurn = 2;

double largest_change(const Mat3& m, const Mat3& n) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += dot(m.row[i] - n.row[i], m.row[i] - n.row[i]);
  return std::sqrt(sum);
}

/// The motion without `deviation` and `angles`: the mean of the run's twists; nothing where it turns too little.
std::optional<HelicalMotion> mean_motion(const PairMotion& pair, const SegmentRun& run) {
  Vec3 velocity, turn;
  double angle = 0;
  for (std::uint32_t k = run.first; k < run.first + run.count; ++k) {
    const Screw& screw = pair.motions[k].screw;
    velocity += screw.velocity;
    turn += screw.angle * screw.axis;
    angle += screw.angle;
  }
  HelicalMotion motion;
  motion.run = run;
  if (!(angle >= kMinTurn && length(turn) > 0.5 * angle)) return std::nullopt;
  const Vec3 axis = normalized(turn);
  velocity = velocity / length(turn);
  motion.origin = cross(axis, velocity);
  motion.pitch = dot(axis, velocity);
  const Vec3 other = std::fabs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = normalized(cross(axis, other));
  motion.frame = {{across, cross(axis, across), axis}};
  return motion;
}

}  // namespace

std::optional<HelicalMotion> helical_motion(const PairMotion& pair, const SegmentRun& run, double flat) {
  const RelativeMotion& first = pair.motions[run.first];
  const std::optional<HelicalMotion> mean = mean_motion(pair, run);
  if (!mean) return std::nullopt;
  HelicalMotion motion = *mean;
  const Vec3 axis = motion.frame.row[2];
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
  if (climb < flat) {
    motion.deviation += climb;
    motion.pitch = 0;
  }
  return motion;
}

}  // namespace dismantle::audit
