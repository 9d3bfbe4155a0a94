// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/span.h"

#include <memory>

namespace dismantle {

/// FCL's discrete collision test of meshes (collide() over trees of OBBRSS boxes, first contact only): the moving set
/// against every other component.
class DiscreteFcl {
 public:
  explicit DiscreteFcl(const Assembly& assembly);
  ~DiscreteFcl();

  /// The number of pairs of a moving and another component that collide. @param poses one a component
  int colliding_pairs(Span<const ComponentId> moving_set, Span<const Pose> poses) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// FCL's two algorithms for moving meshes.
enum class FclSolver { Naive, ConservativeAdvancement };

/// Result of a continuous test of one motion.
struct FclMotionResult {
  bool free = true;
  double toi = 1;  ///< Time of impact in [0, 1]; 1 where free.
};

/// FCL's continuous test of two meshes (continuousCollide() over trees of OBBRSS boxes, screw motion, times to 1e-4):
/// one stands at the identity, the other goes from `start` to `end`. Naive tests ten poses, FCL's default.
FclMotionResult continuous_fcl(const TriangleMesh& fixed, const TriangleMesh& moving, const Pose& start,
                               const Pose& end, FclSolver solver);

}  // namespace dismantle
