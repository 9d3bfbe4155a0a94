// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/sweep/certificate_sweeper.h"

#include "dismantle/core/contract.h"
#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace dismantle {

namespace {

/// Effort::Quick ends after so many steps, or one that is less than this share of the tolerance [of path length].
constexpr int kQuickSteps = 6;
constexpr double kQuickShare = 1e-2;

/// Effort::Some ends with about so many blocked pairs of two components.
constexpr std::size_t kSomeBlocked = 32;

/// `pose` in the frame of something at `frame`; exact where that is the assembled pose.
Pose seen_from(const Pose& frame, const Pose& pose) {
  return frame == Pose{} ? pose : inverse(frame) * pose;
}

bool before(const BlockedPair& x, const BlockedPair& y) {
  if (x.moving != y.moving) return x.moving < y.moving;
  if (x.fixed != y.fixed) return x.fixed < y.fixed;
  if (x.face_moving != y.face_moving) return x.face_moving < y.face_moving;
  return x.face_fixed < y.face_fixed;
}

}  // namespace

/// A pair whose spheres may come near each other in a sweep.
struct CertificateSweeper::ActivePair {
  ComponentId moving, fixed;
  CertificateFront* front;
  TrianglePairSweep leaves;
  PreparedSweep sweep;
  double allowed;
  bool free = true;  ///< As far as was looked at by now.
};

/// A pair to be looked at with its fronts left as they are.
struct CertificateSweeper::Look {
  ComponentId moving, fixed;
  const TrianglePairSweep& leaves;
  const PairMotion& motion;
  double window;
};

/// One part of one front, and what its sweep found.
struct CertificateSweeper::PartTask {
  std::size_t pair, part;
  double horizon = 1;  // what comes later would not happen
  FrontSweep found;
  std::vector<BlockedPair> blocked;
  std::size_t answered = 0;
};

CertificateSweeper::CertificateSweeper(const Assembly& assembly, const PairStates& pairs,
                                       const CertificateOptions& options, CertificateDevice device)
    : assembly_(&assembly),
      options_(options),
      kernels_(front_kernels(options.lanes)),
      rules_(pairs),
      poses_(assembly.components.size()),
      is_held_(assembly.components.size()),
      device_(std::move(device)) {
  for (const Component& c : assembly.components) {
    solids_.push_back(make_solid_tree(c, options.executor));
    const Aabb box = assembled_bounds(c);
    centers_.push_back(box.empty() ? Vec3{} : box.center());
    double radius = 0;
    for (const Vec3& p : solids_.back().vertices) radius = std::max(radius, length(p - centers_.back()));
    radii_.push_back(radius);
  }
  prepare_radial();
}

void CertificateSweeper::prepare_radial() {
  std::vector<std::pair<ComponentId, ComponentId>> near;
  for (std::uint32_t a = 0; a < solids_.size(); ++a)
    for (std::uint32_t b = a + 1; b < solids_.size(); ++b)
      if (solids_[a].revolution && solids_[b].revolution && sphere_gap(ComponentId(a), ComponentId(b), {}, {}, 0) <= 0)
        near.emplace_back(a, b);
  std::vector<std::vector<ThreadMatch>> threads(near.size());
  options_.executor.for_each_heavy(near.size(), [&](std::size_t i) {
    const SolidTree &a = solid(near[i].first), &b = solid(near[i].second);
    threads[i] = match_threads(*a.revolution, a.tree.origin, *b.revolution, b.tree.origin);
    PairMotion still;
    still.t0 = still.t1 = {{}, a.tree.origin - b.tree.origin};
    RadialSweeps(*a.revolution, a.tree.origin, *b.revolution, b.tree.origin, still).get();
  });
  for (std::size_t i = 0; i < near.size(); ++i)
    if (!threads[i].empty()) threads_[near[i]] = std::move(threads[i]);
}

void CertificateSweeper::hold(Span<const ComponentId> components) {
  DISMANTLE_EXPECT(!components.empty());
  held_.assign(components.begin(), components.end());
  std::sort(held_.begin(), held_.end());
  std::fill(is_held_.begin(), is_held_.end(), false);
  Aabb box;
  for (const ComponentId c : held_) {
    DISMANTLE_EXPECT(poses_[c.value] == pose());
    is_held_[c.value] = true;
    box.extend(assembled_bounds((*assembly_)[c]));
  }
  center_ = box.empty() ? Vec3{} : box.center();
  radius_ = 0;
  for (const ComponentId c : held_)
    for (const Vec3& p : solids_[c.value].vertices) radius_ = std::max(radius_, length(p - center_));
}

double CertificateSweeper::deviation(const Pose& start, const Pose& end) const {
  const Screw screw = screw_between(start, end);
  return screw_chord_deviation(screw, screw_radius(screw, transform_from_pose(start) * center_, radius_));
}

double CertificateSweeper::travel(const Pose& start, const Pose& end) const {
  const Screw screw = screw_between(start, end);
  return screw_path_length(screw, screw_radius(screw, transform_from_pose(start) * center_, radius_));
}

double CertificateSweeper::allowed(ComponentId a, ComponentId b) const {
  const PairRule rule = rules_.view().find(std::min(a, b).value, std::max(a, b).value);
  return rule.test == PairTest::Discrete ? -1 : rule.allowed_penetration;
}

bool CertificateSweeper::touched(ComponentId a, ComponentId b) const {
  return rules_.view().find(std::min(a, b).value, std::max(a, b).value).test != PairTest::Ordinary;
}

CertificateSweeper::FrontEntry& CertificateSweeper::front_of(ComponentId moving, ComponentId fixed) {
  const ComponentId a = std::min(moving, fixed), b = std::max(moving, fixed);
  auto found = fronts_.find({a, b});
  if (found == fronts_.end())
    found = fronts_.emplace(std::pair{a, b}, FrontEntry{roots(a, b, sides(a, b)), false, {}}).first;
  FrontEntry& entry = found->second;
  if (entry.b_moves != (moving == b)) {
    const Mat3 of_moving = mat3_from_quat(poses_[moving.value].rotation);
    const Mat3 of_fixed = mat3_from_quat(poses_[fixed.value].rotation);
    // What stands still now is what moved so far.
    entry.front.exchange_roles(transposed(of_moving) * of_fixed);
    entry.b_moves = moving == b;
  } else if (!(entry.fixed_pose == poses_[fixed.value])) {
    entry.front.forget();
  }
  entry.fixed_pose = poses_[fixed.value];
  return entry;
}

CertificateFront CertificateSweeper::roots(ComponentId a, ComponentId b, SideRule sides) const {
  const auto threads = threads_.find({a, b});
  return {solid(a).tree,
          solid(b).tree,
          sides,
          solid(a).revolution.get(),
          solid(b).revolution.get(),
          threads == threads_.end() ? Span<const ThreadMatch>{} : threads->second};
}

SideRule CertificateSweeper::sides(ComponentId a, ComponentId b) const {
  if (!solid(a).has_outside || !solid(b).has_outside) return SideRule::Memory;
  return allowed(a, b) > tolerance() ? SideRule::Free : SideRule::Normals;
}

TrianglePairSweep CertificateSweeper::triangle_pair_sweep(ComponentId moving, ComponentId fixed, const Pose& start,
                                                          const Pose& end, Effort effort) const {
  const Pose& frame = poses_[fixed.value];
  TrianglePairRules rules{allowed(moving, fixed), tolerance(), sides(moving, fixed), {}};
  if (effort == Effort::Quick || effort == Effort::Fits) {
    rules.limits.steps = kQuickSteps;
    rules.limits.min_progress = std::max(rules.limits.min_progress, kQuickShare * tolerance() / travel(start, end));
  }
  return TrianglePairSweep(solid(moving), solid(fixed), seen_from(frame, start), seen_from(frame, end),
                           deviation(start, end), rules);
}

TrianglePairResult CertificateSweeper::sweep_pair(const BlockedPair& pair, const Pose& end) const {
  return triangle_pair_sweep(pair.moving, pair.fixed, pose(), end, Effort::Quick)
      .test(pair.face_moving.value, pair.face_fixed.value, pair.axis);
}

CertificateSweep CertificateSweeper::sweep_pairs(Span<const BlockedPair> pairs, const Pose& end, double window) const {
  CertificateSweep result;
  std::optional<TrianglePairSweep> leaves;
  const BlockedPair* last = nullptr;
  for (const BlockedPair& pair : pairs) {
    if (!last || last->moving != pair.moving || last->fixed != pair.fixed)
      leaves.emplace(triangle_pair_sweep(pair.moving, pair.fixed, pose(), end, Effort::Full));
    last = &pair;
    const TrianglePairResult found = leaves->test(pair.face_moving.value, pair.face_fixed.value, pair.axis);
    ++result.triangle_tests;
    if (found.free) continue;
    result.blocked.push_back(pair);
    result.blocked.back().toi = found.contact.toi;
    result.blocked.back().axis = found.contact.axis;
  }
  finish(result, window);
  return result;
}

double CertificateSweeper::sphere_gap(ComponentId moving, ComponentId fixed, const RigidTransform& start,
                                      const RigidTransform& end, double deviation) const {
  const Pose& pose_fixed = poses_[fixed.value];
  const Vec3 from = start * centers_[moving.value], way = end * centers_[moving.value] - from;
  const Vec3 other =
      pose_fixed == Pose{} ? centers_[fixed.value] : transform_from_pose(pose_fixed) * centers_[fixed.value];
  const double length2 = length_squared(way);
  const double nearest = length2 > 0 ? std::clamp(dot(other - from, way) / length2, 0.0, 1.0) : 0;
  const double margin = 1e-9 * (max_abs(from) + max_abs(way) + max_abs(other));
  return length(from + nearest * way - other) - radii_[moving.value] - radii_[fixed.value] - deviation - margin;
}

template <class Visit>
void CertificateSweeper::for_each_near(const Pose& start, const Pose& end, double reach, CertificateSweep& result,
                                       Visit visit) const {
  const RigidTransform from = transform_from_pose(start), to = transform_from_pose(end);
  const double bend = deviation(start, end);
  for (const ComponentId moving : held_) {
    if (solid(moving).tree.empty()) continue;
    for (std::uint32_t k = 0; k < poses_.size(); ++k) {
      const ComponentId fixed(k);
      if (is_held_[k] || solid(fixed).tree.empty()) continue;
      const double gap = sphere_gap(moving, fixed, from, to, bend);
      if (gap > reach) {
        result.clearance = std::min(result.clearance, gap);
      } else if (allowed(moving, fixed) >= 0) {
        visit(moving, fixed);
      }
    }
  }
}

TrianglePairTest CertificateSweeper::triangle_pair_test(const ActivePair& pair, PartTask& task, double window,
                                                        Span<const TrianglePairResult> answers) {
  return [&pair, &task, window, answers](std::uint32_t moving, std::uint32_t fixed, Vec3f hint, std::uint32_t answer) {
    // A device tests the whole motion; after a contact it is not looked at to its end any more.
    const bool answered = answer != PairResult::kNone && task.horizon == 1;
    task.answered += answered ? 1 : 0;
    const TrianglePairResult found =
        answered ? answers[answer] : pair.leaves.test(moving, fixed, {hint.x, hint.y, hint.z}, task.horizon);
    if (!found.free) {
      task.horizon = std::min(task.horizon, found.contact.toi + window);
      task.blocked.push_back(
          {pair.moving, pair.fixed, FaceId(moving), FaceId(fixed), found.contact.toi, found.contact.axis});
    }
    const float gap = -rounded_up(-found.gap);
    const bool cut_short = task.horizon < 1 && found.gap < -pair.allowed;
    return TrianglePairVerdict{found.free, gap, cut_short, found.no_deep_vertex_possible, pair.leaves.certificate(found, pair.sweep)};
  };
}

void CertificateSweeper::finish(CertificateSweep& result, double window) {
  std::sort(result.blocked.begin(), result.blocked.end(), before);
  for (const BlockedPair& b : result.blocked) result.toi = std::min(result.toi, b.toi);
  std::erase_if(result.blocked, [&](const BlockedPair& b) { return b.toi > result.toi + window; });
  result.free = result.blocked.empty() && result.fits.empty();
  result.clearance = result.free ? std::max(0.0, result.clearance) : 0;
}

CertificateSweep CertificateSweeper::sweep(const Pose& end, double window, Effort effort) {
  CertificateSweep result;
  result.clearance = std::numeric_limits<double>::infinity();
  std::vector<ActivePair> active;
  for_each_near(pose(), end, 0, result, [&](ComponentId moving, ComponentId fixed) {
    CertificateFront& front = front_of(moving, fixed).front;
    const TrianglePairSweep leaves = triangle_pair_sweep(moving, fixed, pose(), end, effort);
    PairMotion motion = leaves.motion();
    if (effort != Effort::Full) motion.max_blocked = kSomeBlocked;
    if (effort == Effort::Fits) motion.max_fit_deviation = tolerance();
    active.push_back({moving, fixed, &front, leaves, front.begin_sweep(motion), allowed(moving, fixed)});
  });
  std::vector<PartTask> tasks;
  for (std::size_t p = 0; p < active.size(); ++p)
    for (std::size_t part = 0; part < active[p].front->part_count(); ++part) tasks.push_back({p, part, 1, {}, {}, 0});

  FrontResults answers;
  const bool asks = asks_device(active);
  if (asks) {
    merge_by_device(active, tasks);
    answers = device_.fronts->ask(asked_fronts(active), effort == Effort::Full);
  }
  for_each_part(tasks.size(), [&](std::size_t i) {
    const ActivePair& pair = active[tasks[i].pair];
    if (!asks) pair.front->merge_part(tasks[i].part, pair.sweep, kernels_);
    tasks[i].found = pair.front->sweep_part(tasks[i].part, pair.sweep, kernels_,
                                            triangle_pair_test(pair, tasks[i], window, answers.leaves),
                                            asks ? &answers.parts[i] : nullptr);
  });

  for (PartTask& task : tasks) {
    const LinearSweep& sweep = active[task.pair].sweep;
    result.clearance = std::min<double>(result.clearance, task.found.min_gap - sweep.error);
    result.triangle_tests += task.found.triangle_tests;
    result.answered_tests += task.answered;
    result.complete &= task.found.complete;
    active[task.pair].free &= task.found.complete && task.found.blocked == 0;
    const std::pair both{active[task.pair].moving, active[task.pair].fixed};
    if (task.found.touching && (result.touching.empty() || result.touching.back() != both))
      result.touching.push_back(both);
    result.blocked.insert(result.blocked.end(), task.blocked.begin(), task.blocked.end());
    for (const CylinderFit& fit : task.found.fits) result.fits.push_back({both.first, both.second, fit});
  }
  for (const ActivePair& pair : active) {
    pair.front->end_sweep(pair.sweep, pair.free);
    result.front += pair.front->size();
  }
  finish(result, window);
  return result;
}

template <class Run>
void CertificateSweeper::for_each_part(std::size_t count, const Run& run) const {
  if (count == 1) {
    run(0);
  } else {
    options_.executor.for_each_heavy(count, run);
  }
}

bool CertificateSweeper::asks_device(const std::vector<ActivePair>& active) const {
  if (!device_.fronts || active.empty()) return false;
  std::size_t pairs = 0;
  for (const ActivePair& pair : active) pairs += pair.front->size();
  return pairs >= device_.min_pairs;
}

std::vector<FrontQuery> CertificateSweeper::asked_fronts(const std::vector<ActivePair>& active) {
  std::vector<FrontQuery> fronts;
  fronts.reserve(active.size());
  for (const ActivePair& pair : active) fronts.push_back({pair.front, &pair.sweep, &pair.leaves});
  return fronts;
}

void CertificateSweeper::merge_by_device(const std::vector<ActivePair>& active, const std::vector<PartTask>& tasks) {
  std::vector<std::vector<Siblings>> siblings(tasks.size());
  for_each_part(tasks.size(), [&](std::size_t i) {
    const ActivePair& pair = active[tasks[i].pair];
    siblings[i] = pair.front->siblings_of(tasks[i].part, pair.sweep);
  });
  std::vector<std::size_t> begins;
  std::vector<MergeCandidate> parents;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    begins.push_back(parents.size());
    for (const Siblings& s : siblings[i])
      parents.push_back({static_cast<std::uint32_t>(tasks[i].pair), s.parent.a, s.parent.b, s.hint});
  }
  if (parents.empty()) return;
  const Span<const NodeSeparation> separations = device_.fronts->separate(asked_fronts(active), parents);
  for_each_part(tasks.size(), [&](std::size_t i) {
    const ActivePair& pair = active[tasks[i].pair];
    pair.front->merge_part(tasks[i].part, pair.sweep, kernels_, siblings[i],
                           separations.subspan(begins[i], siblings[i].size()));
  });
}

CertificateSweep CertificateSweeper::look(const Pose& start, const Pose& end, double window) const {
  CertificateSweep result;
  result.clearance = std::numeric_limits<double>::infinity();
  for_each_near(start, end, 0, result, [&](ComponentId moving, ComponentId fixed) {
    const ComponentId a = std::min(moving, fixed), b = std::max(moving, fixed);
    const auto known = fronts_.find({a, b});
    const bool usable = known != fronts_.end() && known->second.b_moves == (moving == b) &&
                        known->second.fixed_pose == poses_[fixed.value];
    const CertificateFront anew = roots(moving, fixed, sides(moving, fixed));
    const CertificateFront& front = usable ? known->second.front : anew;
    const TrianglePairSweep leaves = triangle_pair_sweep(moving, fixed, start, end, Effort::Full);
    const PairMotion motion = leaves.motion();
    look_at(front, {moving, fixed, leaves, motion, window}, result);
  });
  finish(result, window);
  return result;
}

CertificateSweep CertificateSweeper::look_straight(const StraightWay& asked, double from, double to) const {
  const ComponentId moving = asked.moving, fixed = asked.fixed;
  CertificateSweep result;
  const double allowance = allowed(moving, fixed);
  if (allowance < 0 || solid(moving).tree.empty() || solid(fixed).tree.empty()) return result;
  const auto at = [&](double share) {
    return seen_from(asked.fixed_at, {asked.moving_at.position + share * asked.way, asked.moving_at.rotation});
  };
  const TrianglePairSweep leaves(solid(moving), solid(fixed), at(from), at(to), 0,
                                 {allowance, tolerance(), sides(moving, fixed), {}, false});
  PairMotion motion = leaves.motion();
  motion.max_blocked = 1;
  look_at(roots(moving, fixed, sides(moving, fixed)), {moving, fixed, leaves, motion, 0}, result);
  finish(result, 0);
  return result;
}

void CertificateSweeper::look_at(const CertificateFront& front, const Look& look, CertificateSweep& result) const {
  const ActivePair pair{
      look.moving, look.fixed, nullptr, look.leaves, front.prepare_sweep(look.motion), allowed(look.moving, look.fixed)};
  PartTask task{0, 0, std::min(1.0, result.toi + look.window), {}, {}, 0};
  const FrontSweep found = front.look(pair.sweep, kernels_, triangle_pair_test(pair, task, look.window));
  for (const BlockedPair& blocked : task.blocked) result.toi = std::min(result.toi, blocked.toi);
  result.blocked.insert(result.blocked.end(), task.blocked.begin(), task.blocked.end());
  result.clearance = std::min<double>(result.clearance, found.min_gap - pair.sweep.error);
  result.complete &= found.complete;
  result.triangle_tests += found.triangle_tests;
  result.front += front.size();
}

std::vector<BlockedPair> CertificateSweeper::near_pairs(double reach) const {
  std::vector<BlockedPair> pairs;
  CertificateSweep unused;
  for_each_near(pose(), pose(), reach, unused, [&](ComponentId moving, ComponentId fixed) {
    const CertificateFront front = roots(moving, fixed, SideRule::Free);
    PairMotion motion = triangle_pair_sweep(moving, fixed, pose(), pose(), Effort::Full).motion();
    motion.allowed = -reach;
    const TrianglePairTest take = [&](std::uint32_t face_moving, std::uint32_t face_fixed, Vec3f, std::uint32_t) {
      pairs.push_back({moving, fixed, FaceId(face_moving), FaceId(face_fixed), 0, {}});
      return TrianglePairVerdict{};
    };
    front.look(front.prepare_sweep(motion), kernels_, take);
  });
  std::sort(pairs.begin(), pairs.end(), before);
  return pairs;
}

void CertificateSweeper::move_to(const Pose& pose) {
  for (const ComponentId c : held_) poses_[c.value] = pose;
}

void CertificateSweeper::jump(Span<const Pose> poses) {
  DISMANTLE_EXPECT(poses.size() == poses_.size());
  poses_.assign(poses.begin(), poses.end());
}

std::size_t CertificateSweeper::front_size() const {
  std::size_t size = 0;
  for (const auto& [pair, entry] : fronts_)
    if (is_held_[pair.first.value] != is_held_[pair.second.value]) size += entry.front.size();
  return size;
}

}  // namespace dismantle
