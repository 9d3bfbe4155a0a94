// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/step_preference.h"

#include "dismantle/planner/plan_disassembly.h"
#include "tests/planner/plan_scenes.h"

#include <gtest/gtest.h>

#include <set>

namespace dismantle {
namespace {

using Preferences = std::vector<StepPreference>;

/// Cubes in cases that are open on some sides only. Cases never move.
class Cases {
 public:
  /// @param shape of the cube, lower corner at the origin; equal for equal cubes
  void add(const std::shared_ptr<const TriangleMesh>& shape, const std::vector<Vec3>& open) {
    const Vec3 size = bounds(*shape).size(), place{40.0 * static_cast<double>(cubes_.size()), 0, 0};
    Component cube = scenes::component("cube", *shape);
    cube.mesh = shape;
    cube.assembly_from_mesh.translation = place;
    cubes_.push_back(std::move(cube));
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        Vec3 outward, lower = place, upper = place + size;
        outward[axis] = side;
        if (std::find(open.begin(), open.end(), outward) != open.end()) continue;
        (side < 0 ? upper : lower)[axis] = side < 0 ? lower[axis] : upper[axis];
        (side < 0 ? lower : upper)[axis] += 2 * side;
        walls_.push_back(scenes::component("wall", scenes::box(lower, upper)));
      }
    }
  }

  /// The cubes' numbers in the order of their removal.
  std::vector<std::uint32_t> order(const Preferences& preferences) const {
    std::vector<Component> all = cubes_;
    all.insert(all.end(), walls_.begin(), walls_.end());
    const scenes::PlanScene scene = scenes::plan_scene(scenes::assembly(std::move(all)));
    PlanOptions options;
    options.preferences = preferences;
    for (std::size_t c = cubes_.size(); c < cubes_.size() + walls_.size(); ++c)
      options.fixed.emplace_back(static_cast<std::uint32_t>(c));
    std::vector<std::uint32_t> order;
    for (const PlanStep& step : plan_disassembly(scene.assembly, scene.pairs, options).steps)
      order.push_back(step.components[0].value);
    return order;
  }

 private:
  std::vector<Component> cubes_, walls_;
};

std::shared_ptr<const TriangleMesh> cube(double size) {
  return std::make_shared<const TriangleMesh>(scenes::box({0, 0, 0}, {size, size, size}));
}

constexpr Vec3 kUp{0, 0, 1}, kDown{0, 0, -1}, kAside{0, 1, 0};
using Order = std::vector<std::uint32_t>;

TEST(StepPreference, GoesOnInTheSameDirection) {
  Cases cases;
  cases.add(cube(4), {kAside});
  cases.add(cube(5), {kUp});
  cases.add(cube(6), {kAside});
  EXPECT_EQ(cases.order({StepPreference::Direction}), (Order{0, 2, 1}));
}

TEST(StepPreference, TakesEqualComponentsTogether) {
  const auto small = cube(4), large = cube(5);
  Cases cases;
  for (const Vec3& open : {kAside, kUp}) {
    cases.add(small, {open});
    cases.add(large, {open});
  }
  const auto first_two = [&](const Preferences& preferences) {
    const Order order = cases.order(preferences);
    EXPECT_EQ(order.size(), 4u);
    return std::set<std::uint32_t>{order.at(0), order.at(1)};
  };
  const std::set<std::uint32_t> by_direction = first_two({StepPreference::Direction, StepPreference::Groups});
  EXPECT_TRUE(by_direction == (std::set{0u, 1u}) || by_direction == (std::set{2u, 3u}));
  const std::set<std::uint32_t> by_kind = first_two({StepPreference::Groups, StepPreference::Direction});
  EXPECT_TRUE(by_kind == (std::set{0u, 2u}) || by_kind == (std::set{1u, 3u}));
}

TEST(StepPreference, TurnsNothingOverWhileSomethingElseCanBeDone) {
  Cases cases;
  cases.add(cube(4), {kDown});
  cases.add(cube(5), {kDown, kAside});
  EXPECT_EQ(cases.order({StepPreference::Direction}), (Order{0, 1}));
  EXPECT_EQ(cases.order({StepPreference::Upright}), (Order{1, 0}));
}

TEST(StepPreference, TakesWhatStandsOnAComponentBeforeIt) {
  // A shelf in a slot of a wall, and a cup on it.
  const scenes::PlanScene scene =
      scenes::plan_scene(scenes::assembly({scenes::component("over", scenes::box({-20, -30, 2}, {0, 30, 40})),
                                           scenes::component("under", scenes::box({-20, -30, -40}, {0, 30, 0})),
                                           scenes::component("shelf", scenes::box({-4, -3, 0}, {10, 3, 2})),
                                           scenes::component("cup", scenes::box({0, -6, 2}, {9, 6, 22}))}));
  const auto first = [&](const Preferences& preferences) {
    PlanOptions options;
    options.preferences = preferences;
    options.fixed = {ComponentId(0), ComponentId(1)};
    return plan_disassembly(scene.assembly, scene.pairs, options).steps.at(0).components.at(0);
  };
  EXPECT_EQ(first({StepPreference::Direction}), ComponentId(2)) << "the shelf is smaller";
  EXPECT_EQ(first({StepPreference::Support}), ComponentId(3));
}

TEST(StepPreference, IsReadWithAndWithoutWeights) {
  const auto plain = read_preferences({"support", "groups"});
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->criteria, (Preferences{StepPreference::Support, StepPreference::Groups}));
  EXPECT_TRUE(plain->weights.empty());
  const auto weighted = read_preferences({"tools", "groups=2.5", "loose=0.1"});
  ASSERT_TRUE(weighted);
  EXPECT_EQ(weighted->criteria, (Preferences{StepPreference::Groups, StepPreference::Tools, StepPreference::Loose}));
  EXPECT_EQ(weighted->weights, (std::vector<double>{2.5, 1, 0.1}));
  EXPECT_TRUE(read_preferences({}));
  for (const char* wrong : {"", "beauty", "groups=", "groups=0", "groups=-1", "groups=x", "groups=1e400", "=1"})
    EXPECT_FALSE(read_preferences({wrong})) << wrong;
  EXPECT_FALSE(read_preferences({"groups", "groups=2"}));
}

}  // namespace
}  // namespace dismantle
