// SPDX-License-Identifier: Apache-2.0
#include "dismantle/collision/moving_streams.h"

#include "dismantle/collision/vertex_kernel.h"

#include <algorithm>
#include <array>
#include <map>

namespace dismantle {

namespace {

constexpr std::uint32_t kVerticesPerRange = 8192;  // a vertex costs 2-3 ns: less than this is not worth a task

/// The numbers of a component's motion, to compare motions by.
using MotionKey = std::array<double, 24>;

MotionKey motion_key(const RigidTransform& start, const RigidTransform& end) {
  MotionKey key;
  auto place = key.begin();
  for (const RigidTransform* t : {&start, &end}) {
    for (const Vec3& v : {t->rotation.row[0], t->rotation.row[1], t->rotation.row[2], t->translation})
      for (int k = 0; k < 3; ++k) *place++ = v[k];
  }
  return key;
}

}  // namespace

MovingStreams::MovingStreams(const Assembly& assembly, const Executor& executor)
    : fixed_(make_triangle_streams(assembly, executor)) {
  const std::vector<RigidTransform> assembled(fixed_.component_count());
  start_ = {fixed_.vertices, assembled};
  end_ = start_;
  motion_class_.assign(fixed_.component_count(), 0);
  bounds_ = bounds_at(fixed_, fixed_.vertices, 0, executor);
  fitted_start_ = fitted_end_ = assembled;
}

void MovingStreams::bring(VertexStream& stream, Span<const RigidTransform> transforms, const Executor& executor) const {
  DISMANTLE_EXPECT(transforms.size() == fixed_.component_count());
  struct Range {
    std::uint32_t component, begin, end;
  };
  std::vector<Range> ranges;
  for (std::uint32_t c = 0; c < transforms.size(); ++c) {
    if (stream.transforms[c] == transforms[c]) continue;
    stream.transforms[c] = transforms[c];
    const std::uint32_t end = fixed_.vertex_begin[c + 1];
    for (std::uint32_t begin = fixed_.vertex_begin[c]; begin < end; begin += kVerticesPerRange)
      ranges.push_back({c, begin, std::min(end, begin + kVerticesPerRange)});
  }
  executor.for_each_heavy(ranges.size(), [&](std::size_t i) {
    const Range& range = ranges[i];
    const std::uint32_t count = range.end - range.begin;
    const VertexUpdateKernel kernel{stream.transforms[range.component],
                                    Span<const Vec3>(fixed_.vertices).subspan(range.begin, count),
                                    Span<Vec3>(stream.vertices).subspan(range.begin, count)};
    for (std::uint32_t v = 0; v < count; ++v) kernel(v);
  });
}

void MovingStreams::set_next(Span<const RigidTransform> next, const Executor& executor) {
  bring(end_, next, executor);
  classify_motion();
}

void MovingStreams::classify_motion() {
  std::map<MotionKey, std::uint32_t> classes;
  for (std::size_t c = 0; c < motion_class_.size(); ++c) {
    motion_class_[c] = 0;
    if (start_.transforms[c] == end_.transforms[c]) continue;
    const auto next_class = static_cast<std::uint32_t>(classes.size() + 1);
    motion_class_[c] =
        classes.try_emplace(motion_key(start_.transforms[c], end_.transforms[c]), next_class).first->second;
  }
}

void MovingStreams::refit(const Executor& executor) {
  std::vector<ComponentId> still, moving;
  for (std::uint32_t c = 0; c < motion_class_.size(); ++c) {
    if (fitted_start_[c] == start_.transforms[c] && fitted_end_[c] == end_.transforms[c]) continue;
    fitted_start_[c] = start_.transforms[c];
    fitted_end_[c] = end_.transforms[c];
    (motion_class_[c] == 0 ? still : moving).push_back(ComponentId(c));
  }
  if (!still.empty())
    bvh_refit(fixed_.bvh, fixed_.refit_plan, {start_.vertices, start_.vertices, fixed_.faces, 0}, still, bounds_,
              executor);
  if (!moving.empty())
    bvh_refit(fixed_.bvh, fixed_.refit_plan, {start_.vertices, end_.vertices, fixed_.faces, 0}, moving, bounds_,
              executor);
}

void MovingStreams::commit() {
  std::swap(start_, end_);
}

void MovingStreams::jump(Span<const RigidTransform> state, const Executor& executor) {
  bring(start_, state, executor);
  set_next(state, executor);
  refit(executor);
}

}  // namespace dismantle
