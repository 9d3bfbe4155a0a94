// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"
#include "dismantle/core/span.h"
#include "dismantle/math/rigid_transform.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// S_tm: the transforms of the current state and of a candidate next one, who moves how between them, and which of the
/// streams that are made of them no longer fit. Holds no vertices: those may be on the host or on a device.
class MatrixStream {
 public:
  /// All components in the assembled state, and all streams made of that.
  explicit MatrixStream(std::size_t component_count);

  /// A candidate, one transform a component.
  /// @return the components whose vertices S_v(n+1) must be made anew
  std::vector<ComponentId> set_next(Span<const RigidTransform> next);
  /// Another current state. @return the components whose vertices S_v(n) must be made anew
  std::vector<ComponentId> set_start(Span<const RigidTransform> state);
  /// The components whose bounds were made of other transforms than the present ones. From now on they count as made
  /// of these.
  std::vector<ComponentId> take_unfitted();
  /// The candidate becomes the current state, and the other way round: S_v(n) and S_v(n+1) change places.
  void commit();

  std::size_t component_count() const { return start_.size(); }
  Span<const RigidTransform> start() const { return start_; }
  Span<const RigidTransform> end() const { return end_; }
  /// Of each component: 0 where it stands still, else a number that components share which move as one: from equal
  /// states to equal states.
  Span<const std::uint32_t> motion_class() const { return motion_class_; }

 private:
  void classify_motion();

  std::vector<RigidTransform> start_, end_;
  std::vector<RigidTransform> fitted_start_, fitted_end_;  // that each component's bounds were made from
  std::vector<std::uint32_t> motion_class_;
};

}  // namespace dismantle
