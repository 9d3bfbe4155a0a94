// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/mesh/read_stl.h"

#include "dismantle/files/byte_order.h"
#include "tests/support/parse_expectations.h"

#include <limits>

namespace dismantle {

namespace {

Result<std::vector<MeshPart>> parse(std::string_view bytes, const ImportOptions& options = {}) {
  return parse_stl({bytes, "part.stl"}, options);
}

/// A binary STL with that header and `count` triangles whose first coordinate is `x`.
std::string binary(std::string header, std::uint32_t count, float x = 0) {
  header.resize(80, header.empty() ? '\0' : ' ');
  const auto bytes = little_endian_bytes(count);
  header.append(bytes.data(), bytes.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    for (const float value : {0.f, 0.f, 1.f, x, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, static_cast<float>(i)}) {
      const auto number = little_endian_bytes(value);
      header.append(number.data(), number.size());
    }
    header.append(2, '\0');
  }
  return header;
}

std::string facet(const std::string& a = "0 0 0") {
  return "facet normal 0 0 1\n outer loop\n  vertex " + a + "\n  vertex 1 0 0\n  vertex 0 1 0\n endloop\nendfacet\n";
}

}  // namespace

TEST(ReadStl, ReadsBinary) {
  const auto parts = parse(binary("", 2));
  ASSERT_TRUE(parts.ok());
  ASSERT_EQ(parts->size(), 1u);
  EXPECT_EQ((*parts)[0].name, "");
  EXPECT_EQ((*parts)[0].mesh.faces.size(), 2u);
  EXPECT_EQ((*parts)[0].mesh.triangle(1), (Triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}}));
}

TEST(ReadStl, IsNotFooledByABinaryHeaderThatBeginsWithSolid) {
  const auto exact = parse(binary("solid facet normal", 3));
  ASSERT_TRUE(exact.ok());
  EXPECT_EQ((*exact)[0].mesh.faces.size(), 3u);
  const auto padded = parse(binary("solid part", 3) + "padding");
  ASSERT_TRUE(padded.ok()) << message_of(padded);
  EXPECT_EQ((*padded)[0].mesh.faces.size(), 3u);
}

TEST(ReadStl, MakesAPartOfEachAsciiSolid) {
  const auto parts =
      parse("solid left arm\n" + facet() + facet() + "endsolid left arm\nsolid empty\nendsolid\n\nsolid\n" +
            facet("-1e-1 +2 3.5E0") + "endsolid");
  ASSERT_TRUE(parts.ok()) << message_of(parts);
  ASSERT_EQ(parts->size(), 2u);
  EXPECT_EQ((*parts)[0].name, "left arm");
  EXPECT_EQ((*parts)[0].mesh.faces.size(), 2u);
  EXPECT_EQ((*parts)[1].name, "");
  EXPECT_EQ((*parts)[1].mesh.vertices[0], (Vec3{-0.1, 2, 3.5}));
}

TEST(ReadStl, ReadsAsciiInCapitalsWithForeignLineEndsAndWrongNormals) {
  const auto parts = parse(
      "SOLID A\r\nFACET NORMAL nan nan nan\r\nOUTER LOOP\r\nVERTEX 0 0 0\r\nVERTEX 1 0 0\r\nVERTEX 0 1 0\r\nENDLOOP\r\n"
      "ENDFACET\r\nENDSOLID A\r\n");
  ASSERT_TRUE(parts.ok()) << message_of(parts);
  EXPECT_EQ((*parts)[0].name, "A");
  EXPECT_EQ((*parts)[0].mesh.faces.size(), 1u);
}

TEST(ReadStl, SaysWhatIsWrongAndWhere) {
  expect_unreadable(parse("solid a\n" + facet("0 0 inf") + "endsolid"), "line 4: coordinate \"inf\"");
  expect_unreadable(parse("solid a\n" + facet()), "it ends within a solid");
  expect_unreadable(parse("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0"), "coordinate \"\"");
  expect_unreadable(parse("solid a\nfacet normal 0 0 1\nouter"), "it ends within a facet");
  expect_unreadable(parse("solid a\nvertex 1 2 3"), "line 2: \"vertex\" where a facet should begin");
  expect_unreadable(parse("solid a\nendsolid\ntrailing"), "line 3: \"trailing\" where a solid should begin");
  expect_unreadable(parse("short"), "it ends within the header");
  expect_unreadable(parse(binary("", 5).substr(0, 84 + 4 * 50 + 49)), "it claims 5 triangles and ends after 4");
  expect_unreadable(parse(binary("", 2, std::numeric_limits<float>::quiet_NaN())), "triangle 1: a coordinate");
}

TEST(ReadStl, AllocatesNothingForTrianglesThatAreMissing) {
  std::string bytes = binary("", 1);
  bytes.replace(80, 4, "\xff\xff\xff\xff");
  expect_unreadable(parse(bytes), "it claims 4294967295 triangles and ends after 1");
}

TEST(ReadStl, KeepsTheLimits) {
  ImportOptions options;
  options.limits.triangles = 1;
  expect_unreadable(parse(binary("", 2), options), "more than 1 triangles");
  expect_unreadable(parse("solid a\n" + facet() + facet() + "endsolid", options), "more than 1 triangles");
  options.limits.components = 1;
  expect_unreadable(parse("solid a\n" + facet() + "endsolid\nsolid b\n", options), "more than 1 solids");
}

}  // namespace dismantle
