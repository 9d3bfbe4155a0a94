// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/explanation.h"

#include "dismantle/core/contract.h"
#include "dismantle/files/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// The distance to the first contact with a blocker, approximately [mm].
double way_to_first(const BlockingTable& table, Span<const ComponentId> group, DirectionId d,
                    const std::vector<ComponentId>& blockers) {
  double way = std::numeric_limits<double>::infinity();
  for (const ComponentId blocker : blockers) way = std::min(way, first_contact(table, group, d, blocker).distance);
  return way;
}

}  // namespace

Explanation explain(BlockingTable& table, ComponentId component, Span<const DirectionId> directions,
                    const ComponentSet& present) {
  DISMANTLE_EXPECT(!directions.empty());
  const Span<const ComponentId> group = table.groups().of(component);
  ComponentSet others = present;
  others.erase(group);
  DirectionId best;
  std::vector<ComponentId> fewest;
  double furthest = 0;
  for (const DirectionId d : directions) {
    const std::size_t enough = best.valid() ? fewest.size() + 1 : present.size();
    std::vector<ComponentId> blockers = blockers_of(table, group, d, others, enough);
    if (best.valid() && blockers.size() > fewest.size()) continue;
    const double free_way = way_to_first(table, group, d, blockers);
    if (best.valid() && blockers.size() == fewest.size() && free_way <= kClearlyFurther * furthest) continue;
    best = d;
    fewest = std::move(blockers);
    furthest = free_way;
  }

  Explanation found{component,
                    {group.begin(), group.end()},
                    table.direction(best),
                    {},
                    table.moving_together(component, best, present),
                    {},
                    {}};
  for (const ComponentId blocker : fewest)
    found.blockers.push_back({blocker, first_contact(table, group, best, blocker)});
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
  if (!locked.empty()) text += ", locked with {" + names_text(assembly, locked) + "}";
  if (e.overlap) text += "; " + overlap_text(assembly, *e.overlap);
  return text;
}

}  // namespace dismantle
