// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/find_clashes.h"

#include "dismantle/surface/depth/common_volume.h"
#include "dismantle/surface/depth/solid_depth.h"
#include "dismantle/surface/surface_queries.h"
#include "dismantle/surface/vertex_regions.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

namespace dismantle {

namespace {

/// The largest difference of the bounds of a depth, as a part of the tolerance.
constexpr double kGapOfTolerance = 0.1;
/// Distances below this part of the tolerance are not found out to the last digit: where faces lie on each other up to
/// rounding, all of their triangles are about as near.
constexpr double kTouching = 0.01;

/// The shapes of components, each of which is there from the first of its pairs to the last.
class PairShapes {
 public:
  using Pairs = std::vector<std::pair<ComponentId, ComponentId>>;

  PairShapes(const Assembly& assembly, const Pairs& pairs) : assembly_(assembly), shapes_(assembly.components.size()) {
    for (const auto& [a, b] : pairs) {
      ++shapes_[a.value].pairs_left;
      ++shapes_[b.value].pairs_left;
    }
  }

  /// The shape of a component. @pre not all of its pairs are done
  const SolidShape& of(ComponentId c) {
    Built& built = shapes_[c.value];
    std::call_once(built.once, [&] { built.shape = SolidShape(assembly_[c]); });
    return built.shape;
  }
  /// Notes that a pair needs its shapes no longer.
  void end_pair(ComponentId a, ComponentId b) {
    for (const ComponentId c : {a, b})
      if (--shapes_[c.value].pairs_left == 0) shapes_[c.value].shape = SolidShape();
  }

 private:
  struct Built {
    std::once_flag once;
    SolidShape shape;
    std::atomic<std::size_t> pairs_left{0};
  };
  const Assembly& assembly_;
  std::vector<Built> shapes_;
};

/// The order in which few shapes are needed at a time where components are listed in the order of the product tree: a
/// pair comes with the later one of its components.
std::vector<std::size_t> by_later_component(const PairShapes::Pairs& pairs) {
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) {
    return std::pair(pairs[i].second, pairs[i].first) < std::pair(pairs[k].second, pairs[k].first);
  });
  return order;
}

/// Compares pairs of components.
class PairCheck {
 public:
  PairCheck(const AssemblySurface& surface, PairShapes& shapes, double tolerance, const ClashOptions& options)
      : surface_(surface),
        shapes_(shapes),
        tolerance_(tolerance),
        clearance_(options.clearance),
        volumes_(options.volumes) {
    depth_options_.gap = kGapOfTolerance * tolerance;
  }

  /// Nothing where the pair is apart.
  std::optional<Clash> check(ComponentId a, ComponentId b) const {
    Clash clash;
    clash.a = a;
    clash.b = b;
    const PlacedShape first{&shapes_.of(a), {}}, second{&shapes_.of(b), {}};
    if (first.shape->empty() || second.shape->empty()) return std::nullopt;
    const SolidDepth depth = solid_depth(first, second, depth_options_);
    clash.depth = depth.depth;
    clash.depth_attained = depth.attained;
    clash.depth_loose = depth.capped;
    clash.deepest_at = depth.deepest_at;
    // Where the search ended early, only what was found counts.
    if ((depth.capped ? depth.attained : depth.depth) > tolerance_) {
      clash.state = ClashState::Overlapping;
      if (!volumes_) return clash;
      const CommonVolume volume = common_volume(first, second);
      clash.volume = volume.volume;
      clash.volume_error = volume.standard_error;
      if (solid_contains(first, second, tolerance_, depth_options_))
        clash.contained = b;
      else if (solid_contains(second, first, tolerance_, depth_options_))
        clash.contained = a;
      return clash;
    }
    return apart(clash);
  }

 private:
  std::optional<Clash> apart(Clash clash) const {
    const double limit = std::max(clearance_, 2 * tolerance_);
    const SurfaceDistance nearest = nearest_of_surface(surface_, clash.a, clash.b, limit, kTouching * tolerance_);
    clash.distance = nearest.distance;
    if (clash.distance > tolerance_ && clash.distance >= clearance_) return std::nullopt;
    clash.state = clash.distance <= tolerance_ ? ClashState::Contact : ClashState::Near;
    if (clash.depth_attained == 0) clash.deepest_at = nearest.point;
    if (clash.distance > 0 && outside(clash.a, clash.b) && outside(clash.b, clash.a)) clash.depth = 0;
    return clash;
  }

  /// True if no part of a surface that does not meet the other one is inside that.
  bool outside(ComponentId inner, ComponentId outer) const {
    const WindingNumber& winding = shapes_.of(outer).winding();
    if (!winding.closed()) return false;
    const std::vector<std::uint32_t> vertices = shell_vertices(surface_.triangles, inner);
    return std::none_of(vertices.begin(), vertices.end(),
                        [&](std::uint32_t v) { return winding.inside(surface_.triangles.vertices[v]); });
  }

  const AssemblySurface& surface_;
  PairShapes& shapes_;
  double tolerance_, clearance_;
  bool volumes_;
  DepthOptions depth_options_;
};

/// Calls run(i) for each of `count` items in parallel and reports the progress. @return false if it was cancelled
template <class Run>
bool run_all(std::size_t count, std::string_view stage, const ClashOptions& options, const Run& run) {
  std::mutex mutex;
  std::size_t done = 0;
  std::atomic<bool> cancelled{!report_progress(options.progress, stage, 0)};
  options.executor.for_each_heavy(count, [&](std::size_t i) {
    if (cancelled) return;
    run(i);
    const std::lock_guard lock(mutex);
    const double fraction = static_cast<double>(++done) / static_cast<double>(count);
    if (!report_progress(options.progress, stage, fraction)) cancelled = true;
  });
  return !cancelled;
}

}  // namespace

Result<Clashes> find_clashes(const Assembly& assembly, const ClashOptions& options) {
  const Error cancelled{ErrorKind::Failed, "cancelled"};
  Clashes clashes;
  clashes.tolerance = options.tolerance > 0 ? options.tolerance : default_tolerance(assembly);
  if (!report_progress(options.progress, "building the hierarchy", 0)) return cancelled;
  // The bounds, which take most of the memory, are there once at a time: grown ones first.
  AssemblySurface surface;
  surface.triangles = make_assembly_triangles(assembly, options.executor);
  const double near = std::max(options.clearance, clashes.tolerance);
  const auto candidates = near_component_pairs(surface.triangles, near, options.executor);
  surface.bounds = bounds_at(surface.triangles, surface.triangles.vertices, 0, options.executor);

  PairShapes shapes(assembly, candidates);
  const PairCheck check(surface, shapes, clashes.tolerance, options);
  const std::vector<std::size_t> order = by_later_component(candidates);
  std::vector<std::optional<Clash>> found(candidates.size());
  if (!run_all(found.size(), "comparing components", options, [&](std::size_t i) {
        const auto [a, b] = candidates[order[i]];
        found[order[i]] = check.check(a, b);
        shapes.end_pair(a, b);
      }))
    return cancelled;
  for (const std::optional<Clash>& clash : found)
    if (clash) clashes.pairs.push_back(*clash);
  return clashes;
}

}  // namespace dismantle
