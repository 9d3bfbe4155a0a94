// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/path_file.h"

#include "tests/support/meshes.h"
#include "tests/support/parse_expectations.h"
#include "tests/support/scratch_folder.h"

#include <nlohmann/json.hpp>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace dismantle {

namespace {

// The example of docs/formats.md.
constexpr const char* kExample = R"({
  "format": "dismantle-path", "version": 2,
  "assembly": {"file": "vice.step", "sha256": "00ff", "components": ["base", "jaw", "screw"]},
  "tolerance_mm": 0.01,
  "pairs": [{"a": "jaw", "b": "screw", "state": "overlapping", "initial_depth_mm": 0.021, "allowed_depth_mm": 0.031},
            {"a": "jaw", "b": "base", "state": "free", "initial_depth_mm": 1.5, "allowed_depth_mm": null},
            {"a": "screw", "b": "base", "state": "declared", "initial_depth_mm": 0, "allowed_depth_mm": 2}],
  "moves": [
    {"label": "remove screw", "components": ["screw"],
     "frames": [{"t": 0.0, "position": [0,0,0], "rotation": [1,0,0,0]},
                {"t": 0.1, "position": [0,0,5], "rotation": [1,0,0,0]}]}
  ],
  "removed": ["screw"]
})";

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The example with the value at a JSON pointer replaced by other JSON text.
std::string with(const std::string& pointer, const std::string& value) {
  auto document = nlohmann::json::parse(kExample);
  document[nlohmann::json::json_pointer(pointer)] = nlohmann::json::parse(value);
  return document.dump();
}

std::string without(const std::string& parent, const std::string& name) {
  auto document = nlohmann::json::parse(kExample);
  document[nlohmann::json::json_pointer(parent)].erase(name);
  return document.dump();
}

Result<Path> parse(const std::string& text) {
  return parse_path(text, "a.path.json");
}

}  // namespace

TEST(PathFile, ReadsTheExampleOfTheFormat) {
  const auto path = parse(kExample);
  ASSERT_TRUE(path.ok()) << message_of(path);
  EXPECT_EQ(path->assembly_file, "vice.step");
  EXPECT_EQ(path->components, (std::vector<std::string>{"base", "jaw", "screw"}));
  EXPECT_EQ(path->tolerance, 0.01);
  EXPECT_EQ(path->version, 2);
  ASSERT_EQ(path->pairs.size(), 3u);
  EXPECT_EQ(path->pairs[0], (PathPair{"jaw", "screw", PathPairState::Overlapping, 0.021, 0.031}));
  EXPECT_EQ(path->pairs[1], (PathPair{"jaw", "base", PathPairState::Free, 1.5, kInfinity}));
  EXPECT_EQ(path->pairs[2], (PathPair{"screw", "base", PathPairState::Declared, 0, 2}));
  ASSERT_EQ(path->moves.size(), 1u);
  EXPECT_EQ(path->moves[0].label, "remove screw");
  EXPECT_EQ(path->moves[0].frames[1], (Frame{0.1, {{0, 0, 5}, {}}}));
  EXPECT_EQ(path->removed, (std::vector<std::string>{"screw"}));
}

TEST(PathFile, WritesWhatItReadsBitForBit) {
  const unsigned seed = 11;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Path path;
  path.assembly_file = "vice \"new\".step";
  path.assembly_sha256 = std::string(64, 'a');
  path.components = {"sch\xc3\xb6n", "b\n\t", "c\\"};
  path.tolerance = 0.1 + 0.2;
  path.pairs = {{"b\n\t", "c\\", PathPairState::Overlapping, 0.1 + 0.2, 1.0 / 3},
                {"c\\", "b\n\t", PathPairState::Declared, 0, 1e-300},
                {"c\\", "b\n\t", PathPairState::Free, 0.7, kInfinity}};
  Move move{"pull", {"c\\"}, {}};
  double time = 0;
  while (move.frames.size() < 3000) {
    const auto anything = [&] {
      const double value = std::bit_cast<double>(random());
      return std::abs(value) <= 1e9 ? value : normal(random);
    };
    const Quat q = normalized(Quat{normal(random), normal(random), normal(random), normal(random)});
    move.frames.push_back({time, {{anything(), anything(), anything()}, q}});
    time += std::abs(normal(random));
  }
  move.frames[5].pose = {{-0.0, std::numeric_limits<double>::denorm_min(), 1e9}, {-1, -0.0, 0, 0}};
  path.moves = {move, {"", {"b\n\t"}, {{}}}};
  path.removed = {"c\\"};

  const ScratchFolder folder;
  ASSERT_TRUE(write_path(folder / "a.path.json", path).ok());
  const auto again = read_path(folder / "a.path.json");
  ASSERT_TRUE(again.ok()) << message_of(again);
  EXPECT_EQ(*again, path);
  EXPECT_TRUE(std::signbit(again->moves[0].frames[5].pose.position.x));
  EXPECT_TRUE(std::signbit(again->moves[0].frames[5].pose.rotation.x));
  EXPECT_EQ(path_text(*again), path_text(path));
}

/// A file of version 1, which measured depth between triangles.
constexpr const char* kVersion1 = R"({
  "format": "dismantle-path", "version": 1,
  "assembly": {"file": "vice.step", "sha256": "00ff", "components": ["base", "jaw", "screw"]},
  "tolerance_mm": 0.01,
  "pairs": [{"a": "jaw", "b": "screw", "state": "fit", "allowed_penetration_mm": 0.031},
            {"a": "jaw", "b": "base", "state": "embedded", "allowed_penetration_mm": null}],
  "moves": []
})";

TEST(PathFile, ReadsVersionOneWithoutItsPairs) {
  const auto path = parse(kVersion1);
  ASSERT_TRUE(path.ok()) << message_of(path);
  EXPECT_EQ(path->version, 1);
  EXPECT_EQ(path->tolerance, 0.01);
  EXPECT_TRUE(path->pairs.empty());
  const auto again = parse(path_text(*path));
  ASSERT_TRUE(again.ok()) << message_of(again);
  EXPECT_EQ(*again, *path);

  const auto replaced = [](const std::string& from, const std::string& to) {
    std::string text = kVersion1;
    return parse(text.replace(text.find(from), from.size(), to));
  };
  expect_unreadable(replaced("\"fit\"", "\"overlapping\""), "is neither \"fit\" nor \"embedded\")");
  expect_unreadable(replaced("\"jaw\", \"b\"", "\"lever\", \"b\""), "\"lever\" is not in assembly.components");
}

TEST(PathFile, KeepsTheOrderOfTheFormat) {
  const std::string text = path_text(*parse(kExample));
  std::size_t at = 0;
  for (const char* key :
       {"\"format\"",           "\"version\"",  "\"assembly\"", "\"file\"",       "\"sha256\"", "\"components\"",
        "\"tolerance_mm\"",     "\"pairs\"",    "\"a\"",        "\"b\"",          "\"state\"",  "\"initial_depth_mm\"",
        "\"allowed_depth_mm\"", "\"moves\"",    "\"label\"",    "\"components\"", "\"frames\"", "\"t\"",
        "\"position\"",         "\"rotation\"", "\"removed\""}) {
    at = text.find(key, at);
    ASSERT_NE(at, std::string::npos) << key << " in " << text;
  }
}

TEST(PathFile, ScalesQuaternionsToUnitLength) {
  const auto path = parse(with("/moves/0/frames/1/rotation", "[0.6000005, 0, 0.8, 0]"));
  ASSERT_TRUE(path.ok()) << message_of(path);
  const Quat q = path->moves[0].frames[1].pose.rotation;
  EXPECT_NEAR(dot(q, q), 1, 1e-15);
}

TEST(PathFile, AllowsOptionalMembersToBeAbsent) {
  EXPECT_TRUE(parse(without("", "pairs")).ok());
  EXPECT_TRUE(parse(without("", "removed")).ok());
  EXPECT_TRUE(parse(without("/moves/0", "label")).ok());
  EXPECT_TRUE(parse(with("/made_by", "\"another program\"")).ok());
}

TEST(PathFile, SaysWhatIsWrongAndWhere) {
  const std::pair<const char*, std::pair<const char*, const char*>> kCases[] = {
      {"/format", {"\"dismantle-motion\"", "(format: not \"dismantle-path\")"}},
      {"/version", {"3", "(version: not 1 to 2"}},
      {"/version", {"0", "(version: not 1 to 2"}},
      {"/version", {"\"2\"", "(version: not 1 to 2"}},
      {"/assembly", {"[]", "(assembly: not an object)"}},
      {"/assembly/components", {"[]", "(assembly.components: no component)"}},
      {"/assembly/components", {"[\"a\", \"a\"]", "(assembly.components[1]: \"a\" is there twice)"}},
      {"/assembly/sha256", {"7", "(assembly.sha256: not a text)"}},
      {"/tolerance_mm", {"-1", "(tolerance_mm: negative)"}},
      {"/tolerance_mm", {"null", "(tolerance_mm: not a number)"}},
      {"/tolerance_mm", {"1e200", "(tolerance_mm: beyond 1e9)"}},
      {"/pairs", {"{}", "(pairs: not an array)"}},
      {"/pairs/0/a", {"\"lever\"", "(pairs[0].a: \"lever\" is not in assembly.components)"}},
      {"/pairs/0/b", {"\"jaw\"", "(pairs[0].b: the same component as a)"}},
      {"/pairs/0/state",
       {"\"clear\"", "(pairs[0].state: \"clear\" is none of \"overlapping\", \"declared\" and \"free\")"}},
      {"/pairs/0/state", {"\"fit\"", "(pairs[0].state: \"fit\" is none of"}},
      {"/pairs/0/state", {"7", "(pairs[0].state: not a text)"}},
      {"/pairs/0/initial_depth_mm", {"-0.1", "(pairs[0].initial_depth_mm: negative)"}},
      {"/pairs/0/initial_depth_mm", {"null", "(pairs[0].initial_depth_mm: not a number)"}},
      {"/pairs/0/allowed_depth_mm", {"null", "(pairs[0].allowed_depth_mm: not a number)"}},
      {"/pairs/0/allowed_depth_mm", {"-1", "(pairs[0].allowed_depth_mm: negative)"}},
      {"/pairs/1/allowed_depth_mm", {"1", "(pairs[1].allowed_depth_mm: not null, though the pair is free)"}},
      {"/pairs/2/allowed_depth_mm", {"\"2\"", "(pairs[2].allowed_depth_mm: not a number)"}},
      {"/moves", {"7", "(moves: not an array)"}},
      {"/moves/0", {"7", "(moves[0]: not an object)"}},
      {"/moves/0/label", {"7", "(moves[0].label: not a text)"}},
      {"/moves/0/components", {"[\"lever\"]", "(moves[0].components[0]: \"lever\" is not in"}},
      {"/moves/0/components", {"[]", "(moves[0].components: no component)"}},
      {"/moves/0/frames", {"[]", "(moves[0].frames: no frame)"}},
      {"/moves/0/frames/0/t", {"1", "(moves[0].frames[0].t: the first is not 0)"}},
      {"/moves/0/frames/1/t", {"-1", "(moves[0].frames[1].t: before the one"}},
      {"/moves/0/frames/1/position", {"[1, 2]", "(moves[0].frames[1].position: not three numbers)"}},
      {"/moves/0/frames/1/position", {"[1, 2, \"3\"]", "(moves[0].frames[1].position[2]: not a number)"}},
      {"/moves/0/frames/1/rotation", {"[1, 0, 0]", "(moves[0].frames[1].rotation: not four numbers)"}},
      {"/moves/0/frames/1/rotation", {"[1, 0, 0.01, 0]", "(moves[0].frames[1].rotation: not a quaternion of unit"}},
      {"/moves/0/frames/1/rotation", {"[0, 0, 0, 0]", "(moves[0].frames[1].rotation: not a quaternion of unit"}},
      {"/removed", {"[\"lever\"]", "(removed[0]: \"lever\" is not in"}},
  };
  for (const auto& [pointer, wrong] : kCases) expect_unreadable(parse(with(pointer, wrong.first)), wrong.second);
  expect_unreadable(parse(without("", "moves")), "(moves: missing)");
  expect_unreadable(parse(without("/pairs/0", "state")), "(pairs[0].state: missing)");
  expect_unreadable(parse(without("/pairs/0", "initial_depth_mm")), "(pairs[0].initial_depth_mm: missing)");
  expect_unreadable(parse(without("/pairs/0", "allowed_depth_mm")), "(pairs[0].allowed_depth_mm: missing)");
  expect_unreadable(parse(without("/moves/0/frames/1", "t")), "(moves[0].frames[1].t: missing)");
  expect_unreadable(parse("[]"), "(the document: not an object)");
}

TEST(PathFile, ReportsThePositionOfASyntaxError) {
  expect_unreadable(parse(""), "line 1, column 1: no well-formed JSON");
  expect_unreadable(parse("{\n \"format\": nan}"), "line 2, column 13: no well-formed JSON");
  expect_unreadable(parse("{\"tolerance_mm\": 1e999}"), "a number is too large");
  expect_unreadable(parse("{\"format\": \"\xff\"}"), "no well-formed JSON");
  expect_unreadable(parse(std::string(kExample).substr(0, 300)), "no well-formed JSON");
  expect_unreadable(parse(std::string(1'000'000, '[')), "no well-formed JSON");
  expect_unreadable(parse(std::string(1'000'000, '[') + std::string(1'000'000, ']')), "the document: not an object");
}

TEST(PathFile, KnowsWhetherItFitsAnAssembly) {
  const auto box = [](const char* name) { return scenes::component(name, scenes::box({0, 0, 0}, {1, 1, 1})); };
  const auto path = parse(kExample);
  EXPECT_TRUE(check_names(*path, scenes::assembly({box("screw"), box("base"), box("jaw"), box("more")})).ok());
  expect_unreadable(check_names(*path, scenes::assembly({box("screw"), box("base")})), "it names \"jaw\"");
}

}  // namespace dismantle
