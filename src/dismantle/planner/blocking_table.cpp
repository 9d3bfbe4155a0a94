// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/blocking_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace dismantle {

namespace {

/// Directions within this angle share an id [rad].
constexpr double kSameDirection = 1e-6;
/// A direction is along an axis if the cosine of the angle between them is no further from 1.
constexpr double kAlongAxis = 1e-3;
/// Margin of exit distances, as a share of the component's radius.
constexpr double kMargin = 0.05;
/// Bounds the rounding of positions, relative to the coordinates.
constexpr double kRounding = 1e-9;
/// Number of blockers of a component that are tried first in other directions: a few probably block those, too.
constexpr std::size_t kMaxLastBlockers = 16;

std::array<std::int64_t, 3> cell_of(const Vec3& unit) {
  const auto index = [](double x) { return static_cast<std::int64_t>(std::floor(x / kSameDirection)); };
  return {index(unit.x), index(unit.y), index(unit.z)};
}

}  // namespace

BlockingTable::BlockingTable(const CertificateEngine& engine, Span<const ShapeFeatures> features,
                             const RigidGroups& groups, KeepGoing keep_going)
    : engine_(engine),
      features_(features),
      groups_(groups),
      keep_going_(std::move(keep_going)),
      spheres_(sphere_tree(features)),
      rows_(features.size()),
      row_mutexes_(features.size()),
      last_blockers_(features.size()) {}

DirectionId BlockingTable::add_direction(const Vec3& unit) {
  const auto [x, y, z] = cell_of(unit);
  DirectionId same;
  for (std::int64_t i = x - 1; i <= x + 1; ++i)
    for (std::int64_t j = y - 1; j <= y + 1; ++j)
      for (std::int64_t k = z - 1; k <= z + 1; ++k) {
        const auto cell = cells_.find({i, j, k});
        if (cell == cells_.end()) continue;
        for (const DirectionId d : cell->second)
          if (length(directions_[d.value] - unit) < kSameDirection && (!same.valid() || d < same)) same = d;
      }
  if (same.valid()) return same;
  directions_.push_back(unit);
  const DirectionId added(static_cast<std::uint32_t>(directions_.size() - 1));
  cells_[{x, y, z}].push_back(added);
  return added;
}

ComponentId BlockingTable::leader_of(ComponentId c) const {
  const Span<const ComponentId> group = groups_.of(c);
  return *std::max_element(group.begin(), group.end(), [this](ComponentId a, ComponentId b) {
    return features_[a.value].radius < features_[b.value].radius;
  });
}

BlockingTable::Known* BlockingTable::Row::find(ComponentId c) {
  const auto found = std::lower_bound(near.begin(), near.end(), c);
  return found == near.end() || *found != c ? nullptr : &known[static_cast<std::size_t>(found - near.begin())];
}

BlockingTable::Row& BlockingTable::row(ComponentId moving, DirectionId d) {
  const std::lock_guard lock(row_mutexes_[moving.value]);
  auto [place, is_new] = rows_[moving.value].try_emplace(d);
  if (is_new) place->second = new_row(moving, d);
  return place->second;
}

BlockingTable::Row BlockingTable::new_row(ComponentId moving, DirectionId d) const {
  Row row;
  if (expectation_) row.expected = expectation_(moving, direction(d));
  row.near = row.expected;
  const Span<const ComponentId> group = groups_.of(moving);
  row.near.insert(row.near.end(), group.begin(), group.end());
  for_each_in_way(moving, d, [&](ComponentId c, double) {
    if (!boxes_stay_apart(moving, d, c) || passes_along_axis(moving, c)) row.near.push_back(c);
  });
  std::sort(row.near.begin(), row.near.end());
  row.near.erase(std::unique(row.near.begin(), row.near.end()), row.near.end());
  std::erase(row.near, moving);

  row.known.resize(row.near.size());
  for (const ComponentId mate : group)
    if (mate != moving) *row.find(mate) = Known::Blocks;
  row.nearest.resize(row.near.size());
  std::iota(row.nearest.begin(), row.nearest.end(), 0u);
  const auto gap = [&](std::uint32_t i) {
    const ShapeFeatures& other = features_[row.near[i].value];
    return length(other.center - features_[moving.value].center) - other.radius;
  };
  std::stable_sort(row.nearest.begin(), row.nearest.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return gap(a) < gap(b); });
  return row;
}

double BlockingTable::way_past(ComponentId moving, DirectionId d, ComponentId fixed) const {
  const ShapeFeatures& m = features_[moving.value];
  const ShapeFeatures& f = features_[fixed.value];
  const Vec3 apart = f.center - m.center;
  const double along = dot(apart, direction(d)), reach = m.radius + f.radius;
  const double aside = length(apart - along * direction(d));
  return aside > reach ? 0 : std::max(0.0, along + reach);
}

template <class Visit>
void BlockingTable::for_each_in_way(ComponentId moving, DirectionId d, const Visit& visit) const {
  const ShapeFeatures& m = features_[moving.value];
  const auto out_of_way = [&](const BoundingSphere& s) {
    const Vec3 apart = s.center - m.center;
    const double along = dot(apart, direction(d)), reach = m.radius + s.radius;
    const double margin = kRounding * (max_abs(m.center) + max_abs(s.center) + reach);
    return std::max(length(apart - along * direction(d)) - reach, -(along + reach)) - margin;
  };
  spheres_.traverse(
      out_of_way, [] { return 0.0; },
      [&](std::uint32_t c) {
        if (c == moving.value) return;
        const double way = way_past(moving, d, ComponentId(c));
        if (way > 0) visit(ComponentId(c), way);
      });
}

bool BlockingTable::boxes_stay_apart(ComponentId moving, DirectionId d, ComponentId fixed) const {
  const Aabb &m = features_[moving.value].bounds, &f = features_[fixed.value].bounds;
  if (m.empty() || f.empty()) return true;
  const Vec3 apart = f.center() - m.center(), half = 0.5 * (m.size() + f.size());
  const double margin = kRounding * (max_abs(m.center()) + max_abs(f.center()) + max_abs(half));
  const auto reach = [&](const Vec3& w) {
    return half.x * std::abs(w.x) + half.y * std::abs(w.y) + half.z * std::abs(w.z);
  };
  const Vec3& ahead = direction(d);
  if (-dot(ahead, apart) > reach(ahead) + margin) return true;
  for (const Vec3& edge : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const Vec3 w = cross(ahead, edge);
    if (std::abs(dot(w, apart)) > reach(w) + margin) return true;
  }
  return false;
}

double BlockingTable::exit_distance(ComponentId moving, DirectionId d) const {
  double way = 0;
  for_each_in_way(moving, d, [&](ComponentId, double past) { way = std::max(way, past); });
  return way + kMargin * features_[moving.value].radius;
}

double BlockingTable::max_exit_distance(ComponentId moving) const {
  double most = 0;
  for (const ComponentId member : groups_.of(moving)) {
    const ShapeFeatures& m = features_[member.value];
    double way = 0;
    for (const ShapeFeatures& f : features_) way = std::max(way, length(f.center - m.center) + f.radius);
    most = std::max(most, way + (1 + kMargin) * m.radius);
  }
  return most;
}

bool BlockingTable::blocks(ComponentId moving, DirectionId d, ComponentId fixed) {
  if (joints_ != nullptr && joint_blocker(moving, d, ComponentSet(features_.size(), {&fixed, 1}))) return true;
  return blocks(row(moving, d), moving, d, fixed);
}

bool BlockingTable::blocks(Row& row, ComponentId moving, DirectionId d, ComponentId fixed) {
  Known* known = row.find(fixed);
  if (!known) return false;
  if (*known == Known::Nothing || (*known == Known::Hard && !postpone_)) {
    if (!keep_going_()) return true;
    *known = decide(moving, d, fixed);
  }
  return *known != Known::Free;
}

BlockingTable::Known BlockingTable::decide(ComponentId moving, DirectionId d, ComponentId fixed) const {
  const double way = way_past(moving, d, fixed);
  if (way <= 0) return Known::Free;
  if (!may_pass(moving, d, fixed)) return Known::Blocks;
  const StraightSearch search = postpone_ ? StraightSearch::Quick : StraightSearch::Any;
  const auto contact = engine_.straight_contact(moving, fixed, way * direction(d), search);
  if (!contact) return Known::Free;
  return postpone_ && !contact->is_certain ? Known::Hard : Known::Blocks;
}

bool BlockingTable::is_postponed(ComponentId moving, DirectionId d, ComponentId fixed) {
  const Known* known = row(moving, d).find(fixed);
  return known && *known == Known::Hard;
}

std::optional<ComponentId> BlockingTable::joint_blocker(ComponentId moving, DirectionId d,
                                                        const ComponentSet& present) const {
  return joints_ != nullptr ? joints_->blocker(moving, direction(d), present) : std::nullopt;
}

std::optional<ComponentId> BlockingTable::any_blocker(ComponentId moving, DirectionId d, const ComponentSet& present) {
  if (const auto by_joint = joint_blocker(moving, d, present)) return by_joint;
  Row& known = row(moving, d);
  const auto is_blocker = [&](ComponentId c) { return present.has(c) && blocks(known, moving, d, c); };
  if (known.witness.valid() && is_blocker(known.witness)) return known.witness;
  for (const ComponentId other : known.expected)
    if (is_blocker(other)) return known.witness = other;
  for (const ComponentId other : last_blockers_[moving.value])
    if (is_blocker(other)) return known.witness = other;
  for (const std::uint32_t i : known.nearest) {
    if (!is_blocker(known.near[i])) continue;
    known.witness = known.near[i];
    remember_blocker(moving, known.witness);
    return known.witness;
  }
  return std::nullopt;
}

void BlockingTable::remember_blocker(ComponentId moving, ComponentId blocker) {
  std::vector<ComponentId>& last = last_blockers_[moving.value];
  std::erase(last, blocker);
  last.insert(last.begin(), blocker);
  if (last.size() > kMaxLastBlockers) last.pop_back();
}

std::optional<ComponentId> BlockingTable::expected_blocker(ComponentId moving, DirectionId d,
                                                           const ComponentSet& present) {
  if (const auto by_joint = joint_blocker(moving, d, present)) return by_joint;
  Row& known = row(moving, d);
  if (known.witness.valid() && present.has(known.witness)) return known.witness;
  for (const ComponentId other : known.expected)
    if (present.has(other) && *known.find(other) != Known::Free) return other;
  return std::nullopt;
}

std::vector<ComponentId> BlockingTable::blockers(ComponentId moving, DirectionId d, const ComponentSet& present,
                                                 std::size_t enough) {
  std::vector<ComponentId> found;
  Row& known = row(moving, d);
  const std::optional<ComponentId> by_joint = joint_blocker(moving, d, present);
  if (by_joint) found.push_back(*by_joint);
  for (const std::uint32_t i : known.nearest) {
    if (found.size() >= enough) break;
    if (known.near[i] == by_joint || !present.has(known.near[i])) continue;
    if (blocks(known, moving, d, known.near[i])) found.push_back(known.near[i]);
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<ComponentId> BlockingTable::moving_together(ComponentId moving, DirectionId d,
                                                        const ComponentSet& present) {
  ComponentSet ends(features_.size());
  Together memory(features_.size());
  return moving_together(
      moving, d, present, ends, [this] { return features_.size(); }, memory);
}

std::vector<ComponentId> BlockingTable::moving_together(ComponentId moving, DirectionId d, const ComponentSet& present,
                                                        ComponentSet& ends, const std::function<std::size_t()>& most,
                                                        Together& memory) {
  ComponentSet& together = memory.set;
  std::vector<ComponentId>&members = memory.members, &blocked_by = memory.blocked_by;
  together.erase(members);
  members.clear();
  blocked_by[moving.value] = ComponentId();
  std::vector<ComponentId> unfollowed{moving},
      unasked;  // members whose known relations, and whose unknown ones, are not expanded yet
  while (!unfollowed.empty() || !unasked.empty()) {
    if (unfollowed.empty()) {
      const ComponentId member = unasked.back();
      if (const auto next = another_blocker(member, d, present, together, ends)) {
        blocked_by[next->value] = member;
        unfollowed.push_back(*next);
      } else {
        unasked.pop_back();
      }
      continue;
    }
    const ComponentId member = unfollowed.back();
    unfollowed.pop_back();
    if (together.has(member)) continue;
    together.insert(member);
    members.push_back(member);
    if (ends.has(member)) {
      for (ComponentId c = member; c.valid(); c = blocked_by[c.value]) ends.insert(c);
      return {};
    }
    if (members.size() > most()) {
      ends.insert(moving);
      return {};
    }
    unasked.push_back(member);
    if (joints_ != nullptr)
      for (const ComponentId other : joints_->tied_to(member, present)) {
        if (together.has(other)) continue;
        blocked_by[other.value] = member;
        unfollowed.push_back(other);
      }
    const Row& known = row(member, d);
    for (const std::uint32_t i : known.nearest) {
      const ComponentId other = known.near[i];
      if (known.known[i] != Known::Blocks || !present.has(other) || together.has(other)) continue;
      blocked_by[other.value] = member;
      unfollowed.push_back(other);
    }
  }
  std::vector<ComponentId> found = members;
  std::sort(found.begin(), found.end());
  return found;
}

std::optional<ComponentId> BlockingTable::another_blocker(ComponentId moving, DirectionId d,
                                                          const ComponentSet& present, const ComponentSet& together,
                                                          const ComponentSet& ends) {
  Row& known = row(moving, d);
  const auto is_new = [&](ComponentId c) { return present.has(c) && !together.has(c) && blocks(known, moving, d, c); };
  for (const ComponentId other : known.expected)
    if (is_new(other)) return other;
  for (const bool ends_it : {true, false})
    for (const std::uint32_t i : known.nearest)
      if (ends.has(known.near[i]) == ends_it && is_new(known.near[i])) return known.near[i];
  return std::nullopt;
}

void BlockingTable::let_pass_along(ComponentId a, ComponentId b, Vec3 axis) {
  only_along_[std::minmax(a, b)] = axis;
}

bool BlockingTable::may_pass(ComponentId moving, DirectionId d, ComponentId fixed) const {
  const auto known = only_along_.find(std::minmax(moving, fixed));
  return known == only_along_.end() || std::abs(dot(known->second, direction(d))) >= 1 - kAlongAxis;
}

void BlockingTable::add_blocker(ComponentId moving, DirectionId d, ComponentId fixed) {
  Row& known = row(moving, d);
  if (!known.find(fixed)) {
    const auto place = std::lower_bound(known.near.begin(), known.near.end(), fixed) - known.near.begin();
    known.near.insert(known.near.begin() + place, fixed);
    known.known.insert(known.known.begin() + place, Known::Nothing);
    for (std::uint32_t& i : known.nearest) i += i >= static_cast<std::uint32_t>(place);
    known.nearest.push_back(static_cast<std::uint32_t>(place));
  }
  *known.find(fixed) = Known::Blocks;
}

std::optional<StraightContact> BlockingTable::contact(ComponentId moving, DirectionId d, ComponentId fixed) const {
  const double way = way_past(moving, d, fixed);
  if (!(way > 0) || !keep_going_()) return std::nullopt;
  return engine_.straight_contact(moving, fixed, way * direction(d), StraightSearch::Near);
}

}  // namespace dismantle
