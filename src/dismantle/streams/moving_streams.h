// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/streams/matrix_stream.h"
#include "dismantle/surface/assembly_triangles.h"

namespace dismantle {

/// The streams that change from step to step, on the host: S_tm, S_v(n), S_v(n+1), S_bv and S_bvh. A step goes from the
/// current state to a candidate next one. Unchanged parts of a stream are not computed again; the results are the same
/// bits.
class MovingStreams {
 public:
  /// All components in the assembled state.
  MovingStreams(const Assembly& assembly, const Executor& executor);

  /// Grows the bounds of each leaf by a margin [mm], shape [leaf_count]. @pre all components are in the assembled state
  void set_margins(std::vector<float> margins, const Executor& executor);
  /// Sets the candidate: S_tm -> S_v(n+1), and the motion classes. @param next shape [component_count]
  void set_next(Span<const RigidTransform> next, const Executor& executor);
  /// Sets the current state and the candidate. @param state, next shape [component_count]
  void set_motion(Span<const RigidTransform> state, Span<const RigidTransform> next, const Executor& executor);
  /// Updates the bounds: S_v(n), S_v(n+1) -> S_bv, S_bvh.
  void refit(const Executor& executor);
  /// Makes the candidate the current state.
  void commit();
  /// Sets the current state and the candidate to `state`, shape [component_count], and updates the bounds.
  void jump(Span<const RigidTransform> state, const Executor& executor);

  /// The data that stays the same from step to step.
  const AssemblyTriangles& fixed() const { return fixed_; }
  /// The current state, shape [component_count].
  Span<const RigidTransform> state() const { return matrices_.start(); }
  /// The candidate, shape [component_count].
  Span<const RigidTransform> next() const { return matrices_.end(); }
  /// S_v(n) [mm, world].
  Span<const Vec3> vertices_t0() const { return vertices_t0_; }
  /// S_v(n+1) [mm, world].
  Span<const Vec3> vertices_t1() const { return vertices_t1_; }
  /// S_bv and S_bvh: bounds of the step with their margins, shape [node_count] [mm, world].
  Span<const Kdop16> bounds() const { return bounds_; }
  /// See MatrixStream::motion_class().
  Span<const std::uint32_t> motion_class() const { return matrices_.motion_class(); }

 private:
  void transform(std::vector<Vec3>& vertices, Span<const RigidTransform> transforms,
                 const std::vector<ComponentId>& components, const Executor& executor) const;

  AssemblyTriangles fixed_;
  MatrixStream matrices_;
  std::vector<Vec3> vertices_t0_, vertices_t1_;
  std::vector<float> margins_;
  std::vector<Kdop16> bounds_;
};

}  // namespace dismantle
