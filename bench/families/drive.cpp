// SPDX-License-Identifier: Apache-2.0
#include "bench/families/drive.h"

#include "bench/timing.h"

#include <algorithm>

namespace dismantle::families {

namespace {

constexpr std::size_t kMaxContacts = 150;

ResponseKind some_response(Dice& dice) {
  constexpr ResponseKind kKinds[] = {ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide};
  return kKinds[dice.whole(0, 2)];
}

class Driver {
 public:
  Driver(const Scene& scene, MotionEngine& engine, Dice& dice) : scene_(scene), engine_(engine), dice_(dice) {
    drive_.poses.push_back({});
    drive_.motion.response = some_response(dice);
    drive_.motion.moves.push_back({{scene.parts.front().name}, {}});
    const ComponentId first(0);
    engine.grab({&first, 1});
    center_ = bounds(scene.parts.front().mesh).center();
  }

  /// @return false if it took too long
  StepResult step(const Pose& target) {
    drive_.motion.moves.front().targets.push_back({0.01 * drive_.steps, target});
    const bench::Stopwatch watch;
    StepResult result = engine_.step(target, drive_.motion.response);
    drive_.slowest_ms = std::max(drive_.slowest_ms, watch.ms());
    drive_.seconds += watch.seconds();
    for (const Pose& pose : result.poses) {
      drive_.poses.push_back(pose);
      drive_.step_of.push_back(static_cast<std::size_t>(drive_.steps));
    }
    ++drive_.steps;
    if (!result.contact_points.empty() && drive_.near_fixed.size() < kMaxContacts) {
      const auto last = static_cast<int>(result.contact_points.size()) - 1;
      const Vec3 p = result.contact_points[static_cast<std::size_t>(dice_.whole(0, last))].point;
      drive_.near_fixed.push_back(p);
      drive_.near_moving.push_back(inverse(transform_from_pose(result.pose)) * p);
    }
    return result;
  }

  void drive(int steps, double seconds) {
    while (drive_.steps < steps && drive_.seconds < seconds) phase(steps, seconds);
  }

  Drive take() { return std::move(drive_); }

 private:
  /// Some steps of one kind.
  void phase(int steps, double seconds) {
    const double kind = drive_.steps == 0 ? 0 : dice_.uniform(0, 1);
    const Pose now = engine_.poses()[0];
    const double away = length(transform_from_pose(now) * center_ - center_);
    int count = dice_.whole(1, 15);
    Pose by;
    Vec3 side = cross(dice_.direction(), scene_.toward);
    side = normalized(side + Vec3{1e-9, 0, 0});
    double size = dice_.chance(0.5) ? dice_.spread(0.3 * scene_.tolerance, scene_.size)
                                    : dice_.spread(0.02 * scene_.size, 3 * scene_.size);
    if (away > 4 * scene_.size || kind > 0.93) {
      step(dice_.chance(0.7) ? Pose{} : dice_.chance(0.5) ? away_from(now) : Pose{away_from(now).position, {}});
      return;
    }
    if (kind < 0.45) {
      // A press: at first as far as the parts are apart.
      if (drive_.steps == 0 && scene_.gap > 0 && dice_.chance(0.5)) size = scene_.gap * dice_.uniform(0.1, 1.1);
      by.position = size * normalized(scene_.toward + (dice_.chance(0.5) ? 0 : dice_.spread(1e-3, 1)) * side);
      if (dice_.chance(0.2)) by.rotation = quat_about(dice_.direction(), dice_.spread(1e-4, 0.3));
    } else if (kind < 0.65) {
      by.position = size * normalized(side + dice_.spread(1e-3, 1) * scene_.toward);
    } else if (kind < 0.8) {
      const Quat turn = quat_about(dice_.chance(0.4) ? scene_.toward : dice_.direction(), dice_.spread(1e-3, 2));
      const Vec3 at = transform_from_pose(now) * center_;
      by = {at - mat3_from_quat(turn) * at, turn};
    } else if (kind < 0.9) {
      by.position = -size * scene_.toward;
      count = dice_.whole(1, 4);
    } else {
      by = {size * dice_.direction(), quat_about(dice_.direction(), dice_.uniform(0, 3))};
      count = 1;
    }
    const bool on_target = dice_.chance(0.4);
    Pose target = now;
    for (int i = 0; i < count && drive_.steps < steps && drive_.seconds < seconds; ++i) {
      target = by * (on_target ? target : engine_.poses()[0]);
      if (length(target.position) > 50 * scene_.size) return;
      step(target);
    }
  }

  Pose away_from(const Pose& now) {
    const Quat turn = quat_about(dice_.direction(), dice_.uniform(0, 3));
    return Pose{-2 * scene_.size * scene_.toward + now.position, normalized(turn * now.rotation)};
  }

  const Scene& scene_;
  MotionEngine& engine_;
  Dice& dice_;
  Drive drive_;
  Vec3 center_;
};

}  // namespace

Drive drive(const Scene& scene, MotionEngine& engine, Dice& dice, int max_steps, double max_seconds) {
  Driver driver(scene, engine, dice);
  const int steps = dice.chance(0.04) ? 1000 : static_cast<int>(dice.spread(8, 150));
  driver.drive(std::min(steps, max_steps), max_seconds);
  return driver.take();
}

Drive pull(const Scene& scene, MotionEngine& engine, Vec3 displacement, Dice& dice) {
  Driver driver(scene, engine, dice);
  const int steps = dice.chance(0.3) ? 1 : dice.whole(2, 30);
  for (int k = 1; k <= steps; ++k) driver.step({static_cast<double>(k) / steps * displacement, {}});
  return driver.take();
}

}  // namespace dismantle::families
