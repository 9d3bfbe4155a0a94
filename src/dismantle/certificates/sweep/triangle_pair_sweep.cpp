// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/sweep/triangle_pair_sweep.h"

#include "dismantle/core/contract.h"
#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <limits>

namespace dismantle {

namespace {

/// From the frame of one tree to that of the other.
RigidTransform between_trees(const RigidTransform& t, const ObbTree& from, const ObbTree& to) {
  return {t.rotation, t * from.origin - to.origin};
}

SolidView view(const SolidTree& solid) {
  return {solid.vertices.data(), solid.faces.data(), solid.normals.data(), solid.around_begin.data(),
          solid.around.data()};
}

}  // namespace

TrianglePairSweep::TrianglePairSweep(const SolidTree& moving, const SolidTree& fixed, const Pose& start,
                                     const Pose& end, double deviation, const TrianglePairRules& rules)
    : moving_(&moving), fixed_(&fixed), start_pose_(start), end_pose_(end), share_(kArcShare * rules.tolerance) {
  kernel_.moving = view(moving);
  kernel_.fixed = view(fixed);
  kernel_.start = transform_from_pose(start);
  kernel_.end = transform_from_pose(end);
  kernel_.middle = kernel_.start.rotation == kernel_.end.rotation
                       ? kernel_.start.rotation
                       : mat3_from_quat(pose_between(start, end, 0.5).rotation);
  kernel_.deviation = deviation;
  kernel_.allowed = rules.allowed - std::max(share_, deviation);
  kernel_.rules = rules;
  DISMANTLE_EXPECT(rules.allowed >= rules.tolerance && rules.tolerance > 0 && kernel_.allowed > 0);
}

PairMotion TrianglePairSweep::motion() const {
  PairMotion motion;
  motion.t0 = between_trees(kernel_.start, moving_->tree, fixed_->tree);
  motion.t1 = between_trees(kernel_.end, moving_->tree, fixed_->tree);
  motion.middle = kernel_.middle;
  motion.allowed = kernel_.rules.allowed - share_;
  motion.deviation = std::max(0.0, kernel_.deviation - share_);
  motion.kept = share_;
  motion.back = screw_between(inverse(start_pose_), inverse(end_pose_));
  motion.back.reference -= moving_->tree.origin;
  return motion;
}

TrianglePairResult TrianglePairSweep::test(std::uint32_t face_moving, std::uint32_t face_fixed, Vec3 hint,
                                           double horizon) const {
  return kernel_.test(face_moving, face_fixed, hint, horizon);
}

Certificate TrianglePairSweep::certificate(const TrianglePairResult& found, const LinearSweep& sweep) const {
  const std::uint32_t face_moving = found.contact.face_moving, face_fixed = found.contact.face_fixed;
  const TrianglePairRules& rules = kernel_.rules;
  const Vec3 axis = found.contact.axis;
  const bool meet = !(found.gap > 0);
  Certificate c;
  c.axis = to_float(axis);
  c.offset = kNoCertificate;
  if (length_squared(axis) == 0) return c;

  const Triangle moving = moving_->triangle(face_moving), fixed = fixed_->triangle(face_fixed);
  const Vec3 origin = moving_->tree.origin;
  c.hull.kind = NodeHull::kTriangle;
  c.hull.center = to_float(moving[0] - origin);
  for (int i = 0; i < 2; ++i) c.hull.span[i] = to_float(moving[i + 1] - origin - to_double(c.hull.center));
  const Vec3 w = to_double(c.axis);
  double min_fixed = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) min_fixed = std::min(min_fixed, dot(w, fixed[i] - fixed_->tree.origin));
  // An axis that disagrees with the normals may not use the allowance.
  double usable = rules.allowed;
  if (rules.sides == SideRule::Normals) {
    const Mat3 middle{{to_double(sweep.middle[0]), to_double(sweep.middle[1]), to_double(sweep.middle[2])}};
    const Triangle turned{{middle * moving[0], middle * moving[1], middle * moving[2]}};
    const Vec3 own = middle * moving_->normals[face_moving], other = fixed_->normals[face_fixed];
    usable = OutwardNormals{own, other, {}, {}}.allowance(w, rules.allowed);
    // On edge only pairs that need the allowance get it: others may be apart along another axis by then.
    const bool on_edge = !detail::face_on(own, other, w);
    if (on_edge && !meet) usable = std::min(0.0, usable);
    TrianglePairSweepKernel::Around around;
    if (usable < rules.allowed && meet)
      usable = kernel_.normals_of({face_moving, face_fixed, turned, fixed}, middle, around).allowance(w, rules.allowed);
    if (usable > 0 && on_edge) c.hull.kind = NodeHull::kTriangleOnEdge;
  }
  // The front's allowance is subtracted if the axis may not use it.
  const double taken_off = usable < rules.allowed ? static_cast<double>(sweep.allowed) - std::min(0.0, usable) : 0;
  c.offset = -rounded_up(taken_off - min_fixed);
  return c;
}

}  // namespace dismantle
