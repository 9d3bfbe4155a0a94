// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"
#include "dismantle/core/span.h"
#include "dismantle/math/rigid_transform.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// S_tm: the transforms of the current state and of a candidate next one, the relative motions between them, and which
/// of the streams derived from them are outdated. Contains no vertices: those may be on the host or on a device.
class MatrixStream {
 public:
  /// All components in the assembled state, and all derived streams valid for it.
  explicit MatrixStream(std::size_t component_count);

  /// Sets the candidate, one transform a component.
  /// @return the components whose vertices S_v(n+1) are outdated
  std::vector<ComponentId> set_next(Span<const RigidTransform> next);
  /// Sets the current state, one transform a component. @return the components whose vertices S_v(n) are outdated
  std::vector<ComponentId> set_start(Span<const RigidTransform> state);
  /// The components whose bounds were computed from other transforms than the present ones. They count as updated from
  /// then on.
  std::vector<ComponentId> take_outdated_bounds();
  /// Swaps the candidate and the current state, and with them S_v(n) and S_v(n+1).
  void commit();

  /// Number of components.
  std::size_t component_count() const { return start_.size(); }
  /// The current state, shape [component_count].
  Span<const RigidTransform> start() const { return start_; }
  /// The candidate, shape [component_count].
  Span<const RigidTransform> end() const { return end_; }
  /// Shape [component_count]: 0 for stationary components, else a number shared by components that move as one (equal
  /// transforms in both states).
  Span<const std::uint32_t> motion_class() const { return motion_class_; }

 private:
  void classify_motion();

  std::vector<RigidTransform> start_, end_;
  std::vector<RigidTransform> fitted_start_, fitted_end_;  // of each component's bounds
  std::vector<std::uint32_t> motion_class_;
};

}  // namespace dismantle
