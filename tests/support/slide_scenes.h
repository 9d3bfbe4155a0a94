// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/screw.h"
#include "tests/support/gear_meshes.h"
#include "tests/support/meshes.h"
#include "tests/support/random_scenes.h"

/// Fits that come apart only by sliding, at the clearances of real machines.
namespace dismantle::scenes {

/// An assembly, its moving component, and the straight motion that removes it.
struct SlideScene {
  Assembly assembly;
  ComponentId moving;
  Vec3 pull;                 ///< Unit direction of the motion.
  double exit_distance = 0;  ///< Along `pull`, until the component is out [mm].
  Vec3 center;               ///< Of the component's bounding box [mm, assembled]; the hand's tremor is about it.
};

/// A scene whose last component moves.
inline SlideScene slide_scene(std::vector<Component> components, Vec3 pull, double exit_distance) {
  SlideScene scene;
  scene.assembly = assembly(std::move(components));
  scene.moving = ComponentId(static_cast<std::uint32_t>(scene.assembly.components.size()) - 1);
  scene.pull = normalized(pull);
  scene.exit_distance = exit_distance;
  scene.center = assembled_bounds(scene.assembly[scene.moving]).center();
  return scene;
}

/// A simulated hand: pulls steadily with a tremor in position and rotation, whatever blocks the component.
/// Deterministic.
class Hand {
 public:
  struct Options {
    double step = 0.5;   ///< Of the pull [mm].
    double shake = 0.3;  ///< Of the position in each coordinate [mm].
    double turn = 0.06;  ///< Of the rotation about any axis [rad].
    std::uint64_t seed = 1;
  };

  Hand(const SlideScene& scene, const Options& options) : scene_(scene), options_(options), random_(options.seed) {}

  /// The target after a pull by `pulled` mm, without tremor.
  Pose steady(double pulled) const { return {pulled * scene_.pull, {}}; }
  /// The next target.
  Pose next() { return trembling(steady(++count_ * options_.step)); }
  /// `pose` with tremor about the component's centre.
  Pose trembling(const Pose& pose) {
    const Pose shake = random_pose(random_, options_.shake, options_.turn);
    const Vec3 center = transform_from_pose(pose) * scene_.center;
    const Pose to_center{center, {}}, from_center{-center, {}};
    return to_center * shake * from_center * pose;
  }

 private:
  const SlideScene& scene_;
  Options options_;
  std::mt19937_64 random_;
  int count_ = 0;
};

/// The distance that the component's centre has moved along `pull` at a pose [mm].
inline double distance_moved(const SlideScene& scene, const Pose& pose) {
  return dot(transform_from_pose(pose) * scene.center - scene.center, scene.pull);
}

/// A peg of 10 mm with a shoulder that rests on the block, in a bore of `sides` sides whose radius is larger by
/// `clearance`; the sides face each other.
inline SlideScene peg_in_hole(std::uint32_t sides, double clearance, double depth = 22.5) {
  const Profile peg = {{0, 0}, {5, 0}, {5, depth}, {8, depth}, {8, depth + 5}, {0, depth + 5}};
  return slide_scene(
      {component("block", extruded_band(square_around(12, sides), circle(5 + clearance, sides), true, 0, depth)),
       component("peg", revolved(peg, sides))},
      {0, 0, 1}, depth);
}

/// A pin whose radius is larger than that of its bore by `interference`.
inline SlideScene press_fit_pin(std::uint32_t sides, double interference, double depth = 20) {
  const double r = 5 + interference;
  const Profile pin = {{0, -1}, {r, -1}, {r, depth + 1}, {0, depth + 1}};
  return slide_scene({component("block", extruded_band(square_around(12, sides), circle(5, sides), true, 0, depth)),
                      component("pin", revolved(pin, sides))},
                     {0, 0, 1}, depth + 1);
}

/// A channel along z that is open upwards (y): a groove of half width `half` from y = 4 to y = 12.
inline TriangleMesh channel(double half, double floor, double length) {
  return extruded_band({{-10, 12}, {-10, 0}, {10, 0}, {10, 12}},
                       {{-half, 12}, {-half, floor}, {half, floor}, {half, 12}}, false, 0, length);
}

/// A key of 8 mm in its slot, `clearance` on either side and below. Out upwards (0, 1, 0) or along (0, 0, 1).
inline SlideScene key_in_slot(double clearance, Vec3 pull) {
  return slide_scene(
      {component("hub", channel(4 + clearance, 4 - clearance, 20)), component("key", box({-4, 4, 0}, {4, 11, 20}))},
      pull, pull.y > 0 ? 8 : 20);
}

/// A plate thicker by `excess` than the slot it stands in, out upwards.
inline SlideScene plate_in_slot(double excess) {
  const double half = 1 + excess / 2;
  return slide_scene({component("slot", channel(1, 4, 20)), component("plate", box({-half, 4, 2}, {half, 30, 18}))},
                     {0, 1, 0}, 8);
}

/// A dovetail slider in its guide, `clearance` on its flanks and below; out along z only.
inline SlideScene dovetail(double clearance) {
  const double slope = 0.4, aside = clearance * std::sqrt(1 + slope * slope), low = 10 + aside + slope * clearance;
  const Profile groove = {{-6 - aside, 10}, {-low, -clearance}, {low, -clearance}, {6 + aside, 10}};
  return slide_scene({component("way", extruded_band({{-15, 10}, {-15, -5}, {15, -5}, {15, 10}}, groove, false, 0, 30)),
                      component("slider", extruded({{-10, 0}, {10, 0}, {6, 10}, {-6, 10}}, 0, 30))},
                     {0, 0, 1}, 30);
}

/// A cube that touches a floor and two walls.
inline SlideScene part_in_corner() {
  return slide_scene(
      {component("floor", box({-5, -5, -5}, {30, 30, 0})), component("wall x", box({-5, -5, 0}, {0, 30, 20})),
       component("wall y", box({0, -5, 0}, {30, 0, 20})), component("cube", box({0, 0, 0}, {10, 10, 10}))},
      {1, 1, 1}, 10);
}

/// Two meshing gears, of which the second moves; out along the line of their centres (x).
struct GearPair {
  Gear fixed, moving;
  double distance() const { return fixed.pitch_radius() + moving.pitch_radius(); }
  /// The moving gear's pose after it has rolled by `angle` about the fixed one's centre (the pitch circles roll) and
  /// moved out by `apart` along the line of centres.
  Pose rolled(double angle, double apart = 0) const {
    const double spin = angle * (1 + static_cast<double>(fixed.teeth) / moving.teeth);
    const Vec3 center{(distance() + apart) * std::cos(angle), (distance() + apart) * std::sin(angle), 0};
    return Pose{center, quat_about({0, 0, 1}, spin)} * Pose{{-distance(), 0, 0}, {}};
  }
};

inline GearPair gear_pair(double backlash) {
  GearPair pair;
  pair.fixed.teeth = 30;
  pair.moving.teeth = 20;
  pair.fixed.backlash = pair.moving.backlash = backlash;
  return pair;
}

inline SlideScene meshing_gears(const GearPair& pair) {
  // A gap of the moving gear faces the fixed gear's tooth on the x axis.
  const double turn = kTurn / 2 + kTurn / 2 / pair.moving.teeth;
  return slide_scene(
      {component("wheel", gear_mesh(pair.fixed)),
       component("pinion", moved(gear_mesh(pair.moving), {{pair.distance(), 0, 0}, quat_about({0, 0, 1}, turn)}))},
      {1, 0, 0}, 2.5 * pair.fixed.module);
}

}  // namespace dismantle::scenes
