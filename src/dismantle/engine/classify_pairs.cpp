// SPDX-License-Identifier: Apache-2.0
#include "dismantle/engine/classify_pairs.h"

#include "dismantle/surface/surface_queries.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>

namespace dismantle {

namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// The thresholds of one pair [mm].
struct Limits {
  double tolerance = 0;
  double near = 0;  ///< Pairs further apart are Clear.
  double fit = 0;   ///< Pairs that overlap by more are Embedded.
};

ComponentPair apart(ComponentPair pair, double distance, const Limits& limits) {
  pair.distance = distance;
  pair.allowed_penetration = limits.tolerance;
  pair.state = distance <= limits.tolerance ? PairState::Contact
               : distance < limits.near     ? PairState::Near
                                            : PairState::Clear;
  return pair;
}

ComponentPair embedded(ComponentPair pair) {
  pair.state = PairState::Embedded;
  pair.allowed_penetration = kUnlimited;
  return pair;
}

/// The depth of the deepest vertex of either component inside the other one, where that is closed.
double deepest_vertex(const Assembly& assembly, const AssemblySurface& s, const ComponentPair& pair,
                      const SurfaceOverlap& overlap) {
  double deepest = 0;
  if (assembly[pair.b].faults.closed())
    deepest = std::max(deepest, deepest_vertex(s, pair.a, pair.b, overlap.leaves[0]));
  if (assembly[pair.a].faults.closed())
    deepest = std::max(deepest, deepest_vertex(s, pair.b, pair.a, overlap.leaves[1]));
  return deepest;
}

ComponentPair classify(const Assembly& assembly, const AssemblySurface& s, ComponentPair pair, ClassifyRule rule,
                       const Limits& limits) {
  const SurfaceOverlap overlap = surface_overlap(s, pair.a, pair.b);
  pair.triangle_pairs = overlap.triangle_pairs;
  pair.penetration = overlap.penetration;
  if (overlap.triangle_pairs == 0) {
    if (deepest_vertex(assembly, s, pair, overlap) > limits.tolerance) return embedded(pair);
    return apart(pair, surface_distance(s, pair.a, pair.b, std::max(limits.near, 2 * limits.tolerance)), limits);
  }
  if (rule == ClassifyRule::Paper || overlap.penetration > limits.fit) return embedded(pair);
  // The audit accepts vertices that are twice as deep as triangles.
  const double depth = std::max(overlap.penetration, deepest_vertex(assembly, s, pair, overlap) / 2);
  if (depth > limits.fit && depth > limits.tolerance) return embedded(pair);
  pair.state = depth > limits.tolerance ? PairState::Fit : PairState::Contact;
  pair.allowed_penetration = pair.state == PairState::Fit ? depth + limits.tolerance : limits.tolerance;
  return pair;
}

}  // namespace

Result<PairStates> classify_pairs(const Assembly& assembly, const ClassifyOptions& options) {
  PairStates states;
  states.tolerance = options.tolerance > 0 ? options.tolerance : default_tolerance(assembly);
  if (!report_progress(options.progress, "building the hierarchy", 0)) return Error{ErrorKind::Failed, "cancelled"};
  const AssemblySurface surface = make_assembly_surface(assembly, options.executor);
  const double near = std::max(options.clearance, states.tolerance);
  const auto candidates = near_component_pairs(surface, near, options.executor);

  std::vector<double> size(assembly.components.size());
  for (std::size_t c = 0; c < size.size(); ++c) size[c] = diagonal(assembled_bounds(assembly.components[c]));

  std::vector<ComponentPair> found(candidates.size());
  std::mutex progress_mutex;
  std::size_t done = 0;
  std::atomic<bool> cancelled{false};
  options.executor.for_each_heavy(candidates.size(), [&](std::size_t i) {
    if (cancelled) return;
    const auto [a, b] = candidates[i];
    const double relative = kDefaultRelativeFit * std::min(size[a.value], size[b.value]);
    const Limits limits{states.tolerance, options.clearance, options.fit > 0 ? options.fit : relative};
    ComponentPair pair;
    pair.a = a;
    pair.b = b;
    found[i] = classify(assembly, surface, pair, options.rule, limits);
    const std::lock_guard lock(progress_mutex);
    const double fraction = static_cast<double>(++done) / static_cast<double>(candidates.size());
    if (!report_progress(options.progress, "comparing components", fraction)) cancelled = true;
  });
  if (cancelled) return Error{ErrorKind::Failed, "cancelled"};
  std::copy_if(found.begin(), found.end(), std::back_inserter(states.pairs),
               [](const ComponentPair& p) { return p.state != PairState::Clear; });
  return states;
}

}  // namespace dismantle
