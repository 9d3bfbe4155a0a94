// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/rigid_groups.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using Ids = std::vector<ComponentId>;

Ids ids(const std::vector<std::uint32_t>& values) {
  Ids found;
  for (const std::uint32_t v : values) found.emplace_back(v);
  return found;
}

Ids of(const RigidGroups& groups, std::uint32_t c) {
  return {groups.of(ComponentId(c)).begin(), groups.of(ComponentId(c)).end()};
}

TEST(RigidGroups, AreUnitedWhereTheyShareAComponent) {
  RigidGroups groups(6);
  EXPECT_TRUE(groups.of_several().empty());
  groups.unite(ids({4, 1}));
  groups.unite(ids({5, 2}));
  EXPECT_EQ(of(groups, 1), ids({1, 4}));
  EXPECT_EQ(of(groups, 0), ids({0}));
  EXPECT_EQ(groups.of_several().size(), 2u);
  groups.unite(ids({5, 4, 5}));
  EXPECT_EQ(of(groups, 2), ids({1, 2, 4, 5}));
  EXPECT_TRUE(groups.together(ComponentId(1), ComponentId(2)));
  EXPECT_FALSE(groups.together(ComponentId(1), ComponentId(3)));
  EXPECT_EQ(groups.of_several(), std::vector<Ids>{ids({1, 2, 4, 5})});
  EXPECT_EQ(groups.with_groups(ids({3, 5, 4})), ids({1, 2, 3, 4, 5}));
  groups.unite({});
  groups.unite(ids({3}));
  EXPECT_EQ(groups.of_several().size(), 1u);
}

/// product -+- bearing -+- ring, ball, ball.2
///          +- bearing -+- ring.2, ball.3
///          +- screw, screw.2
Assembly bearings() {
  Assembly a;
  a.tree = {{"product", 0}, {"bearing", 0}, {"bearing", 0}, {"ring", 1},  {"ball", 1},
            {"ball", 1},    {"ring", 2},    {"ball", 2},    {"screw", 0}, {"screw", 0}};
  const char* names[] = {"ring", "ball", "ball.2", "ring.2", "ball.3", "screw", "screw.2"};
  for (std::uint32_t c = 0; c < 7; ++c) {
    Component component;
    component.name = names[c];
    component.tree_node = c + 3;
    a.components.push_back(component);
  }
  return a;
}

std::vector<Ids> named(const std::vector<std::string>& patterns) {
  const Result<RigidGroups> groups = named_groups(bearings(), patterns);
  EXPECT_TRUE(groups.ok());
  return groups->of_several();
}

TEST(NamedGroups, AreSubAssembliesOrElseComponents) {
  EXPECT_TRUE(named({}).empty());
  EXPECT_EQ(named({"bearing"}), (std::vector<Ids>{ids({0, 1, 2}), ids({3, 4})}));
  EXPECT_EQ(named({"bea*"}).size(), 2u);
  EXPECT_EQ(named({"screw*"}), std::vector<Ids>{ids({5, 6})});
  EXPECT_EQ(named({"ball*", "screw*"}).size(), 2u);
  EXPECT_EQ(named({"ball*", "bearing"}), std::vector<Ids>{ids({0, 1, 2, 3, 4})});
}

TEST(NamedGroups, RefusesNamesThatMakeNoGroup) {
  EXPECT_EQ(named_groups(bearings(), std::vector<std::string>{"bering"}).error().message,
            "'bering' is unknown (no sub-assembly and no component has such a name); 'dismantle info' lists them");
  EXPECT_EQ(named_groups(bearings(), std::vector<std::string>{"screw.2"}).error().message,
            "'screw.2' cannot be treated as one part (it is one component, 'screw.2'); name a sub-assembly or several "
            "components");
  EXPECT_FALSE(named_groups(bearings(), std::vector<std::string>{"product"}).ok());  // the root is everything
}

}  // namespace
}  // namespace dismantle
