// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/blocking_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dismantle {

namespace {

/// Directions within this angle share an id [rad].
constexpr double kSameDirection = 1e-6;
/// A direction is along an axis if the cosine of the angle between them is no further from 1.
constexpr double kAlongAxis = 1e-3;
/// Margin of exit distances, as a share of the component's radius.
constexpr double kMargin = 0.05;

}  // namespace

BlockingTable::BlockingTable(const CertificateEngine& engine, Span<const ShapeFeatures> features,
                             const RigidGroups& groups, KeepGoing keep_going)
    : engine_(engine),
      features_(features),
      groups_(groups),
      keep_going_(std::move(keep_going)),
      rows_(features.size()),
      others_(features.size()) {
  for (std::uint32_t c = 0; c < features.size(); ++c) {
    std::vector<ComponentId>& others = others_[c];
    for (std::uint32_t k = 0; k < features.size(); ++k)
      if (k != c) others.emplace_back(k);
    const auto gap = [&](ComponentId k) {
      return length(features[k.value].center - features[c].center) - features[k.value].radius;
    };
    std::stable_sort(others.begin(), others.end(), [&](ComponentId a, ComponentId b) { return gap(a) < gap(b); });
  }
}

DirectionId BlockingTable::add_direction(const Vec3& unit) {
  for (std::uint32_t d = 0; d < directions_.size(); ++d)
    if (length(directions_[d] - unit) < kSameDirection) return DirectionId(d);
  directions_.push_back(unit);
  return DirectionId(static_cast<std::uint32_t>(directions_.size() - 1));
}

BlockingTable::Row& BlockingTable::row(ComponentId moving, DirectionId d) {
  Row& row = rows_[moving.value][d];
  if (row.known.empty()) {
    row.known.resize(features_.size());
    for (const ComponentId mate : groups_.of(moving))
      if (mate != moving) row.known[mate.value] = Known::Blocks;
    if (expectation_) row.expected = expectation_(moving, direction(d));
  }
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

double BlockingTable::exit_distance(ComponentId moving, DirectionId d) const {
  double way = 0;
  for (std::uint32_t c = 0; c < features_.size(); ++c)
    if (c != moving.value) way = std::max(way, way_past(moving, d, ComponentId(c)));
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
  Known& known = row(moving, d).known[fixed.value];
  if (known == Known::Nothing) {
    if (!keep_going_()) return true;
    const double way = way_past(moving, d, fixed);
    const bool met =
        way > 0 && (!may_pass(moving, d, fixed) ||
                    engine_.straight_contact(moving, fixed, way * direction(d), StraightSearch::Any).has_value());
    known = met ? Known::Blocks : Known::Free;
  }
  return known == Known::Blocks;
}

std::optional<ComponentId> BlockingTable::any_blocker(ComponentId moving, DirectionId d, const ComponentSet& present) {
  Row& known = row(moving, d);
  if (known.witness.valid() && present.has(known.witness)) return known.witness;
  for (const ComponentId other : known.expected)
    if (present.has(other) && blocks(moving, d, other)) return known.witness = other;
  std::vector<ComponentId>& others = others_[moving.value];
  for (auto other = others.begin(); other != others.end(); ++other) {
    if (!present.has(*other) || !blocks(moving, d, *other)) continue;
    known.witness = *other;
    std::rotate(others.begin(), other, other + 1);  // it probably blocks other directions, too
    return known.witness;
  }
  return std::nullopt;
}

bool BlockingTable::expects_blocker(ComponentId moving, DirectionId d, const ComponentSet& present) {
  const Row& known = row(moving, d);
  if (known.witness.valid() && present.has(known.witness)) return true;
  return std::any_of(known.expected.begin(), known.expected.end(),
                     [&](ComponentId other) { return present.has(other) && known.known[other.value] != Known::Free; });
}

std::vector<ComponentId> BlockingTable::blockers(ComponentId moving, DirectionId d, const ComponentSet& present,
                                                 std::size_t enough) {
  std::vector<ComponentId> found;
  for (const ComponentId other : others_[moving.value]) {
    if (found.size() >= enough) break;
    if (present.has(other) && blocks(moving, d, other)) found.push_back(other);
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<ComponentId> BlockingTable::moving_together(ComponentId moving, DirectionId d,
                                                        const ComponentSet& present) {
  ComponentSet ends(features_.size());
  return moving_together(moving, d, present, ends, features_.size());
}

std::vector<ComponentId> BlockingTable::moving_together(ComponentId moving, DirectionId d, const ComponentSet& present,
                                                        ComponentSet& ends, std::size_t most) {
  ComponentSet together(features_.size());
  std::vector<ComponentId> blocked_by(features_.size());  // the component that a member moves along with
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
    if (ends.has(member)) {
      for (ComponentId c = member; c.valid(); c = blocked_by[c.value]) ends.insert(c);
      return {};
    }
    if (together.size() > most) {
      ends.insert(moving);
      return {};
    }
    unasked.push_back(member);
    const std::vector<Known>& known = row(member, d).known;
    for (const ComponentId other : others_[member.value])
      if (known[other.value] == Known::Blocks && present.has(other) && !together.has(other)) {
        blocked_by[other.value] = member;
        unfollowed.push_back(other);
      }
  }
  return together.members();
}

std::optional<ComponentId> BlockingTable::another_blocker(ComponentId moving, DirectionId d,
                                                          const ComponentSet& present, const ComponentSet& together,
                                                          const ComponentSet& ends) {
  const auto is_new = [&](ComponentId c) { return present.has(c) && !together.has(c) && blocks(moving, d, c); };
  for (const ComponentId other : row(moving, d).expected)
    if (is_new(other)) return other;
  for (const bool ends_it : {true, false})
    for (const ComponentId other : others_[moving.value])
      if (ends.has(other) == ends_it && is_new(other)) return other;
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
  row(moving, d).known[fixed.value] = Known::Blocks;
}

std::optional<StraightContact> BlockingTable::contact(ComponentId moving, DirectionId d, ComponentId fixed) const {
  const double way = way_past(moving, d, fixed);
  if (!(way > 0)) return std::nullopt;
  return engine_.straight_contact(moving, fixed, way * direction(d), StraightSearch::First);
}

}  // namespace dismantle
