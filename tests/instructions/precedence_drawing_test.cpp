// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/precedence_drawing.h"

#include "tests/instructions/bolted_lid.h"

#include <tinyxml2.h>

#include <random>

namespace dismantle {
namespace {

/// A random graph of `count` steps, each with up to three predecessors.
PrecedenceGraph random_graph(std::uint32_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  PrecedenceGraph graph;
  for (std::uint32_t k = 0; k < count; ++k) {
    graph.before.emplace_back();
    graph.ranks.push_back(0);
    for (std::uint32_t i = 0; k > 0 && i < random() % 4; ++i) {
      const auto j = static_cast<std::uint32_t>(random() % k);
      auto& before = graph.before.back();
      if (std::find(before.begin(), before.end(), j) != before.end()) continue;
      before.push_back(j);
      graph.ranks.back() = std::max(graph.ranks.back(), graph.ranks[j] + 1);
    }
  }
  return graph;
}

TEST(PrecedenceDrawing, PutsBoxesBesideEachOtherWithinItsBorders) {
  for (std::uint32_t seed = 1; seed < 20; ++seed) {
    const PrecedenceGraph graph = random_graph(25, seed);
    const PrecedenceDrawing drawing = draw_precedence(graph);
    for (std::size_t a = 0; a < drawing.boxes.size(); ++a) {
      const StepBox& p = drawing.boxes[a];
      EXPECT_TRUE(p.x >= 0 && p.y >= 0 && p.x + p.width <= drawing.width && p.y + p.height <= drawing.height) << seed;
      for (std::size_t b = 0; b < a; ++b) {
        const StepBox& q = drawing.boxes[b];
        EXPECT_TRUE(p.x + p.width < q.x || q.x + q.width < p.x || p.y + p.height < q.y || q.y + q.height < p.y) << seed;
      }
    }
  }
}

TEST(PrecedenceDrawing, LeadsEdgesFromLeftToRightBetweenTheBoxes) {
  for (std::uint32_t seed = 1; seed < 20; ++seed) {
    const PrecedenceGraph graph = random_graph(25, seed);
    const PrecedenceDrawing drawing = draw_precedence(graph);
    std::size_t edges = 0;
    for (const auto& before : graph.before) edges += before.size();
    ASSERT_EQ(drawing.edges.size(), edges);
    for (const PrecedenceDrawing::Edge& edge : drawing.edges) {
      ASSERT_EQ(edge.ys.size(), graph.ranks[edge.to] - graph.ranks[edge.from] + 1);
      for (std::size_t i = 1; i + 1 < edge.ys.size(); ++i)
        for (std::size_t k = 0; k < drawing.boxes.size(); ++k)
          EXPECT_TRUE(graph.ranks[k] != graph.ranks[edge.from] + i || edge.ys[i] < drawing.boxes[k].y ||
                      edge.ys[i] > drawing.boxes[k].y + drawing.boxes[k].height);
    }
  }
}

TEST(PrecedenceDrawing, KeepsChainsStraightAndUncrossed) {
  // Three chains side by side, their steps interleaved.
  PrecedenceGraph graph;
  for (std::uint32_t k = 0; k < 9; ++k) {
    graph.before.push_back(k < 3 ? std::vector<std::uint32_t>{} : std::vector<std::uint32_t>{k < 6 ? 5 - k : k - 3});
    graph.ranks.push_back(k / 3);
  }
  for (const PrecedenceDrawing::Edge& edge : draw_precedence(graph).edges) EXPECT_NEAR(edge.ys[0], edge.ys[1], 1e-6);
}

TEST(PrecedenceSvg, IsWellFormedAndHasABoxAStep) {
  Assembly a = scenes::bolted_lid();
  a.components[2].name = "<bolt> & \"nut\" of a length that no box has room for \xff";
  Plan plan;
  for (const std::uint32_t c : {2u, 3u, 1u})
    plan.steps.push_back({{ComponentId(c)}, PlanTier::Straight, PlanStep::kWhole, {}, {0, 0, 1}});
  const std::string svg = precedence_svg(a, plan, {{{}, {}, {0, 1}}, {0, 0, 1}});
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(svg.data(), svg.size()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
  std::size_t boxes = 0, paths = 0;
  for (const auto* e = document.RootElement()->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    boxes += std::string(e->Name()) == "g";
    paths += std::string(e->Name()) == "path";
  }
  EXPECT_EQ(boxes, 3u);
  EXPECT_EQ(paths, 2u);
}

}  // namespace
}  // namespace dismantle
