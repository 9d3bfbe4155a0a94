// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/screw_search.h"

#include "dismantle/math/angle.h"
#include "dismantle/math/screw.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace dismantle {

namespace {

/// Distance at which faces count as those of one thread, first [tolerances] and at most [share of the component's
/// size]: loose threads have wide gaps.
constexpr double kFirstReach = 2;
constexpr double kLargestReach = 0.05;
constexpr double kReachGrowth = 4;
/// Number of face pairs that is enough.
constexpr std::size_t kEnoughContacts = 8192;

/// One turn [rad]; a component that advances by less than a share of it is stuck, unless it happens once.
constexpr double kHandTurn = 0.25;
constexpr double kStuckShare = 0.3;
constexpr int kStuckTurns = 3;
/// Rotation after which the achieved lead is more exact than the measured one [rad].
constexpr double kTurnToLearn = 3;
/// A component that has turned this many times as often as its exit distance requires only spins.
constexpr double kMaxTurns = 2;
/// Turns between tests whether the component has left the thread.
constexpr int kTurnsToLook = 12;

/// The smooth patches of the near faces of an assembled component.
void add_samples(const Component& component, const std::set<FaceId>& near, std::vector<SurfaceSample>& samples) {
  const TriangleMesh mesh = assembled_mesh(component);
  std::vector<std::uint8_t> of_interest(mesh.faces.size());
  for (const FaceId f : near) of_interest[f.value] = 1;
  const std::vector<SurfaceSample> own = smooth_samples(mesh, of_interest);
  samples.insert(samples.end(), own.begin(), own.end());
}

/// The screw motion by `angle` [rad] along a thread.
Pose screw_motion(const ThreadAxis& thread, double angle) {
  Screw screw;
  screw.reference = thread.point;
  screw.velocity = angle / kTurn * thread.lead * thread.direction;
  screw.axis = angle < 0 ? -thread.direction : thread.direction;
  screw.angle = std::abs(angle);
  return screw_at(screw, 1);
}

/// Turns in one sense as long as it advances.
std::optional<PlanStep> turn_out(LocalPlanner& local_planner, ThreadAxis thread, double turn, double exit_distance,
                                 const KeepGoing& keep_going) {
  const Vec3 exit = turn * thread.lead > 0 ? thread.direction : -thread.direction;
  std::vector<Pose> way;
  const double max_turned = kMaxTurns * kTurn * (1 + exit_distance / std::abs(thread.lead));
  double turned = 0, risen = 0;
  for (int turns = 1, stuck = 0; stuck < kStuckTurns && std::abs(turned) < max_turned && keep_going(); ++turns) {
    const Pose before = local_planner.pose();
    const StepResult made = local_planner.slide(screw_motion(thread, turn) * before);
    way.insert(way.end(), made.poses.begin(), made.poses.end());

    const Screw screw = screw_between(before, made.pose);
    const double angle = screw.angle * dot(screw.axis, thread.direction);
    turned += angle;
    risen += dot(screw.velocity + angle * cross(thread.direction, thread.point - screw.reference), thread.direction);
    // The flanks determine the lead best.
    if (std::abs(turned) > kTurnToLearn) thread.lead = kTurn * risen / turned;
    const bool moved = angle / turn > kStuckShare;
    stuck = moved ? 0 : stuck + 1;
    if (turns % kTurnsToLook == 0 && moved && local_planner.exits(exit, exit_distance + std::abs(risen)))
      return PlanStep{{}, PlanTier::Helical, PlanStep::kWhole, std::move(way), exit};
  }
  return std::nullopt;
}

}  // namespace

std::vector<NeighbourThread> touched_threads(const Assembly& assembly, const CertificateEngine& engine, double radius,
                                             double tolerance) {
  struct Near {
    ComponentId component;
    std::set<FaceId> own, others;
  };
  std::map<ComponentId, ThreadAxis> threads;
  for (double reach = kFirstReach * tolerance; reach < kLargestReach * radius; reach *= kReachGrowth) {
    const std::vector<ContactPoint> contacts = engine.contacts(reach);
    std::map<ComponentId, Near> faces;
    for (const ContactPoint& c : contacts) {
      if (threads.count(c.fixed) > 0) continue;
      Near& near = faces[c.fixed];
      near.component = c.moving;
      near.own.insert(c.face_moving);
      near.others.insert(c.face_fixed);
    }
    for (const auto& [neighbour, near] : faces) {
      std::vector<SurfaceSample> samples;
      add_samples(assembly[near.component], near.own, samples);
      add_samples(assembly[neighbour], near.others, samples);
      if (const auto thread = fit_thread(samples)) threads.emplace(neighbour, *thread);
    }
    if (contacts.size() > kEnoughContacts) break;
  }
  std::vector<NeighbourThread> found;
  found.reserve(threads.size());
  for (const auto& [neighbour, thread] : threads) found.push_back({neighbour, thread});
  return found;
}

PathSearch screw_out(MotionValidator& validator, const BlockingTable& table, ComponentId component,
                     const ThreadAxis& thread, const KeepGoing& keep_going) {
  PathSearch search;
  std::set<ComponentId> met;
  for (const double turn : {kHandTurn, -kHandTurn}) {
    LocalPlanner local_planner(validator, component);
    search.step = turn_out(local_planner, thread, turn, table.max_exit_distance(component), keep_going);
    for (const ComponentId c : local_planner.met()) met.insert(c);
    if (!search.step) continue;
    search.step->components = {component};
    break;
  }
  search.met.assign(met.begin(), met.end());
  return search;
}

}  // namespace dismantle
