// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/moving_streams.h"

#include "dismantle/streams/vertex_kernel.h"

#include <algorithm>
#include <utility>

namespace dismantle {

namespace {

/// Vertices in one task: a vertex takes 2 to 3 ns.
constexpr std::uint32_t kVerticesPerRange = 8192;

}  // namespace

MovingStreams::MovingStreams(const Assembly& assembly, const Executor& executor)
    : fixed_(make_assembly_triangles(assembly, executor)),
      matrices_(fixed_.component_count()),
      vertices_t0_(fixed_.vertices),
      vertices_t1_(fixed_.vertices),
      bounds_(bounds_at(fixed_, fixed_.vertices, 0, executor)) {}

void MovingStreams::transform(std::vector<Vec3>& vertices, Span<const RigidTransform> transforms,
                              const std::vector<ComponentId>& components, const Executor& executor) const {
  struct Range {
    std::uint32_t component, begin, end;
  };
  std::vector<Range> ranges;
  for (const ComponentId c : components) {
    const std::uint32_t end = fixed_.vertex_begin[c.value + 1];
    for (std::uint32_t begin = fixed_.vertex_begin[c.value]; begin < end; begin += kVerticesPerRange)
      ranges.push_back({c.value, begin, std::min(end, begin + kVerticesPerRange)});
  }
  executor.for_each_heavy(ranges.size(), [&](std::size_t i) {
    const Range& range = ranges[i];
    const std::uint32_t count = range.end - range.begin;
    const VertexUpdateKernel kernel{transforms[range.component],
                                    Span<const Vec3>(fixed_.vertices).subspan(range.begin, count),
                                    Span<Vec3>(vertices).subspan(range.begin, count)};
    for (std::uint32_t v = 0; v < count; ++v) kernel(v);
  });
}

void MovingStreams::set_margins(std::vector<float> margins, const Executor& executor) {
  margins_ = std::move(margins);
  bounds_ = bvh_fit(fixed_.bvh, fixed_.refit_plan, {vertices_t0_, vertices_t0_, fixed_.faces, 0, margins_}, executor);
}

void MovingStreams::set_next(Span<const RigidTransform> next, const Executor& executor) {
  const std::vector<ComponentId> changed = matrices_.set_next(next);
  transform(vertices_t1_, matrices_.end(), changed, executor);
}

void MovingStreams::set_motion(Span<const RigidTransform> state, Span<const RigidTransform> next,
                               const Executor& executor) {
  const std::vector<ComponentId> changed = matrices_.set_start(state);
  transform(vertices_t0_, matrices_.start(), changed, executor);
  set_next(next, executor);
}

void MovingStreams::refit(const Executor& executor) {
  std::vector<ComponentId> stationary, moving;
  for (const ComponentId c : matrices_.take_outdated_bounds())
    (motion_class()[c.value] == 0 ? stationary : moving).push_back(c);
  if (!stationary.empty())
    bvh_refit(fixed_.bvh, fixed_.refit_plan, {vertices_t0_, vertices_t0_, fixed_.faces, 0, margins_}, stationary,
              bounds_, executor);
  if (!moving.empty())
    bvh_refit(fixed_.bvh, fixed_.refit_plan, {vertices_t0_, vertices_t1_, fixed_.faces, 0, margins_}, moving, bounds_,
              executor);
}

void MovingStreams::commit() {
  matrices_.commit();
  std::swap(vertices_t0_, vertices_t1_);
}

void MovingStreams::jump(Span<const RigidTransform> state, const Executor& executor) {
  set_motion(state, state, executor);
  refit(executor);
}

}  // namespace dismantle
