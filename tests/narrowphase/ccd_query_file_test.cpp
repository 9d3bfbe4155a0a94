// SPDX-License-Identifier: Apache-2.0
#include "bench/ccd_query_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <limits>
#include <string>

namespace dismantle {
namespace {

/// A query set of `count` queries whose coordinates are 0, 1, 2, ... and whose truth is all `truth`.
std::string query_set(std::uint32_t count, std::uint32_t type, char truth) {
  std::string bytes("CCDQ1\0\0\0", 8);
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  bytes.append(reinterpret_cast<const char*>(&type), 4);
  bytes.append(16, '\0');
  for (std::uint32_t i = 0; i < count * 24; ++i) {
    const double x = i;
    bytes.append(reinterpret_cast<const char*>(&x), 8);
  }
  bytes.append(count, truth);
  return bytes;
}

Result<CcdQueryFile> read_bytes(const std::string& bytes) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) /
      (std::string("ccdq_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  std::ofstream(file, std::ios::binary) << bytes;
  Result<CcdQueryFile> queries = read_ccdq(file);
  std::filesystem::remove(file);
  return queries;
}

void expect_refused(const std::string& bytes, const std::string& why) {
  const auto queries = read_bytes(bytes);
  ASSERT_FALSE(queries.ok());
  EXPECT_EQ(queries.error().kind, ErrorKind::Unreadable);
  EXPECT_NE(queries.error().message.find(why), std::string::npos) << queries.error().message;
}

TEST(ReadCcdq, ReadsVertexFaceQueries) {
  const auto queries = read_bytes(query_set(2, 0, 1));
  ASSERT_TRUE(queries.ok()) << queries.error().message;
  ASSERT_EQ(queries->vertex_face.size(), 2u);
  EXPECT_TRUE(queries->edge_edge.empty());
  EXPECT_EQ(queries->truth, std::vector<CcdTruth>(2, CcdTruth::Hit));
  const VertexFaceMotion& m = queries->vertex_face[1];
  EXPECT_EQ(m.vertex_t0, (Vec3{24, 25, 26}));
  EXPECT_EQ(m.face_t0[2], (Vec3{33, 34, 35}));
  EXPECT_EQ(m.vertex_t1, (Vec3{36, 37, 38}));
  EXPECT_EQ(m.face_t1[0], (Vec3{39, 40, 41}));
}

TEST(ReadCcdq, ReadsEdgeEdgeQueries) {
  const auto queries = read_bytes(query_set(1, 1, 2));
  ASSERT_TRUE(queries.ok()) << queries.error().message;
  ASSERT_EQ(queries->edge_edge.size(), 1u);
  EXPECT_EQ(queries->truth[0], CcdTruth::Unknown);
  const EdgeEdgeMotion& m = queries->edge_edge[0];
  EXPECT_EQ(m.a_t0[1], (Vec3{3, 4, 5}));
  EXPECT_EQ(m.b_t0[0], (Vec3{6, 7, 8}));
  EXPECT_EQ(m.a_t1[0], (Vec3{12, 13, 14}));
  EXPECT_EQ(m.b_t1[1], (Vec3{21, 22, 23}));
}

TEST(ReadCcdq, ReadsAnEmptySet) {
  EXPECT_TRUE(read_bytes(query_set(0, 0, 0)).ok());
}

TEST(ReadCcdq, RefusesWhatIsNoQuerySet) {
  expect_refused("", "does not begin with CCDQ1");
  expect_refused("solid cube", "does not begin with CCDQ1");
  expect_refused(std::string(64, 'x'), "does not begin with CCDQ1");
  EXPECT_FALSE(read_ccdq("/no/such/file.ccdq").ok());
}

TEST(ReadCcdq, RefusesAWrongLengthBeforeItBelievesTheCount) {
  std::string bytes = query_set(3, 0, 0);
  expect_refused(bytes.substr(0, bytes.size() - 1), "3 queries need");
  expect_refused(bytes + "x", "3 queries need");
  const std::uint32_t huge = 0xffffffffu;
  std::memcpy(bytes.data() + 8, &huge, 4);
  expect_refused(bytes, "4294967295 queries need");
}

TEST(ReadCcdq, RefusesAnUnknownTypeAndAnUnknownTruth) {
  expect_refused(query_set(1, 2, 0), "unknown query type 2");
  expect_refused(query_set(1, 0, 3), "truth");
}

TEST(ReadCcdq, RefusesACoordinateThatIsNotFinite) {
  std::string bytes = query_set(2, 1, 0);
  const double bad = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(bytes.data() + 32 + 8 * 30, &bad, 8);
  expect_refused(bytes, "query 1 has a coordinate that is not finite");
}

TEST(ReadCcdq, RefusesANewerHeader) {
  std::string bytes = query_set(1, 0, 0);
  bytes[20] = 1;
  expect_refused(bytes, "reserved");
}

}  // namespace
}  // namespace dismantle
