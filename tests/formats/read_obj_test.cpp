// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/mesh/read_obj.h"

#include "tests/support/parse_expectations.h"

namespace dismantle {

namespace {

Result<ObjModel> parse(std::string_view text, const ImportOptions& options = {}) {
  return parse_obj({text, "part.obj"}, options);
}

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST(ReadObj, ReadsEveryFormOfACorner) {
  for (const char* face :
       {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/3/1", "f -4 -3 -2",
        "f -4/-1/-1 -3/-1/-1 -2/-1/-1", "  f\t1  2 3  # a comment", "f 1 \\\n 2 \\\r\n 3", "f +1 2 3"}) {
    const auto model = parse(std::string(kSquare) + face + "\r\n");
    ASSERT_TRUE(model.ok()) << face << ": " << message_of(model);
    ASSERT_EQ(model->parts.size(), 1u) << face;
    EXPECT_EQ(model->parts[0].mesh.faces, (std::vector<Face>{{{0, 1, 2}}})) << face;
    EXPECT_EQ(model->parts[0].mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}})) << face;
  }
}

TEST(ReadObj, MakesAPartOfEachObject) {
  const auto model =
      parse(std::string("o  first part \n") + kSquare + "f 1 2 3\no empty\no second\ng ignored\nf 2 3 4\n");
  ASSERT_TRUE(model.ok());
  ASSERT_EQ(model->parts.size(), 2u);
  EXPECT_EQ(model->parts[0].name, "first part");
  EXPECT_EQ(model->parts[1].name, "second");
  EXPECT_EQ(model->parts[1].mesh.vertices, (std::vector<Vec3>{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(model->parts[1].mesh.faces, (std::vector<Face>{{{0, 1, 2}}}));
}

TEST(ReadObj, MakesAPartOfEachGroupIfThereIsNoObject) {
  const auto model = parse(std::string(kSquare) + "f 1 2 3\ng a\nf 2 3 4\ng b c\nf 3 4 1\ng a\nf 4 1 2\n");
  ASSERT_TRUE(model.ok());
  ASSERT_EQ(model->parts.size(), 4u);
  EXPECT_EQ(model->parts[0].name, "");
  EXPECT_EQ(model->parts[1].name, "a");
  EXPECT_EQ(model->parts[2].name, "b c");
  EXPECT_EQ(model->parts[3].name, "a");
}

TEST(ReadObj, KeepsTheVerticesInFileOrder) {
  const auto model = parse(std::string(kSquare) + "f 4 2 1\nf 4 3 2\n");
  ASSERT_TRUE(model.ok());
  EXPECT_EQ(model->parts[0].mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(model->parts[0].mesh.faces, (std::vector<Face>{{{3, 1, 0}}, {{3, 2, 1}}}));
}

TEST(ReadObj, TriangulatesPolygonsAndAllowsForwardReferences) {
  const auto model = parse(std::string("f 1 2 3 4\n") + kSquare);
  ASSERT_TRUE(model.ok());
  EXPECT_EQ(model->parts[0].mesh.faces.size(), 2u);
}

TEST(ReadObj, SkipsWhatItDoesNotNeed) {
  const auto model =
      parse(std::string("# c\nmtllib a b.mtl\n") + kSquare +
            "vt 0 nonsense\nvn 0 0 1\ns off\nl 1 2\np 1\ncurv 0 1 1 2\nv 5 5 5 1.0\nv 1 2 3 .5 .5 .5\nf 1 2 3\n");
  ASSERT_TRUE(model.ok());
  EXPECT_EQ(model->parts[0].mesh.vertices.size(), 3u);
  EXPECT_EQ(model->material_files, (std::vector<std::string>{"a b.mtl"}));
}

TEST(ReadObj, ReadsTheMaterialOfAPart) {
  const auto model = parse(std::string(kSquare) + "o a\nusemtl red\nf 1 2 3\nusemtl blue\nf 2 3 4\no b\nf 1 2 4\n");
  ASSERT_TRUE(model.ok());
  EXPECT_EQ(model->parts[0].material, "red");
  EXPECT_EQ(model->parts[1].material, "blue");
}

TEST(ReadObj, ReadsMaterialColours) {
  const auto colors = parse_mtl("Kd 1 1 1\nnewmtl red one\nKa 0 0 0\nKd 1 0.5 0\nd 0.25\nnewmtl odd\nKd x 2 -1\n");
  ASSERT_EQ(colors.size(), 2u);
  EXPECT_EQ(colors.at("red one"), (Color{1, 0.5f, 0, 0.25f}));
  EXPECT_EQ(colors.at("odd"), (Color{Color{}.r, 1, 0, 1}));
}

TEST(ReadObj, SaysWhatIsWrongAndWhere) {
  const std::string square = kSquare;
  expect_unreadable(parse("v 1 2\n"), "line 1: coordinate \"\" of a vertex");
  expect_unreadable(parse("v 1 2 nan\n"), "line 1: coordinate \"nan\" of a vertex is not a finite number");
  expect_unreadable(parse("\nv 1 1e999 3\n"), "line 2: coordinate \"1e999\"");
  expect_unreadable(parse("v 1,5 2 3\n"), "coordinate \"1,5\"");
  expect_unreadable(parse(square + "f 1 2 0\n"), "line 5: a face names vertex 0");
  expect_unreadable(parse(square + "f 1 2 -5\n"), "line 5: a face names vertex -5 of 4");
  expect_unreadable(parse(square + "f 1 2 5\nv 0 0\n"), "line 6: coordinate");
  expect_unreadable(parse(square + "f 1 2 5\nf 1 2 3\n"), "line 5: a face names vertex 5 of 4");
  expect_unreadable(parse(square + "f 1 2 4294967296\n"), "line 5: a face names vertex 4294967296");
  expect_unreadable(parse(square + "f 1 2 x\n"), "\"x\" is not a corner");
  expect_unreadable(parse(square + "f 1 2 3/a\n"), "\"3/a\" is not a corner");
  expect_unreadable(parse(square + "f\n"), "line 5: a face without corners");
}

TEST(ReadObj, KeepsTheLimits) {
  ImportOptions options;
  options.limits.triangles = 1;
  expect_unreadable(parse(std::string(kSquare) + "f 1 2 3 4\n", options), "more than 1 triangles");
  options.limits.triangles = 100;
  options.limits.components = 1;
  expect_unreadable(parse(std::string(kSquare) + "o a\nf 1 2 3\no b\nf 1 2 3\n", options), "more than 1 sections");
}

TEST(ReadObj, CanBeCancelled) {
  ImportOptions options;
  options.progress = [](std::string_view, double) { return false; };
  const auto model = parse(std::string(kSquare) + "f 1 2 3\n", options);
  ASSERT_FALSE(model.ok());
  EXPECT_EQ(model.error().kind, ErrorKind::Failed);
}

}  // namespace dismantle
