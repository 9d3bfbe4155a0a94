// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/collision/triangle_streams.h"

namespace dismantle {

/// The streams that change from step to step: S_tm, S_v(n), S_v(n+1), S_bv and S_bvh. A step goes from the current
/// state to a candidate next one. What has not changed since the last step is not computed again; the results are the
/// same bits.
class MovingStreams {
 public:
  /// All components in the assembled state.
  MovingStreams(const Assembly& assembly, const Executor& executor);

  /// S_tm -> S_v(n+1), and which components move how. @param next shape [component_count]
  void set_next(Span<const RigidTransform> next, const Executor& executor);
  /// S_v(n), S_v(n+1) -> S_bv, S_bvh.
  void refit(const Executor& executor);
  /// The candidate becomes the current state.
  void commit();
  /// Puts the current state and the candidate at `state`; the bounds are those of that moment.
  void jump(Span<const RigidTransform> state, const Executor& executor);

  const TriangleStreams& fixed() const { return fixed_; }
  Span<const RigidTransform> state() const { return start_.transforms; }
  Span<const Vec3> vertices_t0() const { return start_.vertices; }
  Span<const Vec3> vertices_t1() const { return end_.vertices; }
  Span<const Kdop16> bounds() const { return bounds_; }
  /// Of each component: 0 where it stands still, else a number that components share which move as one: from equal
  /// states to equal states.
  Span<const std::uint32_t> motion_class() const { return motion_class_; }

 private:
  /// A vertex stream and the transforms that made it.
  struct VertexStream {
    std::vector<Vec3> vertices;
    std::vector<RigidTransform> transforms;
  };
  void bring(VertexStream& stream, Span<const RigidTransform> transforms, const Executor& executor) const;
  void classify_motion();

  TriangleStreams fixed_;
  VertexStream start_, end_;
  std::vector<std::uint32_t> motion_class_;
  std::vector<Kdop16> bounds_;
  std::vector<RigidTransform> fitted_start_, fitted_end_;  // that each component's bounds were made from
};

}  // namespace dismantle
