// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/assembly.h"

#include "dismantle/assembly/pair_state.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

TEST(MakeNamesUnique, NumbersRepeatsInOrderAndAvoidsTakenNames) {
  std::vector<Component> components(6);
  const char* names[] = {"nut", "nut", "nut#2", "", "nut", ""};
  for (int i = 0; i < 6; ++i) components[i].name = names[i];
  make_names_unique(components);
  const char* expected[] = {"nut", "nut#2", "nut#2#2", "unnamed", "nut#3", "unnamed#2"};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(components[i].name, expected[i]);
}

TEST(Assembly, PlacesInstancesOfASharedMesh) {
  Assembly a = scenes::assembly({scenes::component("one", scenes::box({0, 0, 0}, {1, 1, 1}))});
  a.components.push_back(a.components[0]);
  a.components[1].name = "two";
  a.components[1].assembly_from_mesh.translation = {5, 0, 0};
  EXPECT_EQ(a.components[0].mesh, a.components[1].mesh);
  EXPECT_EQ(assembled_bounds(a.components[1]).lower, (Vec3{5, 0, 0}));
  EXPECT_EQ(assembled_bounds(a).upper, (Vec3{6, 1, 1}));
  EXPECT_EQ(triangle_count(a), 24u);
  EXPECT_EQ(a.find("two"), ComponentId(1));
  EXPECT_FALSE(a.find("three"));
}

TEST(PairStates, FindsAPairInEitherOrder) {
  PairStates states;
  states.pairs.push_back({ComponentId(0), ComponentId(2), PairState::Overlapping, 0, 0.1, 0.11});
  states.pairs.push_back({ComponentId(1), ComponentId(2), PairState::Contact, 0, 0, 0.01});
  EXPECT_EQ(states.find(ComponentId(2), ComponentId(0))->state, PairState::Overlapping);
  EXPECT_EQ(states.find(ComponentId(1), ComponentId(2))->state, PairState::Contact);
  EXPECT_EQ(states.find(ComponentId(0), ComponentId(1)), nullptr);
}

}  // namespace
}  // namespace dismantle
