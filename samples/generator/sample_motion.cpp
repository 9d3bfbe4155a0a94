// SPDX-License-Identifier: Apache-2.0
#include "samples/generator/sample_motion.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace dismantle::samples {
namespace {

constexpr int kSteps = 150;          ///< Targets a move.
constexpr double kStep = 0.02;       ///< Time from target to target [s].
constexpr double kPullShare = 0.75;  ///< Of the steps go to the pull, the rest to putting the part down.
constexpr double kTremor = 0.2;      ///< How far the hand strays once the part is out [mm].

/// Where the hand is at step `i`: it pulls straight, and trembles more and more as the part comes free.
Pose hand_pose(const HandMove& move, int i, int steps) {
  const double pull_steps = kPullShare * (steps - 1);
  const double pull = std::min(1.0, i / pull_steps), rest = std::max(0.0, (i - pull_steps) / (steps - 1 - pull_steps));
  const double shake = kTremor * pull * pull * pull * pull * std::sin(1.9 * i);
  const Vec3 d = move.direction;
  const Vec3 side = std::abs(d.z) < 0.9 ? cross(d, Vec3{0, 0, 1}) : cross(d, Vec3{1, 0, 0});
  const Quat rotation = quat_about(d, 2 * std::numbers::pi * move.turns * pull);
  const RigidTransform turn = transform_from_pose({{0, 0, 0}, rotation});
  const Vec3 about_axis = move.axis_point - turn * move.axis_point;
  return {about_axis + d * (move.distance * pull) + move.then * rest + side * shake, rotation};
}

Motion microscope_motion() {
  const double s = std::numbers::sqrt2 / 2;
  return hand_motion({{{"eyepiece", "eye lens"}, {0, s, s}, 60, 0, {}, {0, 40, -60}},
                      {{"specimen slide"}, {1, 0, 0}, 95, 0, {}, {0, 0, -40}},
                      {{"objective 40x"}, {0, 0, -1}, 12, 0, {}, {0, 10, 0}},
                      {{"head set screw M4x12"}, {0, 1, 0}, 40, 0, {}, {}},
                      {{"head", "tube"}, {0, 0, 1}, 40, 0, {}, {0, 60, -70}},
                      {{"thumb screw threaded"}, {0, 1, 0}, 12, 4, {0, 0, 136}, {0, 30, 0}},
                      {{"condenser"}, {0, 0, -1}, 60, 0, {}, {0, 20, -40}}},
                     kSteps);
}

Motion tooling_motion() {
  return hand_motion({{{"ring screw M6x16"}, {0, 0, 1}, 40, 0, {}, {30, 0, 0}},
                      {{"ring screw M6x16#2"}, {0, 0, 1}, 40, 0, {}, {-30, 0, 0}},
                      {{"locating ring"}, {0, 0, 1}, 30, 0, {}, {110, 0, -45}},
                      {{"sprue bush"}, {0, 0, 1}, 70, 0, {}, {-110, 0, 0}},
                      {{"guide pillar 20"}, {0, 0, 1}, 20, 0, {}, {}},
                      {{"eye bolt M12 threaded"}, {0, 1, 0}, 10.5, 6, {0, 0, 165}, {0, 30, 0}},
                      {{"clamp screw M10x30"}, {0, 0, 1}, 50, 0, {}, {0, 20, 0}}},
                     kSteps);
}

Motion lathe_motion() {
  return hand_motion({{{"tail handwheel"}, {1, 0, 0}, 50, 0, {}, {}},
                      {{"workpiece"}, {1, 0, 0}, 40, 0, {}, {}},
                      {{"turret clamp lever"}, {0, 0, 1}, 100, 0, {}, {0, 60, 0}},
                      {{"turning tool"}, {0, 1, 0}, 20, 0, {}, {}},
                      {{"tool screw M8x18"}, {0, 0, 1}, 40, 0, {}, {0, -30, 0}},
                      {{"lid screw M6x22"}, {0, 0, 1}, 40, 0, {}, {30, 0, 0}},
                      {{"headstock lid"}, {0, 0, 1}, 30, 0, {}, {0, 40, 0}},
                      {{"circlip 11"}, {-1, 0, 0}, 40, 0, {}, {}}},
                     kSteps);
}

Motion robot_motion() {
  return hand_motion({{{"hand knob"}, {0, 1, 0}, 30, 0, {}, {0, 0, 20}},
                      {{"lead screw threaded"}, {0, 1, 0}, 20, 5, {246, 0, 454}, {0, 40, 0}},
                      {{"moving finger"}, {0, 1, 0}, 60, 0, {}, {30, 0, 0}},
                      {{"shoulder cap"}, {0, 1, 0}, 10, 0, {}, {}},
                      {{"cap screw M3x10"}, {0, 1, 0}, 30, 0, {}, {0, 0, 20}},
                      {{"cap screw M3x10#2"}, {0, 1, 0}, 30, 0, {}, {0, 0, -20}},
                      {{"circlip 14"}, {-1, 0, 0}, 40, 0, {}, {}}},
                     kSteps);
}

}  // namespace

Motion hand_motion(const std::vector<HandMove>& moves, int steps) {
  Motion motion;
  motion.response = ResponseKind::Touch;
  for (const HandMove& move : moves) {
    MotionMove targets{move.components, {}};
    for (int i = 0; i < steps; ++i) targets.targets.push_back({kStep * i, hand_pose(move, i, steps)});
    motion.moves.push_back(std::move(targets));
  }
  return motion;
}

Motion make_sample_motion(const std::string& sample) {
  if (sample == "microscope") return microscope_motion();
  if (sample == "tooling") return tooling_motion();
  if (sample == "lathe") return lathe_motion();
  if (sample == "robot") return robot_motion();
  throw std::invalid_argument("there is no sample named " + sample);
}

}  // namespace dismantle::samples
