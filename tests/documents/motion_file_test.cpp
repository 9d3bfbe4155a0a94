// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/motion_file.h"

#include "tests/support/meshes.h"
#include "tests/support/parse_expectations.h"
#include "tests/support/scratch_folder.h"

namespace dismantle {

namespace {

// The example of docs/formats.md.
const std::string kExample = R"({
  "format": "dismantle-motion", "version": 1,
  "response": "slide",
  "moves": [
    {"components": ["screw"],
     "targets": [{"t": 0.0, "position": [0,0,0], "rotation": [1,0,0,0]},
                 {"t": 0.01, "position": [0.3,0,1], "rotation": [1,0,0,0]}]}
  ]
})";

Result<Motion> parse(const std::string& text) {
  return parse_motion(text, "a.motion.json");
}

std::string replaced(const std::string& old_text, const std::string& new_text) {
  std::string text = kExample;
  return text.replace(text.find(old_text), old_text.size(), new_text);
}

}  // namespace

TEST(MotionFile, ReadsTheExampleOfTheFormat) {
  const auto motion = parse(kExample);
  ASSERT_TRUE(motion.ok()) << message_of(motion);
  EXPECT_EQ(motion->response, ResponseKind::Slide);
  ASSERT_EQ(motion->moves.size(), 1u);
  EXPECT_EQ(motion->moves[0].components, (std::vector<std::string>{"screw"}));
  EXPECT_EQ(motion->moves[0].targets[1], (Frame{0.01, {{0.3, 0, 1}, {}}}));
}

TEST(MotionFile, KnowsEveryResponse) {
  EXPECT_EQ(parse(replaced("slide", "stop"))->response, ResponseKind::Stop);
  EXPECT_EQ(parse(replaced("slide", "touch"))->response, ResponseKind::Touch);
  EXPECT_EQ(parse(replaced("\"response\": \"slide\",", ""))->response, ResponseKind::Slide);
}

TEST(MotionFile, WritesWhatItReads) {
  const ScratchFolder folder;
  Motion motion = *parse(kExample);
  motion.response = ResponseKind::Touch;
  motion.moves.push_back({{"a", "b"}, {{0, {{1.0 / 3, -0.0, 1e-300}, normalized(Quat{1, 2, 3, 4})}}}});
  ASSERT_TRUE(write_motion(folder / "a.motion.json", motion).ok());
  const auto again = read_motion(folder / "a.motion.json");
  ASSERT_TRUE(again.ok()) << message_of(again);
  EXPECT_EQ(*again, motion);
  EXPECT_EQ(motion_text(*again), motion_text(motion));
}

TEST(MotionFile, SaysWhatIsWrongAndWhere) {
  expect_unreadable(parse(replaced("dismantle-motion", "dismantle-path")), "(format: not \"dismantle-motion\")");
  expect_unreadable(parse(replaced("slide", "bounce")), "(response: \"bounce\" is none of");
  expect_unreadable(parse(replaced("\"slide\"", "1")), "(response: not a text)");
  expect_unreadable(parse(replaced("0.01", "1e999")), "a number is too large");
  expect_unreadable(parse(replaced("0.01", "-0.01")), "(moves[0].targets[1].t: before");
  expect_unreadable(parse(replaced("[0.3,0,1]", "[0.3,0]")), "(moves[0].targets[1].position: not three numbers)");
  expect_unreadable(parse(replaced("\"targets\"", "\"frames\"")), "(moves[0].targets: missing)");
  expect_unreadable(parse(replaced("[\"screw\"]", "\"screw\"")), "(moves[0].components: not an array)");
  const ScratchFolder folder;
  expect_unreadable(read_motion(folder / "missing.motion.json"), "No such file");
}

TEST(MotionFile, KnowsWhetherItFitsAnAssembly) {
  const auto box = [](const char* name) { return scenes::component(name, scenes::box({0, 0, 0}, {1, 1, 1})); };
  const auto motion = parse(kExample);
  EXPECT_TRUE(check_names(*motion, scenes::assembly({box("base"), box("screw")})).ok());
  expect_unreadable(check_names(*motion, scenes::assembly({box("base")})), "moves[0].components: \"screw\" is not");
}

}  // namespace dismantle
