// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/removal_facts.h"

#include "dismantle/session/session_path.h"

#include <algorithm>

namespace dismantle {

namespace {

/// What is gone stands so many diagonals of the assembly off.
constexpr double kFarAway = 100;
/// So many screws of a way are looked at, at most: of more, every n-th.
constexpr std::size_t kMaxPlaces = 60;

bool has(Span<const ComponentId> set, ComponentId c) {
  return std::find(set.begin(), set.end(), c) != set.end();
}

/// What neither moves nor stands to what does as assembled: earlier steps have put it anywhere.
std::vector<ComponentId> put_aside_before(const WorkStep& step, const RemovalMove& removal) {
  const std::vector<ComponentId> around = surroundings(step, removal);
  std::vector<ComponentId> aside;
  for (std::uint32_t c = 0; c < step.before.size(); ++c)
    if (!has(around, ComponentId(c)) && !has(removal.components, ComponentId(c))) aside.emplace_back(c);
  return aside;
}

}  // namespace

RemovalFacts::RemovalFacts(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options)
    : assembly_(assembly), pairs_(pairs), engine_(assembly, pairs, options) {}

PathClearance RemovalFacts::clearance(const WorkStep& step, const RemovalMove& removal) {
  const Aabb box = bounds_of(assembly_, removal.components);
  const double near = kNearShare * diagonal(box);
  const int pieces = removal.poses.size() > kWayPieces ? 1 : kWayPieces;
  const std::vector<PathPose> places = poses_along(removal, box.center(), pieces);
  const std::size_t stride = 1 + places.size() / kMaxPlaces;
  std::vector<Pose> poses = with_gone(step.before, put_aside_before(step, removal));
  PathClearance found;
  for (std::size_t i = 0; i < places.size(); i += stride) {
    for (const ComponentId c : removal.components) poses[c.value] = places[i].pose;
    engine_.jump(poses);
    engine_.hold(removal.components);
    const double least = std::min(found.least, near);
    const Clearance now = engine_.clearance(std::max(least, 2 * pairs_.tolerance));
    if (now.distance <= pairs_.tolerance) {
      found = PathClearance{};
      found.touching = places[i].distance;
      found.touched = now.fixed;
    } else if (now.distance < least && now.fixed != found.touched) {
      found.least = now.distance;
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

std::vector<Pose> RemovalFacts::with_gone(Span<const Pose> poses, Span<const ComponentId> gone) const {
  const double away = kFarAway * diagonal(assembled_bounds(assembly_));
  std::vector<Pose> now(poses.begin(), poses.end());
  for (const ComponentId g : gone) now[g.value] = {{away, 0, 0}, {}};
  return now;
}

bool RemovalFacts::can_fall(ComponentId c, Span<const Pose> poses, Span<const ComponentId> gone) {
  const std::vector<Pose> now = with_gone(poses, gone);
  engine_.jump(now);
  engine_.hold({&c, 1});
  Pose fallen = now[c.value];
  fallen.position.z -= kFall * diagonal(bounds_at(assembly_[c], fallen));
  return engine_.first_contacts({&fallen, 1})[0].free;
}

std::vector<ComponentId> RemovalFacts::left_unsupported(const WorkStep& step, ComponentId ground) {
  std::vector<ComponentId> gone;
  for (const RemovalMove& removal : step.removals)
    gone.insert(gone.end(), removal.components.begin(), removal.components.end());
  const std::vector<ComponentId> around = surroundings(step, step.removals.front());

  std::vector<ComponentId> unsupported;
  for (const ComponentId c : neighbours(gone)) {
    const bool is_held = std::any_of(pairs_.pairs.begin(), pairs_.pairs.end(), [&](const ComponentPair& pair) {
      const bool grips = pair.state == PairState::Fit || pair.state == PairState::Embedded;
      if (!grips || (pair.a != c && pair.b != c)) return false;
      const ComponentId other = pair.a == c ? pair.b : pair.a;
      return has(around, other) && !has(gone, other);
    });
    if (c == ground || is_held || !has(around, c)) continue;
    if (can_fall(c, step.before, gone) && !can_fall(c, step.before, {})) unsupported.push_back(c);
  }
  return unsupported;
}

std::vector<ComponentId> staying_components(const Assembly& assembly, Span<const WorkStep> steps) {
  std::vector<bool> moves(assembly.components.size());
  for (const WorkStep& step : steps)
    for (const RemovalMove& removal : step.removals)
      for (const ComponentId c : removal.components) moves[c.value] = true;
  std::vector<ComponentId> staying;
  for (std::uint32_t c = 0; c < moves.size(); ++c)
    if (!moves[c]) staying.emplace_back(c);
  std::stable_sort(staying.begin(), staying.end(), [&](ComponentId a, ComponentId b) {
    return diagonal(assembled_bounds(assembly[a])) > diagonal(assembled_bounds(assembly[b]));
  });
  return staying;
}

}  // namespace dismantle
