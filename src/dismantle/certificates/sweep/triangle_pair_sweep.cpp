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
  SolidView view{solid.vertices.data(), solid.faces.data()};
  if (!solid.has_outside) return view;
  view.normals = solid.normals.data();
  view.around_begin = solid.around_begin.data();
  view.around = solid.around.data();
  return view;
}

}  // namespace

TrianglePairSweep::TrianglePairSweep(const SolidTree& moving, const SolidTree& fixed, const Pose& start,
                                     const Pose& end, double deviation, double tolerance,
                                     const AdvancementLimits& limits)
    : moving_(&moving), fixed_(&fixed), start_pose_(start), end_pose_(end), share_(kArcShare * tolerance) {
  kernel_.moving = view(moving);
  kernel_.fixed = view(fixed);
  kernel_.start = transform_from_pose(start);
  kernel_.end = transform_from_pose(end);
  kernel_.middle = kernel_.start.rotation == kernel_.end.rotation
                       ? kernel_.start.rotation
                       : mat3_from_quat(pose_between(start, end, 0.5).rotation);
  kernel_.deviation = deviation;
  kernel_.limits = limits;
  DISMANTLE_EXPECT(tolerance > 0);
  DISMANTLE_EXPECT(deviation <= share_ * (1 + 1e-6));
}

PairMotion TrianglePairSweep::motion() const {
  PairMotion motion;
  motion.t0 = between_trees(kernel_.start, moving_->tree, fixed_->tree);
  motion.t1 = between_trees(kernel_.end, moving_->tree, fixed_->tree);
  motion.middle = kernel_.middle;
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

Certificate TrianglePairSweep::certificate(const TrianglePairResult& found) const {
  const Vec3 axis = found.contact.axis;
  if (length_squared(axis) == 0) return Certificate::none();
  Certificate c;
  c.axis = to_float(axis);
  const Triangle moving = moving_->triangle(found.contact.face_moving),
                 fixed = fixed_->triangle(found.contact.face_fixed);
  const Vec3 origin = moving_->tree.origin;
  c.hull.kind = NodeHull::kTriangle;
  c.hull.center = to_float(moving[0] - origin);
  for (int i = 0; i < 2; ++i) c.hull.span[i] = to_float(moving[i + 1] - origin - to_double(c.hull.center));
  const Vec3 w = to_double(c.axis);
  double min_fixed = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) min_fixed = std::min(min_fixed, dot(w, fixed[i] - fixed_->tree.origin));
  c.offset = -rounded_up(-min_fixed);
  return c;
}

}  // namespace dismantle
