// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/explanation.h"

#include "dismantle/core/contract.h"
#include "dismantle/files/number_text.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dismantle {

namespace {

/// Names that a sentence lists before it counts the rest.
constexpr std::size_t kMaxNames = 4, kMaxBlockers = 3;
/// Of places [mm].
constexpr int kPlaceDigits = 4;
constexpr double kPlaceResolution = 0.01;
constexpr double kAxisCosine = 1 - 5e-7;
/// Of two directions with equally many blockers, the later one is preferred only if the component gets this many times
/// further.
constexpr double kClearlyFurther = 2;

/// A point or direction: "(2.5, 0, 1)". @param digits significant digits @param resolution no digits below this
std::string point_text(const Vec3& p, int digits, double resolution) {
  const auto text = [&](double x) { return number_text(x, digits, resolution); };
  return "(" + text(p.x) + ", " + text(p.y) + ", " + text(p.z) + ")";
}

/// The components outside a group that block one of its members, ascending; at most `enough` of them.
std::vector<ComponentId> blockers_of(BlockingTable& table, Span<const ComponentId> group, DirectionId d,
                                     const ComponentSet& others, std::size_t enough) {
  ComponentSet found(others.universe());
  for (const ComponentId member : group)
    for (const ComponentId blocker : table.blockers(member, d, others, enough)) found.insert(blocker);
  std::vector<ComponentId> blockers = found.members();
  if (blockers.size() > enough) blockers.resize(enough);
  return blockers;
}

/// The first contact of a group with a blocker, or one shortly after it.
StraightContact first_contact(const BlockingTable& table, Span<const ComponentId> group, DirectionId d,
                              ComponentId blocker) {
  std::optional<StraightContact> first;
  for (const ComponentId member : group)
    if (const auto contact = table.contact(member, d, blocker);
        contact && (!first || contact->distance < first->distance))
      first = contact;
  return first.value_or(StraightContact{});
}

/// The blockers of a group along a direction, with where it meets them, the nearest first.
std::vector<Blocker> blockers_met(const BlockingTable& table, Span<const ComponentId> group, DirectionId d,
                                  const std::vector<ComponentId>& blockers) {
  std::vector<Blocker> met;
  met.reserve(blockers.size());
  for (const ComponentId blocker : blockers) met.push_back({blocker, first_contact(table, group, d, blocker)});
  std::stable_sort(met.begin(), met.end(),
                   [](const Blocker& a, const Blocker& b) { return a.contact.distance < b.contact.distance; });
  return met;
}

/// The directions with the fewest blockers, and these. No more blockers are looked for along any than it takes to know.
std::vector<std::pair<DirectionId, std::vector<ComponentId>>> least_blocked(BlockingTable& table,
                                                                            Span<const ComponentId> group,
                                                                            Span<const DirectionId> directions,
                                                                            const ComponentSet& others,
                                                                            const Executor& executor) {
  std::vector<std::vector<ComponentId>> blockers(directions.size());
  for (std::size_t count = 0;; ++count) {
    executor.for_each_heavy(directions.size(), [&](std::size_t i) {
      blockers[i] = blockers_of(table, group, directions[i], others, count + 1);
    });
    std::vector<std::pair<DirectionId, std::vector<ComponentId>>> least;
    for (std::size_t i = 0; i < directions.size(); ++i)
      if (blockers[i].size() <= count) least.emplace_back(directions[i], std::move(blockers[i]));
    if (!least.empty()) return least;
  }
}

}  // namespace

BlockedWay least_blocked_way(BlockingTable& table, ComponentId component, Span<const DirectionId> directions,
                             const ComponentSet& present, const Executor& executor) {
  DISMANTLE_EXPECT(!directions.empty());
  const Span<const ComponentId> group = table.groups().of(component);
  ComponentSet others = present;
  others.erase(group);
  const auto least = least_blocked(table, group, directions, others, executor);
  std::vector<BlockedWay> ways(least.size());
  executor.for_each_heavy(least.size(), [&](std::size_t i) {
    ways[i] = {least[i].first, blockers_met(table, group, least[i].first, least[i].second)};
  });
  const auto free_way = [](const BlockedWay& way) {
    return way.blockers.empty() ? 0 : way.blockers.front().contact.distance;
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < ways.size(); ++i)
    if (free_way(ways[i]) > kClearlyFurther * free_way(ways[best])) best = i;
  return std::move(ways[best]);
}

Explanation explain(BlockingTable& table, ComponentId component, BlockedWay way, const ComponentSet& present) {
  const Span<const ComponentId> group = table.groups().of(component);
  Explanation found{component,
                    {group.begin(), group.end()},
                    table.direction(way.direction),
                    std::move(way.blockers),
                    table.moving_together(component, way.direction, present),
                    {},
                    {}};
  for (const ComponentId other : found.together) {
    const std::vector<ComponentId> back = table.moving_together(other, way.direction, present);
    if (std::find(back.begin(), back.end(), component) != back.end()) found.locked.push_back(other);
  }
  return found;
}

std::string direction_text(const Vec3& unit) {
  for (int k = 0; k < 3; ++k)
    if (std::abs(unit[k]) > kAxisCosine) return std::string(unit[k] > 0 ? "+" : "-") + "XYZ"[k];
  return point_text(unit, 3, 1e-3);
}

std::string names_text(const Assembly& assembly, Span<const ComponentId> components) {
  std::string text;
  for (std::size_t i = 0; i < components.size() && i < kMaxNames; ++i)
    text += (i > 0 ? ", " : "") + assembly[components[i]].name;
  if (components.size() > kMaxNames) text += " and " + std::to_string(components.size() - kMaxNames) + " more";
  return text;
}

std::string overlap_text(const Assembly& assembly, const LeastOverlap& overlap) {
  std::string text = "comes out along " + direction_text(overlap.direction) + " if ";
  for (std::size_t i = 0; i < overlap.pairs.size(); ++i) {
    const NeededOverlap& pair = overlap.pairs[i];
    text += (i > 0 ? ", and " : "") + number_text(pair.more, 2) + " mm more overlap with " + assembly[pair.fixed].name +
            " (at " + point_text(pair.at, kPlaceDigits, kPlaceResolution) + ")";
  }
  return text + (overlap.pairs.size() > 1 ? " were allowed" : " was allowed");
}

std::string explanation_text(const Assembly& assembly, const Explanation& e) {
  std::string text = assembly[e.component].name;
  if (e.group.size() > 1) text += " (with " + std::to_string(e.group.size() - 1) + " more of its group)";
  if (e.blockers.empty()) return text + " can be removed along " + direction_text(e.direction);
  text += " is blocked by ";
  for (std::size_t i = 0; i < e.blockers.size() && i < kMaxBlockers; ++i) {
    const Blocker& b = e.blockers[i];
    text += (i > 0 ? ", " : "") + assembly[b.component].name + " (contact at " +
            point_text(b.contact.point, kPlaceDigits, kPlaceResolution) + ")";
  }
  if (e.blockers.size() > kMaxBlockers) text += " and " + std::to_string(e.blockers.size() - kMaxBlockers) + " more";
  text += " along " + direction_text(e.direction);
  std::vector<ComponentId> locked = e.locked;
  std::erase_if(locked, [&](ComponentId c) { return std::find(e.group.begin(), e.group.end(), c) != e.group.end(); });
  if (!locked.empty()) text += ", interlocked with " + names_text(assembly, locked);
  if (e.overlap) text += "; " + overlap_text(assembly, *e.overlap);
  return text;
}

}  // namespace dismantle
