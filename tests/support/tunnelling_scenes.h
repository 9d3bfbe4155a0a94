// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/screw.h"
#include "tests/support/meshes.h"

/// Motions of one step past, into and through thin walls, with the exact time of their first contact.
namespace dismantle::scenes {

/// One step of a component past another that does not move.
struct OneStep {
  std::string name;
  TriangleMesh fixed, moving;  ///< Assembled; the moving one is at `start`.
  Pose start, target;          ///< Of the moving component.
  bool free = true;
  double toi = 1;  ///< Of the first contact, exact to rounding; 1 if free.
};

/// The first time in [0, 1] at which `gap`, a function of time, is not above 0: bisection between a thousand samples.
template <class Gap>
double first_touch(const Gap& gap) {
  const int samples = 1000;
  for (int k = 1; k <= samples; ++k) {
    if (gap(static_cast<double>(k) / samples) > 0) continue;
    double low = (k - 1.0) / samples, high = static_cast<double>(k) / samples;
    for (int i = 0; i < 60; ++i) (gap((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
    return high;
  }
  return 1;
}

/// A cube of 2 mm about the origin that moves obliquely, turning by 0.4 rad, through a plate with its lower face at
/// z = 5.
inline OneStep oblique_cube(double thickness) {
  const Pose target{{3, 2, 10}, quat_about(normalized(Vec3{1, 2, 3}), 0.4)};
  const TriangleMesh cube = box({-1, -1, -1}, {1, 1, 1});
  const double toi = first_touch([&](double s) {
    const RigidTransform now = transform_from_pose(pose_between({}, target, s));
    double gap = 1e9;
    for (const Vec3& corner : cube.vertices) gap = std::min(gap, 5 - (now * corner).z);
    return gap;
  });
  return {"cube obliquely through a plate", box({-50, -50, 5}, {50, 50, 5 + thickness}), cube, {}, target, false, toi};
}

/// A rod of 20 mm along x that swings by 170 degrees about its end at the origin through a 0.1 mm wall above it.
inline OneStep swinging_rod() {
  const double swing = 170 * std::acos(-1.0) / 180, half = 0.5, wall = 0.05, low = 5;
  // The first contact: the wall's near lower edge (wall, low) and the rod's leading face, `half` from its middle:
  // low cos(a) - wall sin(a) = half.
  const double angle = std::acos(half / std::sqrt(low * low + wall * wall)) - std::atan2(wall, low);
  return {"rod swinging through a wall",
          box({-wall, low, -5}, {wall, 30, 5}),
          box({0, -half, -half}, {20, half, half}),
          {},
          {{}, quat_about({0, 0, 1}, swing)},
          false,
          angle / swing};
}

/// The suite near the origin, starting from the identity.
inline std::vector<OneStep> tunnelling_suite() {
  const TriangleMesh cube = box({-1, -1, -1}, {1, 1, 1});
  const auto plate = [](double z, double thickness) { return box({-50, -50, z}, {50, 50, z + thickness}); };
  const auto by = [](double x, double y, double z) { return Pose{{x, y, z}, {}}; };
  std::vector<OneStep> suite;
  suite.push_back({"cube through a 0.1 mm plate", plate(5, 0.1), cube, {}, by(0, 0, 10), false, 0.4});
  suite.push_back({"cube through a 1 um plate", plate(5, 0.001), cube, {}, by(0, 0, 10), false, 0.4});
  suite.push_back({"cube far through a 1 um plate", plate(5, 0.001), cube, {}, by(0, 0, 1000), false, 0.004});
  suite.push_back(oblique_cube(0.1));
  suite.push_back(swinging_rod());
  suite.push_back({"over a gap of 1e-3", plate(1.001, 0.1), cube, {}, by(0, 0, 1), false, 0.001});
  suite.push_back({"exactly up to contact", plate(5, 0.1), cube, {}, by(0, 0, 4), true, 1});
  suite.push_back({"1e-3 short of contact", plate(5, 0.1), cube, {}, by(0, 0, 3.999), true, 1});
  suite.push_back({"0.01 mm above a plate", plate(-1.11, 0.1), cube, {}, by(30, 0, 0), true, 1});
  suite.push_back(
      {"0.01 mm above a plate, turning", plate(-1.11, 0.1), cube, {}, {{30, 5, 0}, quat_about({0, 0, 1}, 2)}, true, 1});
  suite.push_back({"touching and sliding", plate(-1.1, 0.1), cube, {}, by(30, 0, 0), true, 1});
  suite.push_back({"touching and turning", plate(-1.1, 0.1), cube, {}, {{}, quat_about({0, 0, 1}, 1)}, true, 1});
  suite.push_back({"touching and moving away", plate(-1.1, 0.1), cube, {}, by(1, 2, 10), true, 1});
  suite.push_back({"touching and pressing through", plate(-1.1, 0.1), cube, {}, by(0, 0, -10), false, 0});
  return suite;
}

/// The same step, with vertices and motion moved by `offset`.
inline OneStep placed(OneStep step, const Pose& offset) {
  step.fixed = moved(std::move(step.fixed), offset);
  step.moving = moved(std::move(step.moving), offset);
  step.start = offset * step.start * inverse(offset);
  step.target = offset * step.target * inverse(offset);
  return step;
}

/// The same step from a start pose other than the identity: the moving mesh is assembled elsewhere.
inline OneStep started_from(OneStep step, const Pose& start) {
  step.moving = moved(std::move(step.moving), inverse(start));
  step.target = step.target * inverse(step.start) * start;
  step.start = start;
  return step;
}

/// Its assembly: component 1 moves. As assembled, not as at the start.
inline Assembly assembly_of(const OneStep& step) {
  return assembly({component("fixed", step.fixed), component("moving", step.moving)});
}

}  // namespace dismantle::scenes
