// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/streams/matrix_stream.h"
#include "dismantle/surface/assembly_triangles.h"

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
  /// As set_next, from another current state.
  void set_motion(Span<const RigidTransform> state, Span<const RigidTransform> next, const Executor& executor);
  /// S_v(n), S_v(n+1) -> S_bv, S_bvh.
  void refit(const Executor& executor);
  /// The candidate becomes the current state.
  void commit();
  /// Puts the current state and the candidate at `state`; the bounds are those of that moment.
  void jump(Span<const RigidTransform> state, const Executor& executor);

  const AssemblyTriangles& fixed() const { return fixed_; }
  Span<const RigidTransform> state() const { return matrices_.start(); }
  Span<const Vec3> vertices_t0() const { return vertices_t0_; }
  Span<const Vec3> vertices_t1() const { return vertices_t1_; }
  Span<const Kdop16> bounds() const { return bounds_; }
  /// As MatrixStream has it.
  Span<const std::uint32_t> motion_class() const { return matrices_.motion_class(); }

 private:
  void bring(std::vector<Vec3>& vertices, Span<const RigidTransform> transforms,
             const std::vector<ComponentId>& components, const Executor& executor) const;

  AssemblyTriangles fixed_;
  MatrixStream matrices_;
  std::vector<Vec3> vertices_t0_, vertices_t1_;
  std::vector<Kdop16> bounds_;
};

}  // namespace dismantle
