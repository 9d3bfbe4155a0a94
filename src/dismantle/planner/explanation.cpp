// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/explanation.h"

#include "dismantle/core/contract.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace dismantle {

namespace {

constexpr double kAxisCosine = 1 - 5e-7;
/// Of two directions with equally many blockers, the later one is preferred only if the component gets this many times
/// further.
constexpr double kClearlyFurther = 2;

std::string point_text(const Vec3& p, const char* format) {
  char text[128];
  std::snprintf(text, sizeof text, format, p.x, p.y, p.z);
  return text;
}

std::string names_text(const Assembly& assembly, const std::vector<ComponentId>& components, ComponentId except) {
  std::string text;
  for (const ComponentId c : components)
    if (c != except) text += (text.empty() ? "" : ", ") + assembly[c].name;
  return text;
}

/// Distance to the first contact with a blocker [mm].
double way_to_first(const BlockingTable& table, ComponentId component, DirectionId d,
                    const std::vector<ComponentId>& blockers) {
  double way = std::numeric_limits<double>::infinity();
  for (const ComponentId blocker : blockers)
    way = std::min(way, table.contact(component, d, blocker).value_or(StraightContact{}).distance);
  return way;
}

}  // namespace

Explanation explain(BlockingTable& table, ComponentId component, Span<const DirectionId> directions,
                    const ComponentSet& present) {
  DISMANTLE_EXPECT(!directions.empty());
  DirectionId best;
  std::vector<ComponentId> fewest;
  double furthest = 0;
  for (const DirectionId d : directions) {
    const std::size_t enough = best.valid() ? fewest.size() + 1 : present.size();
    std::vector<ComponentId> blockers = table.blockers(component, d, present, enough);
    if (best.valid() && blockers.size() > fewest.size()) continue;
    const double free_way = way_to_first(table, component, d, blockers);
    if (best.valid() && blockers.size() == fewest.size() && free_way <= kClearlyFurther * furthest) continue;
    best = d;
    fewest = std::move(blockers);
    furthest = free_way;
  }

  Explanation found{component, table.direction(best), {}, table.moving_together(component, best, present), {}};
  for (const ComponentId blocker : fewest)
    found.blockers.push_back({blocker, table.contact(component, best, blocker).value_or(StraightContact{})});
  std::stable_sort(found.blockers.begin(), found.blockers.end(),
                   [](const Blocker& a, const Blocker& b) { return a.contact.distance < b.contact.distance; });
  for (const ComponentId other : found.together) {
    const std::vector<ComponentId> back = table.moving_together(other, best, present);
    if (std::find(back.begin(), back.end(), component) != back.end()) found.locked.push_back(other);
  }
  return found;
}

std::string direction_text(const Vec3& unit) {
  for (int k = 0; k < 3; ++k)
    if (std::abs(unit[k]) > kAxisCosine) return std::string(unit[k] > 0 ? "+" : "-") + "XYZ"[k];
  // Avoids "-0.000".
  const auto rounded = [](double x) { return std::abs(x) < 5e-4 ? 0 : x; };
  return point_text({rounded(unit.x), rounded(unit.y), rounded(unit.z)}, "(%.3f, %.3f, %.3f)");
}

std::string explanation_text(const Assembly& assembly, const Explanation& e) {
  std::string text = assembly[e.component].name;
  if (e.blockers.empty()) return text + " can be removed along " + direction_text(e.direction);
  text += " is blocked by ";
  for (std::size_t i = 0; i < e.blockers.size(); ++i) {
    const Blocker& b = e.blockers[i];
    text += (i > 0 ? ", " : "") + assembly[b.component].name + " (contact at " +
            point_text(b.contact.point, "(%.4g, %.4g, %.4g)") + ")";
  }
  text += " along " + direction_text(e.direction);
  if (e.locked.size() > 1) text += ", locked with {" + names_text(assembly, e.locked, e.component) + "}";
  return text;
}

}  // namespace dismantle
