// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/engine/classify_pairs.h"
#include "dismantle/planner/plan_disassembly.h"
#include "tests/support/puzzle_scenes.h"
#include "tests/support/random_scenes.h"
#include "tests/support/slide_scenes.h"

#include <string>
#include <vector>

/// Small assemblies whose disassembly is known.
namespace dismantle::scenes {

/// The effort of slide searches in tests: at least twice that of the searches that succeed.
inline constexpr std::size_t kSlideEffort = 40'000;

/// An assembly with its pairs.
struct PlanScene {
  Assembly assembly;
  PairStates pairs;
};

inline PlanScene plan_scene(Assembly assembly, double tolerance = 0.01) {
  PlanScene scene{std::move(assembly), {}};
  ClassifyOptions classify;
  classify.tolerance = tolerance;
  scene.pairs = *classify_pairs(scene.assembly, classify);
  return scene;
}

/// The assembly rotated and translated as a whole, then scaled.
inline Assembly placed(Assembly assembly, const Pose& pose, double scale = 1) {
  for (Component& c : assembly.components) {
    TriangleMesh mesh = moved(assembled_mesh(c), pose);
    for (Vec3& p : mesh.vertices) p = scale * p;
    c.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  }
  return assembly;
}

/// The assembly without the named components.
inline Assembly without(const Assembly& assembly, const std::vector<ComponentId>& components) {
  std::vector<Component> left;
  for (std::uint32_t c = 0; c < assembly.components.size(); ++c)
    if (std::find(components.begin(), components.end(), ComponentId(c)) == components.end())
      left.push_back(assembly.components[c]);
  return scenes::assembly(std::move(left));
}

/// A tube with square hole along z, and boxes in it from bottom to top, their faces touching: "box 0", "box 1", ...
inline Assembly stack_in_tube(int count) {
  std::vector<Component> components{component("tube", frame(5, 2, 0, 4.0 * count))};
  for (int k = 0; k < count; ++k)
    components.push_back(component("box " + std::to_string(k), box({-5, -5, 4.0 * k}, {5, 5, 4.0 * (k + 1)})));
  return assembly(std::move(components));
}

/// A block that fills a pot, between the floor and the lid.
inline Assembly covered_pot() {
  return assembly({component("pot", frame(5, 3, 0, 10)), component("floor", box({-8, -8, -2}, {8, 8, 0})),
                   component("block", box({-5, -5, 0}, {5, 5, 10})), component("lid", box({-8, -8, 10}, {8, 8, 12}))});
}

/// A dovetail whose halves slide apart along z, in a frame around it that is open along y: they leave it together, and
/// only then come apart. @param depth of the frame along +y
inline Assembly framed_dovetail(double depth = 10) {
  const Profile outer = {{-25, -10}, {25, -10}, {25, 40}, {-25, 40}}, inner = {{-15, 0}, {15, 0}, {15, 30}, {-15, 30}};
  const Pose upright{{}, quat_about({1, 0, 0}, kTurn / 4)};
  std::vector<Component> components = dovetail(0).assembly.components;
  components.push_back(component("frame", moved(extruded_band(outer, inner, true, -depth, 5), upright)));
  return assembly(std::move(components));
}

/// A product of about `count` components: a base, rows of stations of five parts that resemble bolted joints (sleeve,
/// pin with a head in it, two washers and a cap over all), and a cover on all of them. Equal parts share their meshes.
/// All can be removed.
inline Assembly stations(std::uint32_t count) {
  constexpr double kApart = 20;
  const std::uint32_t all = std::max(1u, (count - 2) / 5);
  const auto rows = static_cast<std::uint32_t>(std::ceil(std::sqrt(all)));
  const double size = kApart * rows;
  const std::vector<Component> parts = {
      component("sleeve", tube(6, 3, 0, 10, 24)),
      component("pin", revolved({{0, 2}, {2.9, 2}, {2.9, 11}, {5, 11}, {5, 12}, {0, 12}}, 24)),
      component("lower washer", tube(5, 3, 10, 10.5, 24)), component("upper washer", tube(5, 3, 10.5, 11, 24)),
      component("cap", revolved({{0, 13}, {7, 13}, {7, 0}, {8, 0}, {8, 14}, {0, 14}}, 24))};
  std::vector<Component> components{component("base", box({0, 0, -5}, {size, size, 0})),
                                    component("cover", box({0, 0, 14}, {size, size, 18}))};
  for (std::uint32_t k = 0; k < all; ++k)
    for (Component part : parts) {
      part.name += " " + std::to_string(k);
      part.assembly_from_mesh.translation = {kApart * (k % rows + 0.5), kApart * (k / rows + 0.5), 0};
      components.push_back(std::move(part));
    }
  return assembly(std::move(components));
}

}  // namespace dismantle::scenes
