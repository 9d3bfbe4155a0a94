// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/direction_clusters.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

/// Number of the heaviest cells that are merged; lighter ones do not matter.
constexpr std::size_t kMaxCells = 512;

/// The direction of an axis whose largest coordinate is positive.
Vec3 one_of_two(const Vec3& v) {
  int largest = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(v[k]) > std::abs(v[largest])) largest = k;
  return v[largest] < 0 ? -v : v;
}

}  // namespace

void DirectionClusters::add(const Vec3& direction, double weight) {
  Vec3 unit = normalized(direction);
  if (sense_ == Sense::Axis) unit = one_of_two(unit);
  std::array<std::int32_t, 3> key{};
  for (int k = 0; k < 3; ++k)
    key[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(std::lround(unit[k] / kSameDirectionAngle));
  Cell& cell = cells_[key];
  cell.sum += weight * unit;
  cell.weight += weight;
}

std::vector<WeightedDirection> DirectionClusters::heaviest(std::size_t count) const {
  std::vector<Cell> cells;
  for (const auto& [key, cell] : cells_) cells.push_back(cell);
  std::stable_sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.weight > b.weight; });
  if (cells.size() > kMaxCells) cells.resize(kMaxCells);

  // Cells are as wide as the angle, so that the parts of one cluster lie within twice the angle.
  const double same = std::cos(2 * kSameDirectionAngle);
  std::vector<Cell> merged;
  for (const Cell& cell : cells) {
    const Vec3 unit = normalized(cell.sum);
    const auto known = std::find_if(merged.begin(), merged.end(), [&](const Cell& m) {
      const double cosine = dot(normalized(m.sum), unit);
      return (sense_ == Sense::Axis ? std::abs(cosine) : cosine) > same;
    });
    if (known == merged.end()) {
      merged.push_back(cell);
    } else {
      known->sum += dot(known->sum, cell.sum) < 0 ? -cell.sum : cell.sum;
      known->weight += cell.weight;
    }
  }
  std::stable_sort(merged.begin(), merged.end(), [](const Cell& a, const Cell& b) { return a.weight > b.weight; });
  if (merged.size() > count) merged.resize(count);
  std::vector<WeightedDirection> result;
  result.reserve(merged.size());
  for (const Cell& cell : merged) result.push_back({normalized(cell.sum), cell.weight});
  return result;
}

}  // namespace dismantle
