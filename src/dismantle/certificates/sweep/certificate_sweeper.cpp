// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/sweep/certificate_sweeper.h"

#include "dismantle/certificates/sweep/sweep_tasks.h"
#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <limits>

namespace dismantle {

namespace {

/// A sampled sweep ends with about this many blocked pairs of two components.
constexpr std::size_t kSampleSize = 32;
/// It examines this many parts of fronts at a time, and ends after those with which this many pairs are blocked.
constexpr std::size_t kPartsAtATime = 16, kEnoughBlocked = 64;
/// Every sweep may examine at least this many node pairs, even after its step has reached the limit.
constexpr std::size_t kFewestNodePairs = 512;

/// The one of the moving (first) and the fixed (second) component that is represented by its ghost.
GhostOf ghost_of(SurfacePair surfaces) {
  switch (surfaces) {
    case SurfacePair::Plain:
      return GhostOf::None;
    case SurfacePair::MovingGhost:
      return GhostOf::First;
    case SurfacePair::FixedGhost:
      return GhostOf::Second;
    case SurfacePair::MovingMirrored:
      return GhostOf::FirstMirrored;
    case SurfacePair::FixedMirrored:
      return GhostOf::SecondMirrored;
  }
  return GhostOf::None;
}

}  // namespace

void sort_blocked(std::vector<SweepContact>& pairs) {
  std::sort(pairs.begin(), pairs.end(), [](const SweepContact& x, const SweepContact& y) {
    if (x.moving != y.moving) return x.moving < y.moving;
    if (x.fixed != y.fixed) return x.fixed < y.fixed;
    if (x.surfaces != y.surfaces) return x.surfaces < y.surfaces;
    if (x.face_moving != y.face_moving) return x.face_moving < y.face_moving;
    return x.face_fixed < y.face_fixed;
  });
}

CertificateSweeper::CertificateSweeper(const Assembly& assembly, const PairStates& pairs,
                                       const CertificateOptions& options, CertificateDevice device)
    : options_(options),
      kernels_(front_kernels(options.lanes)),
      tolerance_(pairs.tolerance),
      store_(std::make_shared<const AssemblySurfaces>(assembly, pairs, options)),
      device_(std::move(device)),
      near_(store_.spheres()),
      poses_(assembly.components.size()),
      is_moving_(assembly.components.size()),
      guarded_of_(assembly.components.size()),
      is_changed_(assembly.components.size()) {
  options_.prepared = nullptr;
  for (const auto& [key, pair] : store_.surfaces()->pairs()) {
    guarded_[key] = pair.guard;
    guarded_of_[key.first.value].push_back(key.second);
    guarded_of_[key.second.value].push_back(key.first);
  }
}

ScrewMotion CertificateSweeper::motion_between(const Pose& start, const Pose& end) const {
  return screw_motion(start, end, transform_from_pose(start) * center_, radius_);
}

template <class Visit>
void CertificateSweeper::for_each_near(const ScrewMotion& motion, double reach, CertificateSweep& result,
                                       Visit visit) const {
  const RigidTransform from = transform_from_pose(motion.start), to = transform_from_pose(motion.end);
  std::vector<ComponentId> near;
  for (const ComponentId moving : moving_) {
    if (solid(moving).tree.empty()) continue;
    near.clear();
    // Components that are further away than the clearance found so far cannot lower it.
    const auto limit = [&] { return std::max(reach, result.clearance); };
    near_.for_each(store_.spheres().swept(moving, from, to, motion.deviation), limit,
                   [&](ComponentId fixed, double gap) {
                     if (is_moving_[fixed.value] || solid(fixed).tree.empty()) return;
                     if (gap > reach) {
                       result.clearance = std::min(result.clearance, gap);
                     } else {
                       near.push_back(fixed);
                     }
                   });
    std::sort(near.begin(), near.end());
    for (const ComponentId fixed : near) visit(moving, fixed);
  }
}

template <class Run>
void CertificateSweeper::for_each_part(std::size_t count, const Run& run) const {
  if (count == 1) {
    run(0);
  } else {
    options_.executor.for_each_heavy(count, run);
  }
}

TrianglePairTest CertificateSweeper::triangle_pair_test(const PairSweep& pair, PartTask& task, double window) {
  return [&pair, &task, window](const TrianglePairCandidate& candidate) {
    // A device tests the whole motion; after a contact only the time up to the horizon is tested.
    const bool by_device = candidate.known && task.horizon == 1;
    task.device_tests += by_device ? 1 : 0;
    const Vec3f hint = candidate.hint;
    const TrianglePairResult found = by_device ? *candidate.known
                                               : pair.triangle_pairs.test(candidate.face_moving, candidate.face_fixed,
                                                                          {hint.x, hint.y, hint.z}, task.horizon);
    if (!found.free) {
      task.horizon = std::min(task.horizon, found.contact.toi + window);
      task.blocked.push_back({pair.tested.moving, pair.tested.fixed, FaceId(candidate.face_moving),
                              FaceId(candidate.face_fixed), found.contact.toi, found.contact.axis,
                              pair.tested.surfaces});
    }
    const float gap = -rounded_up(-found.gap);
    const bool cut_short = task.horizon < 1 && found.gap < 0;
    return TrianglePairVerdict{found.free, gap, cut_short, pair.triangle_pairs.certificate(found)};
  };
}

void CertificateSweeper::finish(CertificateSweep& result, double window) {
  sort_blocked(result.blocked);
  for (const SweepContact& b : result.blocked) result.toi = std::min(result.toi, b.toi);
  std::erase_if(result.blocked, [&](const SweepContact& b) { return b.toi > result.toi + window; });
  result.free = result.blocked.empty() && result.fits.empty() && !result.cut;
  result.clearance = result.free ? std::max(0.0, result.clearance) : 0;
}

std::vector<CertificateSweeper::PairSweep> CertificateSweeper::prepare_pairs(const ScrewMotion& motion,
                                                                             SweepBudget budget,
                                                                             CertificateSweep& result,
                                                                             std::vector<SeenMotion>& depths) {
  std::vector<PairSweep> pairs;
  for_each_near(motion, 0, result, [&](ComponentId moving, ComponentId fixed) {
    if (guarded(moving, fixed).guard == PairGuard::Depth) depths.push_back(motion_past(motion, moving, fixed));
    for (const SurfacePair surfaces : surface_pairs(moving, fixed)) {
      const TestedPair tested{moving, fixed, surfaces};
      CertificateFront& front = store_.prepare(moving, fixed, ghost_of(surfaces), poses_);
      const TrianglePairSweep triangle_pairs = triangle_pair_sweep(tested, motion, budget);
      PairMotion pair_motion = triangle_pairs.motion();
      if (budget != SweepBudget::Exhaustive) pair_motion.max_blocked = kSampleSize;
      if (budget == SweepBudget::WholeCylinders) pair_motion.max_fit_deviation = tolerance();
      pairs.push_back({tested, &front, triangle_pairs, front.prepare_sweep(pair_motion), displaced(moving, fixed)});
    }
  });
  return pairs;
}

CertificateSweep CertificateSweeper::sweep(const ScrewMotion& motion, double window, SweepBudget budget) {
  CertificateSweep result;
  result.clearance = std::numeric_limits<double>::infinity();
  std::vector<SeenMotion> depths;
  std::vector<PairSweep> pairs = prepare_pairs(motion, budget, result, depths);
  std::vector<PartTask> tasks;
  for (std::size_t p = 0; p < pairs.size(); ++p)
    for (std::size_t part = 0; part < pairs[p].front->part_count(); ++part) tasks.push_back({p, part, 1, {}, {}, 0});

  const DeviceResults by_device = ask_device(pairs, tasks, budget);
  std::size_t blocked = 0, node_pairs = 0;
  const std::size_t most = std::max(kFewestNodePairs, node_pairs_left_);
  for (std::size_t begin = 0; begin < tasks.size(); begin += kPartsAtATime) {
    const std::size_t count = std::min(kPartsAtATime, tasks.size() - begin);
    const bool cut = node_pairs >= most;
    const bool enough = cut || (budget != SweepBudget::Exhaustive && blocked >= kEnoughBlocked);
    for (std::size_t i = begin; i < begin + count && !enough; ++i)
      pairs[tasks[i].pair].sweep.max_node_pairs = (most - node_pairs) / count;
    for_each_part(count, [&](std::size_t offset) {
      PartTask& task = tasks[begin + offset];
      const PairSweep& pair = pairs[task.pair];
      if (!by_device.merged) pair.front->merge_part(task.part, pair.sweep, kernels_);
      if (enough) {
        task.found.complete = false;
        task.found.cut = cut;
      } else {
        task.found = pair.front->sweep_part(task.part, pair.sweep, kernels_, triangle_pair_test(pair, task, window),
                                            by_device.parts.empty() ? nullptr : &by_device.parts[begin + offset]);
      }
    });
    for (std::size_t i = begin; i < begin + count; ++i) {
      blocked += tasks[i].blocked.size();
      node_pairs += tasks[i].found.node_pairs;
    }
  }

  collect(tasks, pairs, result);
  sweep_depths(depths, window, result);
  for (const PairSweep& pair : pairs) {
    pair.front->end_sweep(pair.sweep, pair.free);
    result.front += pair.front->size();
  }
  finish(result, window);
  if (result.free) part_swept(pairs);
  return result;
}

void CertificateSweeper::collect(const std::vector<PartTask>& tasks, std::vector<PairSweep>& pairs,
                                 CertificateSweep& result) {
  for (const PartTask& task : tasks) {
    PairSweep& pair = pairs[task.pair];
    pair.apart_by = std::min(pair.apart_by, pair.clearance(task.found));
    result.clearance = std::min(result.clearance, pair.apart_by);
    result.node_pairs += task.found.node_pairs;
    result.triangle_tests += task.found.triangle_tests;
    result.device_tests += task.device_tests;
    result.complete &= task.found.complete;
    result.cut |= task.found.cut;
    pair.free &= task.found.complete && task.found.blocked == 0;
    const std::pair both{pair.tested.moving, pair.tested.fixed};
    result.blocked.insert(result.blocked.end(), task.blocked.begin(), task.blocked.end());
    for (const CylinderFit& fit : task.found.fits)
      result.fits.push_back({both.first, both.second, fit, pair.tested.surfaces});
  }
}

CertificateSweeper::DeviceResults CertificateSweeper::ask_device(const std::vector<PairSweep>& pairs,
                                                                 const std::vector<PartTask>& tasks,
                                                                 SweepBudget budget) {
  DeviceResults results;
  if (!device_.fronts || pairs.empty()) return results;
  try {
    merge_by_device(pairs, tasks);
    results.merged = true;
    results.parts = device_.fronts->evaluate(front_queries(pairs), budget == SweepBudget::Exhaustive);
  } catch (const CudaError& error) {
    device_.fronts = nullptr;
    if (device_.failure) device_.failure->why = error.what();
  }
  return results;
}

std::vector<FrontQuery> CertificateSweeper::front_queries(const std::vector<PairSweep>& pairs) {
  std::vector<FrontQuery> queries;
  queries.reserve(pairs.size());
  for (const PairSweep& pair : pairs) queries.push_back({pair.front, &pair.sweep, &pair.triangle_pairs});
  return queries;
}

void CertificateSweeper::merge_by_device(const std::vector<PairSweep>& pairs, const std::vector<PartTask>& tasks) {
  std::vector<std::vector<Siblings>> siblings(tasks.size());
  for_each_part(tasks.size(), [&](std::size_t i) {
    const PairSweep& pair = pairs[tasks[i].pair];
    siblings[i] = pair.front->siblings_of(tasks[i].part);
  });
  std::vector<std::size_t> begins;
  std::vector<MergeCandidate> candidates;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    begins.push_back(candidates.size());
    for (const Siblings& s : siblings[i])
      candidates.push_back({static_cast<std::uint32_t>(tasks[i].pair), s.parent.a, s.parent.b});
  }
  if (candidates.empty()) return;
  const Span<const NodeSeparation> separations = device_.fronts->separate(front_queries(pairs), candidates);
  for_each_part(tasks.size(), [&](std::size_t i) {
    const PairSweep& pair = pairs[tasks[i].pair];
    pair.front->merge_part(tasks[i].part, pair.sweep, kernels_, siblings[i],
                           separations.subspan(begins[i], siblings[i].size()));
  });
}

CertificateSweeper::SeenMotion CertificateSweeper::motion_past(const ScrewMotion& motion, ComponentId moving,
                                                               ComponentId fixed) const {
  const Pose& frame = poses_[fixed.value];
  return {moving, fixed, seen_from(frame, motion.start), seen_from(frame, motion.end)};
}

CertificateSweep CertificateSweeper::sweep_const(const ScrewMotion& motion, double window, const Pose& goal) const {
  CertificateSweep result;
  result.clearance = std::numeric_limits<double>::infinity();
  for_each_near(motion, 0, result, [&](ComponentId moving, ComponentId fixed) {
    sweep_depth(motion_past(motion, moving, fixed), DeepSearch::First, result);
    for (const SurfacePair surfaces : surface_pairs(moving, fixed, pose(), goal, poses_[fixed.value])) {
      const TestedPair tested{moving, fixed, surfaces};
      std::optional<CertificateFront> fresh;
      const CertificateFront* front = store_.find(moving, fixed, ghost_of(surfaces), poses_[fixed.value]);
      if (!front) front = &fresh.emplace(store_.new_front(moving, fixed, ghost_of(surfaces)));
      const TrianglePairSweep triangle_pairs = triangle_pair_sweep(tested, motion, SweepBudget::Exhaustive);
      sweep_const(
          *front,
          {tested, nullptr, triangle_pairs, front->prepare_sweep(triangle_pairs.motion()), displaced(moving, fixed)},
          window, result);
    }
  });
  finish(result, window);
  return result;
}

CertificateSweep CertificateSweeper::sweep_linear(const LinearMotion& motion, double from, double to,
                                                  DeepSearch search_for, std::size_t max_pieces) const {
  const ComponentId moving = motion.moving, fixed = motion.fixed;
  CertificateSweep result;
  if (solid(moving).tree.empty() || solid(fixed).tree.empty()) return result;
  const auto at = [&](double share) {
    return seen_from(motion.pose_fixed,
                     {motion.pose_moving.position + share * motion.displacement, motion.pose_moving.rotation});
  };
  sweep_depth({moving, fixed, at(from), at(to)}, search_for, result, 1, nullptr, max_pieces);
  const Pose whole_end{motion.pose_moving.position + motion.displacement, motion.pose_moving.rotation};
  for (const SurfacePair surfaces : surface_pairs(moving, fixed, motion.pose_moving, whole_end, motion.pose_fixed)) {
    const TestedPair tested{moving, fixed, surfaces};
    const TrianglePairSweep triangle_pairs(moving_surface(tested), fixed_surface(tested), at(from), at(to), 0,
                                           tolerance());
    PairMotion pair_motion = triangle_pairs.motion();
    pair_motion.max_blocked = 1;
    const CertificateFront front = store_.new_front(moving, fixed, ghost_of(surfaces));
    sweep_const(front, {tested, nullptr, triangle_pairs, front.prepare_sweep(pair_motion), 0}, 0, result);
  }
  finish(result, 0);
  return result;
}

void CertificateSweeper::sweep_const(const CertificateFront& front, const PairSweep& pair, double window,
                                     CertificateSweep& result) const {
  PartTask task{0, 0, std::min(1.0, result.toi + window), {}, {}, 0};
  const FrontSweep found = front.sweep_const(pair.sweep, kernels_, triangle_pair_test(pair, task, window));
  for (const SweepContact& blocked : task.blocked) result.toi = std::min(result.toi, blocked.toi);
  result.blocked.insert(result.blocked.end(), task.blocked.begin(), task.blocked.end());
  result.clearance = std::min(result.clearance, pair.clearance(found));
  result.complete &= found.complete;
  result.triangle_tests += found.triangle_tests;
  result.front += front.size();
}

void CertificateSweeper::add_near_faces(ComponentId moving, ComponentId fixed, const ScrewMotion& rest, double reach,
                                        std::vector<SweepContact>& pairs) const {
  const CertificateFront front = store_.new_front(moving, fixed, GhostOf::None);
  PairMotion motion = triangle_pair_sweep({moving, fixed}, rest, SweepBudget::Exhaustive).motion();
  motion.allowed = -reach;
  const TrianglePairTest take = [&](const TrianglePairCandidate& candidate) {
    pairs.push_back({moving, fixed, FaceId(candidate.face_moving), FaceId(candidate.face_fixed), 0, {}});
    return TrianglePairVerdict{};
  };
  front.sweep_const(front.prepare_sweep(motion), kernels_, take);
}

std::vector<SweepContact> CertificateSweeper::near_pairs(double reach) const {
  std::vector<SweepContact> pairs;
  if (moving_.empty()) return pairs;
  CertificateSweep unused;
  const ScrewMotion rest = motion_to(pose());
  for_each_near(rest, reach, unused,
                [&](ComponentId moving, ComponentId fixed) { add_near_faces(moving, fixed, rest, reach, pairs); });
  sort_blocked(pairs);
  return pairs;
}

std::vector<SweepContact> CertificateSweeper::near_pairs(ComponentId moving, double reach) const {
  std::vector<SweepContact> pairs;
  const Pose& at = poses_[moving.value];
  const RigidTransform world = transform_from_pose(at);
  const BoundingSphere sphere = store_.spheres().at(moving, at);
  const ScrewMotion rest = screw_motion(at, at, sphere.center, sphere.radius);
  if (solid(moving).tree.empty()) return pairs;
  near_.for_each(
      store_.spheres().swept(moving, world, world, rest.deviation), [&] { return reach; },
      [&](ComponentId fixed, double gap) {
        if (gap <= reach && fixed != moving && !solid(fixed).tree.empty())
          add_near_faces(moving, fixed, rest, reach, pairs);
      });
  sort_blocked(pairs);
  return pairs;
}

}  // namespace dismantle
