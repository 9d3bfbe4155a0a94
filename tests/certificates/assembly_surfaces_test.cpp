// SPDX-License-Identifier: Apache-2.0
// Engines that take what others have prepared give the same results as engines that prepare everything themselves.
#include "dismantle/certificates/sweep/assembly_surfaces.h"

#include "tests/certificates/grabbed_component.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace dismantle {
namespace {

using namespace grabbed;

/// Components that overlap, among them two whose depth is bounded and a row with ghosts of their own.
Assembly overlapping_assembly(std::mt19937_64& random) {
  Assembly assembly = scenes::random_assembly(random, 3, 2.5);
  for (int k = 0; k < 4; ++k)
    assembly.components.push_back(
        scenes::component("row" + std::to_string(k), scenes::box({20 + 2.97 * k, 0, 0}, {23 + 2.97 * k, 3, 3})));
  Assembly pierced = rod_through_flange();
  for (Component& component : pierced.components) assembly.components.push_back(std::move(component));
  return assembly;
}

CertificateOptions prepared_by(std::shared_ptr<const AssemblySurfaces> surfaces) {
  CertificateOptions options;
  options.prepared = std::move(surfaces);
  return options;
}

void expect_equal(const AssemblySurfaces& one, const AssemblySurfaces& other) {
  ASSERT_EQ(one.pairs().size(), other.pairs().size());
  auto second = other.pairs().begin();
  for (const auto& [key, pair] : one.pairs()) {
    const auto& [other_key, other_pair] = *second++;
    EXPECT_EQ(key, other_key);
    const GuardedPair &a = pair.guard, &b = other_pair.guard;
    EXPECT_EQ(a.guard, b.guard);
    EXPECT_EQ(a.allowed, b.allowed);
    EXPECT_EQ(a.far_allowed, b.far_allowed);
    EXPECT_EQ(a.hole_for, b.hole_for);
    EXPECT_EQ(a.displaced, b.displaced);
    EXPECT_EQ(a.parting, b.parting);
    for (int k = 0; k < 2; ++k) {
      ASSERT_EQ(pair.ghosts[k] == nullptr, other_pair.ghosts[k] == nullptr);
      if (pair.ghosts[k]) {
        EXPECT_EQ(pair.ghosts[k]->vertices, other_pair.ghosts[k]->vertices);
      }
    }
  }
}

/// Drags some components at random in both engines.
void expect_same_motion(CertificateEngine& one, CertificateEngine& other, std::mt19937_64& random) {
  const auto count = static_cast<std::uint32_t>(one.poses().size());
  for (int drag = 0; drag < 2; ++drag) {
    const ComponentId moving(static_cast<std::uint32_t>(random() % count));
    one.grab({&moving, 1});
    other.grab({&moving, 1});
    Pose target = one.poses()[moving.value];
    for (int step = 0; step < 3; ++step) {
      const Pose by = scenes::random_pose(random, 0.5, 0.2);
      target = {target.position + by.position, by.rotation * target.rotation};
      const StepResult a = one.step(target, ResponseKind::Slide), b = other.step(target, ResponseKind::Slide);
      ASSERT_EQ(a.pose, b.pose);
      ASSERT_EQ(a.reached, b.reached);
      ASSERT_EQ(a.cost.tests, b.cost.tests);
    }
  }
}

/// Some of the components of an assembly, some of which are elsewhere.
struct Part {
  Assembly assembly;
  PairStates states;
  std::vector<ComponentId> ids;  // in the whole
  std::vector<bool> in_place;
};

Part part_of(const Assembly& whole, const PairStates& states, std::mt19937_64& random) {
  Part part;
  part.assembly = whole;
  part.assembly.components.clear();
  for (std::uint32_t c = 0; c < whole.components.size(); ++c) {
    if (random() % 4 == 0) continue;
    Component component = whole.components[c];
    part.in_place.push_back(random() % 4 != 0);
    if (!part.in_place.back())
      component.assembly_from_mesh =
          transform_from_pose(scenes::random_pose(random, 0.5, 0.3)) * component.assembly_from_mesh;
    part.assembly.components.push_back(std::move(component));
    part.ids.emplace_back(c);
  }
  part.states = states_of(part.assembly);
  part.states.tolerance = states.tolerance;
  return part;
}

TEST(AssemblySurfaces, ArePreparedOnceForEnginesOfPartsOfAnAssembly) {
  std::mt19937_64 random(7);
  std::size_t shared_pairs = 0, bounded = 0;
  for (int i = 0; i < 8; ++i) {
    const Assembly whole = overlapping_assembly(random);
    const PairStates states = states_of(whole);
    const CertificateEngine first(whole, states);
    const Part part = part_of(whole, states, random);
    CertificateEngine with(part.assembly, part.states, prepared_by(first.surfaces()));
    CertificateEngine without(part.assembly, part.states);
    for (std::uint32_t c = 0; c < part.ids.size(); ++c)
      EXPECT_EQ(&with.surfaces()->solid(ComponentId(c)) == &first.surfaces()->solid(part.ids[c]), part.in_place[c]);
    expect_equal(*with.surfaces(), *without.surfaces());
    for (const auto& [key, pair] : with.surfaces()->pairs()) {
      bounded += pair.guard.guard == PairGuard::Depth ? 1 : 0;
      const auto known = first.surfaces()->pairs().find({part.ids[key.first.value], part.ids[key.second.value]});
      if (!pair.ghosts[0] || known == first.surfaces()->pairs().end()) continue;
      const bool in_place = part.in_place[key.first.value] && part.in_place[key.second.value];
      EXPECT_EQ(pair.ghosts[0] == known->second.ghosts[0], in_place);
      shared_pairs += in_place ? 1 : 0;
    }
    expect_same_motion(with, without, random);
  }
  EXPECT_GE(shared_pairs, 8u);
  EXPECT_GE(bounded, 3u);
}

TEST(AssemblySurfaces, AreTakenForTheAllowancesThatAnEngineGives) {
  std::mt19937_64 random(8);
  const Assembly assembly = overlapping_assembly(random);
  PairStates states = states_of(assembly);
  const CertificateEngine first(assembly, states);
  states.raise_allowances(first.overlapping_pairs());
  const CertificateEngine with(assembly, states, prepared_by(first.surfaces())), without(assembly, states);
  expect_equal(*with.surfaces(), *without.surfaces());
  for (const auto& [key, pair] : with.surfaces()->pairs())
    EXPECT_EQ(pair.ghosts[0], first.surfaces()->pairs().at(key).ghosts[0]);
}

TEST(AssemblySurfaces, ArePreparedAnewForPairsWithOtherAllowances) {
  std::mt19937_64 random(9);
  const Assembly assembly = overlapping_assembly(random);
  PairStates states = states_of(assembly);
  const CertificateEngine first(assembly, states);
  for (std::size_t i = 0; i < states.pairs.size(); i += 3) {
    const ComponentPair& pair = states.pairs[i];
    states.declare(pair.a, pair.b, pair.depth + 20 * kTolerance);
  }
  for (std::size_t i = 1; i < states.pairs.size(); i += 3) states.pairs[i].allowed_depth += kTolerance;
  const CertificateEngine with(assembly, states, prepared_by(first.surfaces())), without(assembly, states);
  expect_equal(*with.surfaces(), *without.surfaces());
  EXPECT_EQ(&with.surfaces()->solid(ComponentId(0)), &first.surfaces()->solid(ComponentId(0)));
}

TEST(AssemblySurfaces, AreNotTakenForAnotherTolerance) {
  std::mt19937_64 random(10);
  const Assembly assembly = overlapping_assembly(random);
  const CertificateEngine first(assembly, states_of(assembly));
  ClassifyOptions coarse;
  coarse.tolerance = 3 * kTolerance;
  const PairStates states = *classify_pairs(assembly, coarse);
  const CertificateEngine with(assembly, states, prepared_by(first.surfaces())), without(assembly, states);
  expect_equal(*with.surfaces(), *without.surfaces());
  EXPECT_NE(&with.surfaces()->solid(ComponentId(0)), &first.surfaces()->solid(ComponentId(0)));
}

TEST(AssemblySurfaces, AreNotTakenForPairsWhoseSearchWasEndedEarly) {
  std::mt19937_64 random(11);
  const Assembly assembly = overlapping_assembly(random);
  const PairStates states = states_of(assembly);
  CertificateOptions stopped;
  stopped.keep_going = [] { return false; };
  const CertificateEngine first(assembly, states, stopped);
  const CertificateEngine with(assembly, states, prepared_by(first.surfaces())), without(assembly, states);
  expect_equal(*with.surfaces(), *without.surfaces());
  EXPECT_EQ(&with.surfaces()->solid(ComponentId(0)), &first.surfaces()->solid(ComponentId(0)));
}

TEST(AssemblySurfaces, AreFoundForComponentsInAnyOrder) {
  std::mt19937_64 random(12);
  const Assembly assembly = overlapping_assembly(random);
  const CertificateEngine first(assembly, states_of(assembly));
  Assembly reversed = assembly;
  std::reverse(reversed.components.begin(), reversed.components.end());
  // The same component twice in the same place.
  reversed.components.push_back(assembly.components[0]);
  const PairStates states = states_of(reversed);
  CertificateEngine with(reversed, states, prepared_by(first.surfaces())), without(reversed, states);
  expect_equal(*with.surfaces(), *without.surfaces());
  EXPECT_EQ(&with.surfaces()->solid(ComponentId(0)), &first.surfaces()->solid(ComponentId(8)));
  expect_same_motion(with, without, random);
}

TEST(AssemblySurfaces, OutliveTheAssemblyAndTheEngineThatPreparedThem) {
  std::mt19937_64 random(13);
  auto assembly = std::make_unique<Assembly>(overlapping_assembly(random));
  const PairStates states = states_of(*assembly);
  CertificateEngine without(*assembly, states);
  std::optional<CertificateEngine> with;
  {
    const CertificateEngine first(*assembly, states);
    with.emplace(*assembly, states, prepared_by(first.surfaces()));
  }
  *assembly = {};
  assembly.reset();
  expect_same_motion(*with, without, random);
}

}  // namespace
}  // namespace dismantle
