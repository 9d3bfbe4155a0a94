// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/search/removal_search.h"
#include "tests/planner/plan_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace dismantle::scenes {

/// Pairs of a blocked component and its blocker, one list a direction.
using Relations = std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>>;

/// Relations by which all components can be removed one after another: in each direction a random half of those after a
/// component in some order block it.
inline Relations random_relations(std::uint32_t count, std::size_t directions, std::mt19937_64& random) {
  Relations relations(directions);
  for (auto& direction : relations) {
    std::vector<std::uint32_t> order(count);
    for (std::uint32_t k = 0; k < count; ++k) order[k] = k;
    std::shuffle(order.begin(), order.end(), random);
    for (std::uint32_t i = 0; i < count; ++i)
      for (std::uint32_t j = i + 1; j < count; ++j)
        if (random() % 2 == 0) direction.emplace_back(order[i], order[j]);
  }
  return relations;
}

/// A product given by its blocking relations: boxes whose table is filled directly.
class RelationsTest : public testing::Test {
 protected:
  /// The table of `count` boxes, along as many directions as there are relations.
  void make(std::uint32_t count, const Relations& relations) {
    std::vector<Component> components;
    for (std::uint32_t k = 0; k < count; ++k) components.push_back(component("box", box({0, 0, 0}, {1, 1, 1})));
    scene_ = {assembly(std::move(components)), {0.01, {}}};
    // Free pairs do not block: only the given relations do.
    for (std::uint32_t a = 0; a < count; ++a)
      for (std::uint32_t b = a + 1; b < count; ++b)
        scene_.pairs.pairs.push_back({ComponentId(a), ComponentId(b), PairState::Free, 0, 1, 1});
    engine_.emplace(scene_.assembly, scene_.pairs);
    features_.assign(count, shape_features(*scene_.assembly.components[0].mesh));
    groups_.emplace(count);
    table_.emplace(*engine_, features_, *groups_, kAlways);
    directions_.assign(count, {});
    for (std::size_t k = 0; k < relations.size(); ++k) {
      const DirectionId d = table_->add_direction(normalized(Vec3{1, 0.1 * static_cast<double>(k), 0}));
      for (std::vector<DirectionId>& own : directions_) own.push_back(d);
      for (const auto& [moving, fixed] : relations[k]) table_->add_blocker(ComponentId(moving), d, ComponentId(fixed));
    }
  }

  const KeepGoing kAlways = [] { return true; };
  PlanScene scene_;
  std::optional<CertificateEngine> engine_;
  std::vector<ShapeFeatures> features_;
  std::optional<RigidGroups> groups_;
  std::optional<BlockingTable> table_;
  DirectionLists directions_;
};

}  // namespace dismantle::scenes
