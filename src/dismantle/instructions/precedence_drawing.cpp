// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/precedence_drawing.h"

#include "dismantle/instructions/precedence_files.h"
#include "dismantle/report/html_text.h"

#include <algorithm>
#include <cstdio>
#include <numeric>

namespace dismantle {

namespace {

// All in pixels.
constexpr double kBoxWidth = 215, kBoxHeight = 30, kRankGap = 70, kNodeGap = 12, kDummyHeight = 6, kBorder = 20;
/// Number of ordering sweeps in each direction.
constexpr int kSweeps = 8;
/// Maximum number of characters in a box.
constexpr std::size_t kMaxCharacters = 20;

/// A node of the layout: a step, or a dummy node where an edge crosses a rank.
struct Node {
  std::uint32_t rank = 0;
  bool is_step = true;
  std::vector<std::size_t> left, right;  ///< Adjacent nodes in the previous and the next rank.
  double y = 0;                          ///< Of its centre.
  double height() const { return is_step ? kBoxHeight : kDummyHeight; }
};

/// Orders and positions the nodes.
class LayeredLayout {
 public:
  explicit LayeredLayout(const PrecedenceGraph& graph) {
    for (const std::uint32_t rank : graph.ranks) add(rank, true);
    for (std::uint32_t k = 0; k < graph.before.size(); ++k)
      for (const std::uint32_t j : graph.before[k]) add_edge(j, k);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      order(&Node::left);
      order(&Node::right);
    }
  }

  PrecedenceDrawing drawing(std::size_t step_count) const {
    PrecedenceDrawing drawing;
    double bottom = 0;
    for (const Node& node : nodes_) bottom = std::max(bottom, node.y + node.height() / 2);
    for (std::size_t rank = 0; rank < ranks_.size(); ++rank)
      drawing.centers.push_back(kBorder + kBoxWidth / 2 + static_cast<double>(rank) * (kBoxWidth + kRankGap));
    for (std::size_t k = 0; k < step_count; ++k)
      drawing.boxes.push_back({drawing.centers[nodes_[k].rank] - kBoxWidth / 2, kBorder + nodes_[k].y - kBoxHeight / 2,
                               kBoxWidth, kBoxHeight});
    for (const auto& [from, to, through] : edges_) {
      drawing.edges.push_back({from, to, {}});
      for (const std::size_t node : through) drawing.edges.back().ys.push_back(kBorder + nodes_[node].y);
    }
    const auto count = static_cast<double>(ranks_.size());
    drawing.width = 2 * kBorder + count * kBoxWidth + std::max(0.0, count - 1) * kRankGap;
    drawing.height = 2 * kBorder + bottom;
    return drawing;
  }

 private:
  struct Edge {
    std::uint32_t from = 0, to = 0;
    std::vector<std::size_t> through;
  };

  std::size_t add(std::uint32_t rank, bool is_step) {
    if (ranks_.size() <= rank) ranks_.resize(rank + 1);
    ranks_[rank].push_back(nodes_.size());
    nodes_.push_back({rank, is_step, {}, {}, 0});
    return nodes_.size() - 1;
  }

  void add_edge(std::uint32_t from, std::uint32_t to) {
    Edge edge{from, to, {from}};
    for (std::uint32_t rank = nodes_[from].rank + 1; rank < nodes_[to].rank; ++rank)
      edge.through.push_back(add(rank, false));
    edge.through.push_back(to);
    for (std::size_t i = 1; i < edge.through.size(); ++i) {
      nodes_[edge.through[i - 1]].right.push_back(edge.through[i]);
      nodes_[edge.through[i]].left.push_back(edge.through[i - 1]);
    }
    edges_.push_back(std::move(edge));
  }

  /// Orders the nodes of each rank by the mean position of their neighbours on one side.
  void order(std::vector<std::size_t> Node::*side) {
    for (std::vector<std::size_t>& rank : ranks_) {
      std::vector<std::pair<double, std::size_t>> wanted;
      for (const std::size_t p : rank) {
        const std::vector<std::size_t>& joined = nodes_[p].*side;
        double sum = 0;
        for (const std::size_t other : joined) sum += nodes_[other].y;
        wanted.emplace_back(joined.empty() ? nodes_[p].y : sum / static_cast<double>(joined.size()), p);
      }
      std::stable_sort(wanted.begin(), wanted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      for (std::size_t i = 0; i < wanted.size(); ++i) rank[i] = wanted[i].second;
      separate(rank, wanted);
    }
    if (side == &Node::left) return;
    double top = 0;
    for (const Node& node : nodes_) top = std::min(top, node.y - node.height() / 2);
    for (Node& node : nodes_) node.y -= top;
  }

  /// Positions the nodes of a rank, in order, near their wanted positions without overlap.
  void separate(const std::vector<std::size_t>& rank, const std::vector<std::pair<double, std::size_t>>& wanted) {
    double bottom = -1e300, excess = 0;
    for (std::size_t i = 0; i < rank.size(); ++i) {
      Node& node = nodes_[rank[i]];
      node.y = std::max(wanted[i].first, bottom + node.height() / 2);
      excess += node.y - wanted[i].first;
      bottom = node.y + node.height() / 2 + kNodeGap;
    }
    for (const std::size_t p : rank) nodes_[p].y -= excess / static_cast<double>(rank.size());
  }

  std::vector<Node> nodes_;                      // steps first, then dummy nodes
  std::vector<std::vector<std::size_t>> ranks_;  // top to bottom
  std::vector<Edge> edges_;
};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

/// At most kMaxCharacters characters of a UTF-8 text, then an ellipsis.
std::string shortened(const std::string& text) {
  std::size_t characters = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U) continue;
    if (++characters > kMaxCharacters) return text.substr(0, i) + "\u2026";
  }
  return text;
}

std::string edge_path(const PrecedenceDrawing& drawing, const PrecedenceDrawing::Edge& edge, std::uint32_t rank) {
  double x = drawing.centers[rank] + kBoxWidth / 2, y = edge.ys[0];
  std::string path = "M" + number(x) + " " + number(y);
  for (std::size_t i = 1; i < edge.ys.size(); ++i) {
    const double center = drawing.centers[rank + i], half = kBoxWidth / 2;
    const double next = center - half;
    path += " C" + number(x + kRankGap / 2) + " " + number(y) + " " + number(next - kRankGap / 2) + " " +
            number(edge.ys[i]) + " " + number(next) + " " + number(edge.ys[i]);
    x = center + half;
    y = edge.ys[i];
    if (i + 1 < edge.ys.size()) path += " L" + number(x) + " " + number(y);
  }
  return path;
}

std::string box_svg(const StepBox& box, std::uint32_t step, const std::string& name) {
  return "<g><title>" + html_escaped(name) + "</title><rect x=\"" + number(box.x) + "\" y=\"" + number(box.y) +
         "\" width=\"" + number(box.width) + "\" height=\"" + number(box.height) + "\" rx=\"4\"/><text x=\"" +
         number(box.x + 8) + "\" y=\"" + number(box.y + 20) + "\"><tspan class=\"n\">" + std::to_string(step + 1) +
         "</tspan> " + html_escaped(shortened(name)) + "</text></g>\n";
}

}  // namespace

PrecedenceDrawing draw_precedence(const PrecedenceGraph& graph) {
  return LayeredLayout(graph).drawing(graph.ranks.size());
}

std::string precedence_svg(const Assembly& assembly, const Plan& plan, const PrecedenceGraph& graph) {
  const PrecedenceDrawing drawing = draw_precedence(graph);
  const std::string width = number(drawing.width), height = number(drawing.height);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height +
                    "\" viewBox=\"0 0 " + width + " " + height + "\">\n<title>Precedence graph of " +
                    html_escaped(assembly.source_file) +
                    "</title>\n<style>rect{fill:#fff;stroke:#1c2430}path{fill:none;stroke:#5c6675;stroke-width:1.3}"
                    "text{font:13px system-ui,sans-serif;fill:#1c2430}.n{font-weight:bold}"
                    ".part{stroke-dasharray:5 4}</style>\n<defs><marker id=\"tip\" viewBox=\"0 0 8 8\" refX=\"7\" "
                    "refY=\"4\" markerWidth=\"7\" markerHeight=\"7\" orient=\"auto\"><polygon points=\"0 0 8 4 0 8\" "
                    "fill=\"#5c6675\"/></marker></defs>\n";
  for (const PrecedenceDrawing::Edge& edge : drawing.edges)
    svg += std::string("<path") + (plan.steps[edge.to].part_of == edge.from ? " class=\"part\"" : "") + " d=\"" +
           edge_path(drawing, edge, graph.ranks[edge.from]) + "\" marker-end=\"url(#tip)\"/>\n";
  for (std::uint32_t k = 0; k < plan.steps.size(); ++k)
    svg += box_svg(drawing.boxes[k], k, step_text(assembly, plan.steps[k]));
  return svg + "</svg>\n";
}

}  // namespace dismantle
