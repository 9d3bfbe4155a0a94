// SPDX-License-Identifier: Apache-2.0
#include "dismantle/geometry/half_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

namespace dismantle {
namespace {

auto key(const HalfEdge& edge) {
  return std::tuple{edge.low, edge.high, edge.face, edge.side, edge.forward};
}

TEST(HalfEdges, AreThoseOfAllFacesInOrder) {
  std::mt19937 random(5);
  for (const std::uint32_t vertices : {1u, 3u, 40u, 4000u}) {
    std::vector<Face> faces(300);
    for (Face& face : faces)
      for (std::uint32_t& v : face.v) v = static_cast<std::uint32_t>(random() % vertices);  // some are degenerate
    std::vector<decltype(key({}))> expected, found;
    for (std::uint32_t f = 0; f < faces.size(); ++f)
      for (std::uint8_t side = 0; side < 3; ++side) {
        const std::uint32_t a = faces[f].v[side], b = faces[f].v[(side + 1) % 3];
        expected.push_back(key({std::min(a, b), std::max(a, b), f, side, a < b}));
      }
    std::sort(expected.begin(), expected.end());
    for (const HalfEdge& edge : sorted_half_edges(faces)) found.push_back(key(edge));
    EXPECT_EQ(found, expected);
  }
  EXPECT_TRUE(sorted_half_edges(std::vector<Face>{}).empty());
}

}  // namespace
}  // namespace dismantle
