// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/lower_envelope.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace dismantle {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The lowest of all segments over x; infinite where there are none.
double lowest(const std::vector<GraphSegment>& segments, double x) {
  double y = kInfinite;
  for (const GraphSegment& s : segments)
    if (x >= s.x0 && x <= s.x1) y = std::min(y, s.at(x));
  return y;
}

TEST(LowerEnvelope, OfNothingIsNothing) {
  EXPECT_TRUE(lower_envelope({}).empty());
}

TEST(LowerEnvelope, IsCutWhereTwoSegmentsCross) {
  //   \   /
  //    \ /     the lower sides of an X
  //     X
  //    / \.
  const std::vector<GraphSegment> crossing{{0, 0, 4, 4}, {0, 2, 4, 0}};
  const std::vector<GraphSegment> envelope = lower_envelope(crossing);
  ASSERT_EQ(envelope.size(), 2u);
  EXPECT_EQ(envelope[0].x0, 0);
  EXPECT_NEAR(envelope[0].x1, 4.0 / 3, 1e-15);
  EXPECT_EQ(envelope[0].x1, envelope[1].x0);
  EXPECT_EQ(envelope[1], (GraphSegment{envelope[0].x1, envelope[1].y0, 4, 0}));
}

TEST(LowerEnvelope, LeavesGapsAndJumpsWhereTheyAre) {
  const std::vector<GraphSegment> segments{{5, 1, 6, 1}, {0, 3, 4, 3}, {1, 2, 2, 2}, {2, 2, 3, 2}};
  const std::vector<GraphSegment> expected{{0, 3, 1, 3}, {1, 2, 2, 2}, {2, 2, 3, 2}, {3, 3, 4, 3}, {5, 1, 6, 1}};
  EXPECT_EQ(lower_envelope(segments), expected);
}

TEST(LowerEnvelope, IsTheLowestOfRandomSegments) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> u(0, 1);
  for (int round = 0; round < 300; ++round) {
    // Few different ends and heights, so that ends meet and segments coincide; widths down to nearly nothing.
    const bool coarse = round % 2 == 0;
    const auto coordinate = [&] { return coarse ? std::floor(8 * u(random)) : 8 * u(random); };
    std::vector<GraphSegment> segments;
    const auto count = 1 + random() % 60;
    while (segments.size() < count) {
      const double x0 = coordinate();
      const double x1 = coarse ? coordinate() : x0 + 8 * std::pow(10, -5 * u(random));
      if (x0 < x1) segments.push_back({x0, coordinate(), x1, coordinate()});
    }
    const std::vector<GraphSegment> envelope = lower_envelope(segments);
    ASSERT_FALSE(envelope.empty());
    for (std::size_t i = 0; i < envelope.size(); ++i) {
      EXPECT_LT(envelope[i].x0, envelope[i].x1);
      EXPECT_TRUE(i == 0 || envelope[i - 1].x1 <= envelope[i].x0);
      // Every part is the lowest there; ends count for the part that goes on.
      for (const double share : {0.01, 0.3, 0.5, 0.77, 0.99}) {
        const double x = envelope[i].x0 + share * (envelope[i].x1 - envelope[i].x0);
        EXPECT_NEAR(envelope[i].at(x), lowest(segments, x), 1e-8) << round;
      }
    }
    for (int k = 0; k < 200; ++k) {
      const double x = 9 * u(random) - 0.5;
      EXPECT_EQ(std::isfinite(lowest(envelope, x)), std::isfinite(lowest(segments, x)));
    }
  }
}

}  // namespace
}  // namespace dismantle
