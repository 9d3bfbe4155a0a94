// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/motion_file.h"
#include "dismantle/engine/classify_pairs.h"
#include "dismantle/loading/load_assembly.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dismantle {
namespace {

/// The expected content of a sample's file.
struct Expected {
  const char* name;
  std::size_t components, triangles;
  std::vector<const char*> some_names;
};

void PrintTo(const Expected& expected, std::ostream* out) {
  *out << expected.name;
}

std::filesystem::path sample_file(const std::string& name, const char* ending) {
  return std::filesystem::path(DISMANTLE_SOURCE_DIR) / "samples" / (name + ending);
}

class SampleFile : public testing::TestWithParam<Expected> {};

void expect_clean(const Assembly& assembly) {
  for (const Component& component : assembly.components) {
    EXPECT_TRUE(component.faults.closed()) << component.name;
    EXPECT_FALSE(component.faults.inside_out) << component.name;
    EXPECT_EQ(component.faults.degenerate_faces, 0u) << component.name;
  }
}

void expect_motion(const std::string& name, const Assembly& assembly) {
  const Result<Motion> motion = read_motion(sample_file(name, ".motion.json"));
  ASSERT_TRUE(motion.ok()) << motion.error().message;
  EXPECT_EQ(motion->response, ResponseKind::Touch);
  const Result<Done> known = check_names(*motion, assembly);
  EXPECT_TRUE(known.ok()) << known.error().message;
  EXPECT_GE(motion->moves.size(), 5u);
  for (const MotionMove& move : motion->moves) {
    EXPECT_GE(move.targets.size(), 100u);
    EXPECT_LE(move.targets.size(), 200u);
  }
}

TEST_P(SampleFile, HasClosedComponentsAboutThePapersTrianglesAndAMotionOfItsOwn) {
  const Result<Assembly> assembly = load_assembly(sample_file(GetParam().name, ".step"));
  ASSERT_TRUE(assembly.ok()) << assembly.error().message;
  EXPECT_EQ(assembly->components.size(), GetParam().components);
  const double triangles = static_cast<double>(triangle_count(*assembly));
  const double papers = static_cast<double>(GetParam().triangles);
  EXPECT_GT(triangles, 0.85 * papers);
  EXPECT_LT(triangles, 1.15 * papers);
  for (const char* name : GetParam().some_names) EXPECT_TRUE(assembly->find(name)) << name;
  expect_clean(*assembly);
  expect_motion(GetParam().name, *assembly);
}

INSTANTIATE_TEST_SUITE_P(
    Samples, SampleFile,
    testing::Values(
        Expected{
            "microscope", 41, 19000, {"base", "arm", "rack", "pinion shaft", "turret", "objective 10x", "eyepiece"}},
        Expected{"tooling",
                 57,
                 43500,
                 {"cavity insert", "core insert", "guide pillar 20#4", "ejector pin 6#3", "sprue bush"}},
        Expected{"lathe",
                 119,
                 120000,
                 {"spindle", "jaw 3", "lead screw threaded", "turret", "quill", "front bearing roller#10"}},
        Expected{"robot", 76, 43000, {"base housing", "upper arm", "planet gear#6", "ring gear#2", "moving finger"}}),
    [](const auto& test) { return std::string(test.param.name); });

/// The pairs of a sample that overlap by design.
struct MeantOverlaps {
  const char* sample;
  struct Pair {
    const char* a;
    const char* b;
  };
  std::vector<Pair> pairs;
};

void PrintTo(const MeantOverlaps& overlaps, std::ostream* out) {
  *out << overlaps.sample;
}

class SampleFits : public testing::TestWithParam<MeantOverlaps> {};

TEST_P(SampleFits, OverlapAsTheReadmeSays) {
  const Result<Assembly> assembly = load_assembly(sample_file(GetParam().sample, ".step"));
  ASSERT_TRUE(assembly.ok()) << assembly.error().message;
  const Result<PairStates> states = classify_pairs(*assembly, {});
  ASSERT_TRUE(states.ok()) << states.error().message;
  for (const MeantOverlaps::Pair& meant : GetParam().pairs) {
    const auto a = assembly->find(meant.a), b = assembly->find(meant.b);
    ASSERT_TRUE(a && b) << meant.a << ", " << meant.b;
    const ComponentPair* pair = states->find(*a, *b);
    ASSERT_NE(pair, nullptr) << meant.a << ", " << meant.b;
    EXPECT_EQ(pair->state, PairState::Overlapping) << meant.a << ", " << meant.b << " " << pair->depth;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Samples, SampleFits,
    testing::Values(
        MeantOverlaps{"microscope",
                      {{"arm", "arm screw M8x28"}, {"turret", "objective 40x"}, {"pinion shaft", "circlip 7"}}},
        MeantOverlaps{"tooling",
                      {{"core plate", "frame screw M10x110"},
                       {"ejector base plate", "ejector rod"},
                       {"cavity plate", "hose nipple"}}},
        MeantOverlaps{"lathe",
                      {{"bed", "headstock screw M8x45"}, {"spindle", "spindle nut"}, {"idler pin", "circlip 11"}}},
        MeantOverlaps{"robot",
                      {{"elbow", "motor screw M3x48"}, {"elbow trunnion", "circlip 14"}, {"wrist pin", "circlip 9"}}}),
    [](const auto& test) { return std::string(test.param.sample); });

}  // namespace
}  // namespace dismantle
