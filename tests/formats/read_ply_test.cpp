// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/mesh/read_ply.h"

#include "dismantle/files/byte_order.h"
#include "tests/support/parse_expectations.h"

#include <algorithm>

namespace dismantle {

namespace {

Result<MeshPart> parse(std::string_view bytes, const ImportOptions& options = {}) {
  return parse_ply({bytes, "part.ply"}, options);
}

std::string header(const std::string& format, const std::string& elements) {
  return "ply\nformat " + format + " 1.0\ncomment made by hand\n" + elements + "end_header\n";
}

constexpr const char* kPlain =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\n";
constexpr const char* kSquareBody = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

/// Appends a number's bytes, big-endian if `big`.
template <class T>
void put(std::string& bytes, T value, bool big) {
  auto number = little_endian_bytes(value);
  if (big) std::reverse(number.begin(), number.end());
  bytes.append(number.data(), number.size());
}

}  // namespace

TEST(ReadPly, ReadsAscii) {
  const auto part = parse(header("ascii", kPlain) + kSquareBody);
  ASSERT_TRUE(part.ok()) << message_of(part);
  EXPECT_EQ(part->mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(part->mesh.faces.size(), 2u);
}

TEST(ReadPly, ReadsWindowsLineEnds) {
  std::string text = header("ascii", kPlain) + kSquareBody;
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2)) text.insert(at, "\r");
  ASSERT_TRUE(parse(text).ok());
}

// Elements before, between and after those needed; lists and numbers of every type beside those needed; coordinates in
// another order and of other types.
TEST(ReadPly, SkipsOtherElementsAndPropertiesInBothByteOrders) {
  const std::string elements =
      "element camera 1\nproperty double focal\nproperty list ushort short shift\n"
      "element vertex 3\nproperty uchar red\nproperty double z\nproperty list uint int8 tags\nproperty short x\n"
      "property int32 y\n"
      "element nothing 4000000000\n"
      "element face 1\nproperty uint16 flags\nproperty list uint8 uint vertex_index\nproperty float quality\n"
      "element edge 1\nproperty int vertex1\nproperty int vertex2\n";
  for (const bool big : {false, true}) {
    std::string bytes = header(big ? "binary_big_endian" : "binary_little_endian", elements);
    put(bytes, 35.0, big);
    put<std::uint16_t>(bytes, 2, big);
    put<std::int16_t>(bytes, -1, big);
    put<std::int16_t>(bytes, 1, big);
    for (std::int16_t i = 0; i < 3; ++i) {
      put<std::uint8_t>(bytes, 200, big);
      put(bytes, 0.1 * i, big);
      put<std::uint32_t>(bytes, 1, big);
      put<std::int8_t>(bytes, 7, big);
      put<std::int16_t>(bytes, static_cast<std::int16_t>(-i), big);
      put<std::int32_t>(bytes, 100000 * i * i, big);
    }
    put<std::uint16_t>(bytes, 0, big);
    put<std::uint8_t>(bytes, 3, big);
    for (const std::uint32_t v : {2u, 1u, 0u}) put(bytes, v, big);
    put(bytes, 0.5f, big);
    put<std::int32_t>(bytes, 0, big);
    put<std::int32_t>(bytes, 1, big);

    const auto part = parse(bytes);
    ASSERT_TRUE(part.ok()) << message_of(part);
    EXPECT_EQ(part->mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {-1, 100000, 0.1}, {-2, 400000, 0.2}}));
    EXPECT_EQ(part->mesh.faces, (std::vector<Face>{{{2, 1, 0}}}));
    expect_unreadable(parse(std::string_view(bytes).substr(0, bytes.size() - 1)), "the file ends here");
  }
}

TEST(ReadPly, AllocatesNothingForRowsThatAreMissing) {
  const std::string rows = "property float x\nproperty float y\nproperty float z\n";
  for (const char* format : {"ascii", "binary_little_endian"}) {
    expect_unreadable(parse(header(format, "element vertex 4000000000\n" + rows) + "0 0 0"),
                      "it claims 4000000000 rows of \"vertex\" in 5 bytes");
    expect_unreadable(parse(header(format, "element vertex 9223372036854775807\n" + rows) + "0 0 0"),
                      "it claims 9223372036854775807 rows");
  }
  const std::string list = "element face 1\nproperty list uint int vertex_indices\n";
  std::string bytes = header("binary_little_endian", list);
  put<std::uint32_t>(bytes, 0xfffffff0u, false);
  expect_unreadable(parse(bytes), "face 0: the file ends here, or its number of corners makes no sense");
  expect_unreadable(parse(header("ascii", list) + "4000000000 1 2 3\n"), "face 0");
  expect_unreadable(parse(header("ascii", list) + "-1 1 2 3\n"), "face 0");
}

TEST(ReadPly, SaysWhatIsWrongInTheHeader) {
  expect_unreadable(parse("plyx\n"), "it does not begin with \"ply\"");
  expect_unreadable(parse("ply\nformat ascii 1.0\n"), "its header does not end");
  expect_unreadable(parse("ply\nend_header\n"), "line 2: the header names no format");
  expect_unreadable(parse(header("utf8", "")), "line 2: unknown format \"utf8\"");
  expect_unreadable(parse(header("ascii", "property float x\n")), "a property before the first element");
  expect_unreadable(parse(header("ascii", "element vertex -1\n")), "line 4: \"-1\" is no number of elements");
  expect_unreadable(parse(header("ascii", "element vertex 1\nproperty quad x\n")), "line 5: unknown type \"quad\"");
  expect_unreadable(parse(header("ascii", "element face 1\nproperty list float int vertex_indices\n")),
                    "\"float\" is no type of a list's length");
  expect_unreadable(parse(header("ascii", "element vertex 1\nproperty float x\nproperty float y\n") + "0 0\n"),
                    "its vertices have no coordinate z");
  expect_unreadable(parse(header("ascii", "element face 1\nproperty list uchar float vertex_indices\n") + "1 0\n"),
                    "no lists of integers");
  expect_unreadable(parse(header("ascii", "colour red\n")), "unknown statement \"colour\"");
}

TEST(ReadPly, SaysWhatIsWrongInTheBody) {
  const std::string head = header("ascii", kPlain);
  expect_unreadable(parse(head + "0 0 0\n1 0 nan\n1 1 0\n0 1 0\n4 0 1 2 3\n"), "vertex 1: a coordinate");
  expect_unreadable(parse(head + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 4\n"), "polygon 0 names vertex 4 of 4");
  expect_unreadable(parse(head + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 -1\n"), "face 0: a corner is no vertex index");
  expect_unreadable(parse(head + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1"), "face 0: the file ends here");
  expect_unreadable(parse(head + "0 0 0\n1 0 0\n1 1 0\n0 1 0 4 0 1.5 2 3"), "face 0");
}

TEST(ReadPly, KeepsTheLimits) {
  ImportOptions options;
  options.limits.triangles = 1;
  expect_unreadable(parse(header("ascii", kPlain) + kSquareBody, options), "more than 1 triangles");
}

}  // namespace dismantle
