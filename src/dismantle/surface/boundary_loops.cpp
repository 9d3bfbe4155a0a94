// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/boundary_loops.h"

#include "dismantle/core/contract.h"
#include "dismantle/geometry/half_edges.h"

#include <algorithm>
#include <utility>

namespace dismantle {

namespace {

using Step = std::pair<std::uint32_t, std::uint32_t>;

/// The edges in excess, each in its direction, sorted by the vertex where they start. Every vertex has as many that
/// start as that end there.
std::vector<Step> excess_edges(Span<const Face> faces) {
  std::vector<Step> steps;
  for_each_edge(sorted_half_edges(faces), [&](const HalfEdge* first, const HalfEdge* last) {
    int excess = 0;
    for (const HalfEdge* h = first; h != last; ++h) excess += h->forward ? 1 : -1;
    const Step step = excess > 0 ? Step{first->low, first->high} : Step{first->high, first->low};
    steps.insert(steps.end(), static_cast<std::size_t>(std::abs(excess)), step);
  });
  std::sort(steps.begin(), steps.end());
  return steps;
}

/// The cosine of the angle between two directions; 0 where one of them has no length.
double cosine(Vec3 a, Vec3 b) {
  const double size = length(a) * length(b);
  return size > 0 ? dot(a, b) / size : 0;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> boundary_loops(const TriangleMesh& mesh) {
  std::vector<Step> steps = excess_edges(mesh.faces);
  std::vector<std::vector<std::uint32_t>> loops;
  if (steps.empty()) return loops;

  constexpr std::size_t kOffWalk = static_cast<std::size_t>(-1);
  const std::size_t vertex_count = steps.back().first + 1;
  std::vector<std::size_t> next(vertex_count + 1, 0), place(vertex_count, kOffWalk);
  for (const Step& s : steps) ++next[s.first + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) next[v + 1] += next[v];
  const std::vector<std::size_t> begin = next;

  for (std::uint32_t start = 0; start < vertex_count; ++start) {
    std::vector<std::uint32_t> walk;
    for (std::uint32_t at = start;;) {
      if (place[at] != kOffWalk) {  // the walk came back to a vertex: that part of it is a loop
        const auto first = walk.begin() + static_cast<std::ptrdiff_t>(place[at]);
        for (auto v = first; v != walk.end(); ++v) place[*v] = kOffWalk;
        loops.emplace_back(first, walk.end());
        walk.erase(first, walk.end());
      }
      if (next[at] == begin[at + 1]) break;
      if (!walk.empty()) {
        const Vec3 here = mesh.vertices[at], back = mesh.vertices[walk.back()] - here;
        const auto turn = [&](const Step& s) { return cosine(back, mesh.vertices[s.second] - here); };
        const auto first = steps.begin() + static_cast<std::ptrdiff_t>(next[at]);
        const auto last = steps.begin() + static_cast<std::ptrdiff_t>(begin[at + 1]);
        std::iter_swap(first,
                       std::max_element(first, last, [&](const Step& a, const Step& b) { return turn(a) < turn(b); }));
      }
      place[at] = walk.size();
      walk.push_back(at);
      at = steps[next[at]++].second;
      DISMANTLE_ENSURE(at < vertex_count);
    }
    DISMANTLE_ENSURE(walk.empty());
  }
  return loops;
}

}  // namespace dismantle
