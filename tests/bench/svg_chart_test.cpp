// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/svg_chart.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(SvgChart, PutsAPointWhereItsLogarithmsAre) {
  // The plot's ground: 70 to 570 px and 364 down to 40 px.
  const std::string svg = svg_of(LineChart{"t", "x", "y", {{"s", {10, 100, 1000}, {0.1, 1, 10}}}});
  EXPECT_EQ(count_of(svg, "<circle"), 3u);
  EXPECT_NE(svg.find("points=\"70.0,364.0 320.0,202.0 570.0,40.0 \""), std::string::npos) << svg;
  EXPECT_EQ(svg.rfind("</svg>\n"), svg.size() - 7);
}

TEST(SvgChart, DrawsBarsUpwardsFromOneAndDownwardsBelowIt) {
  const std::string svg = svg_of(BarChart{"t", "y", {"g", "h"}, {{"up", {}, {10, 100}}, {"down", {}, {0.1, 1}}}});
  // Three decades from 0.1 to 100 over 324 px: one is at 256.
  EXPECT_EQ(count_of(svg, "y=\"148.0\" width"), 1u) << "from 1 up to 10";
  EXPECT_EQ(count_of(svg, "y=\"40.0\" width"), 1u) << "from 1 up to 100";
  EXPECT_EQ(count_of(svg, "y=\"256.0\" width"), 2u) << "from 1 down";
  EXPECT_EQ(count_of(svg, "height=\"108.0\""), 2u);
  EXPECT_EQ(count_of(svg, "height=\"0.0\""), 1u);
}

}  // namespace
}  // namespace dismantle
