// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/removal_facts.h"

#include "dismantle/session/session_path.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Distance at which removed components are placed, in diagonals of the assembly.
constexpr double kFarAway = 100;
/// Maximum number of poses evaluated along a path; of more, every n-th is taken.
constexpr std::size_t kMaxSamples = 60;

bool has(Span<const ComponentId> set, ComponentId c) {
  return std::find(set.begin(), set.end(), c) != set.end();
}

/// The components that earlier steps have removed: neither in the moving set nor in its surroundings.
std::vector<ComponentId> removed_before(const WorkStep& step, const RemovalMove& removal) {
  const std::vector<ComponentId> around = surroundings(step, removal);
  std::vector<ComponentId> removed;
  for (std::uint32_t c = 0; c < step.before.size(); ++c)
    if (!has(around, ComponentId(c)) && !has(removal.components, ComponentId(c))) removed.emplace_back(c);
  return removed;
}

void add_once(std::vector<ComponentId>& list, ComponentId c) {
  if (!has(list, c)) list.push_back(c);
}

}  // namespace

RemovalFacts::RemovalFacts(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options)
    : assembly_(assembly), pairs_(pairs), engine_(assembly, pairs, options) {}

PathClearance RemovalFacts::clearance(const WorkStep& step, const RemovalMove& removal) {
  const Aabb box = bounds_of(assembly_, removal.components);
  const double max_clearance = kMaxClearanceShare * diagonal(box);
  const int samples = removal.poses.size() > kClearanceSamples ? 1 : kClearanceSamples;
  const std::vector<PathPose> path = poses_along(removal, box.center(), samples);
  const std::size_t stride = 1 + path.size() / kMaxSamples;
  std::vector<Pose> poses = with_removed(step.before, removed_before(step, removal));
  PathClearance found;
  for (std::size_t i = 0; i < path.size(); i += stride) {
    for (const ComponentId c : removal.components) poses[c.value] = path[i].pose;
    engine_.jump(poses);
    engine_.grab(removal.components);
    const double limit = std::min(found.min_distance, max_clearance);
    const Clearance now = engine_.clearance(std::max(limit, 2 * pairs_.tolerance));
    if (now.distance <= pairs_.tolerance) {
      found = PathClearance{};
      found.contact_length = path[i].distance;
      found.last_contact = now.fixed;
    } else if (now.distance < limit && now.fixed != found.last_contact) {
      found.min_distance = now.distance;
      found.nearest = now.fixed;
    }
  }
  return found;
}

std::vector<ComponentId> RemovalFacts::neighbours(Span<const ComponentId> set) const {
  std::vector<ComponentId> found;
  for (const ComponentPair& pair : pairs_.pairs) {
    if (pair.state == PairState::Near || has(set, pair.a) == has(set, pair.b)) continue;
    found.push_back(has(set, pair.a) ? pair.b : pair.a);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::vector<Pose> RemovalFacts::with_removed(Span<const Pose> poses, Span<const ComponentId> removed) const {
  const double away = kFarAway * diagonal(assembled_bounds(assembly_));
  std::vector<Pose> now(poses.begin(), poses.end());
  for (const ComponentId r : removed) now[r.value] = {{away, 0, 0}, {}};
  return now;
}

bool RemovalFacts::can_fall(ComponentId c, Span<const Pose> poses, Span<const ComponentId> removed) {
  const std::vector<Pose> now = with_removed(poses, removed);
  engine_.jump(now);
  engine_.grab({&c, 1});
  Pose fallen = now[c.value];
  fallen.position.z -= kFallShare * diagonal(bounds_at(assembly_[c], fallen));
  return engine_.first_contact(fallen).free;
}

std::vector<ComponentId> RemovalFacts::unsupported_after(const WorkStep& step, ComponentId ground) {
  std::vector<ComponentId> removed;
  for (const RemovalMove& removal : step.removals)
    removed.insert(removed.end(), removal.components.begin(), removal.components.end());
  const std::vector<ComponentId> around = surroundings(step, step.removals.front());

  std::vector<ComponentId> unsupported;
  for (const ComponentId c : neighbours(removed)) {
    const bool is_held = std::any_of(pairs_.pairs.begin(), pairs_.pairs.end(), [&](const ComponentPair& pair) {
      const bool grips = pair.state == PairState::Overlapping || pair.state == PairState::Free;
      if (!grips || (pair.a != c && pair.b != c)) return false;
      const ComponentId other = pair.a == c ? pair.b : pair.a;
      return has(around, other) && !has(removed, other);
    });
    if (c == ground || is_held || !has(around, c)) continue;
    if (can_fall(c, step.before, removed) && !can_fall(c, step.before, {})) unsupported.push_back(c);
  }
  return unsupported;
}

std::vector<ComponentId> stationary_components(const Assembly& assembly, Span<const WorkStep> steps) {
  std::vector<bool> moves(assembly.components.size());
  for (const WorkStep& step : steps)
    for (const RemovalMove& removal : step.removals)
      for (const ComponentId c : removal.components) moves[c.value] = true;
  std::vector<ComponentId> stationary;
  for (std::uint32_t c = 0; c < moves.size(); ++c)
    if (!moves[c]) stationary.emplace_back(c);
  std::stable_sort(stationary.begin(), stationary.end(), [&](ComponentId a, ComponentId b) {
    return diagonal(assembled_bounds(assembly[a])) > diagonal(assembled_bounds(assembly[b]));
  });
  return stationary;
}

std::vector<PartOverlaps> overlaps_of(const WorkStep& step, const PairStates& pairs,
                                      const std::vector<std::size_t>& lines) {
  std::vector<ComponentId> moving;
  for (const RemovalMove& removal : step.removals)
    moving.insert(moving.end(), removal.components.begin(), removal.components.end());
  const std::vector<ComponentId> around = surroundings(step, step.removals.front());
  std::vector<PartOverlaps> found;
  for (const ComponentPair& pair : pairs.pairs) {
    if (pair.state != PairState::Overlapping && pair.state != PairState::Free) continue;
    if (has(moving, pair.a) == has(moving, pair.b)) continue;
    const ComponentId own = has(moving, pair.a) ? pair.a : pair.b, other = own == pair.a ? pair.b : pair.a;
    if (!has(around, other)) continue;
    const std::size_t line = lines[own.value], other_line = lines[other.value];
    auto part = std::find_if(found.begin(), found.end(), [&](const PartOverlaps& p) { return p.line == line; });
    if (part == found.end()) part = found.insert(part, {line, {}, {}});
    auto with = std::find_if(part->with.begin(), part->with.end(), [&](const PartOverlaps::With& w) {
      return w.line == other_line && w.state == pair.state;
    });
    if (with == part->with.end()) with = part->with.insert(with, {other_line, pair.depth, pair.depth, pair.state, {}});
    with->least = std::min(with->least, pair.depth);
    with->depth = std::max(with->depth, pair.depth);
    add_once(part->own, own);
    add_once(with->components, other);
  }
  return found;
}

}  // namespace dismantle
