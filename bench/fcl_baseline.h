// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/span.h"

#include <memory>

namespace dismantle {

/// What users have today: the discrete test of two meshes as FCL has it (collide() over trees of OBBRSS boxes, first
/// contact only), of the set in hand against every other component.
class DiscreteFcl {
 public:
  explicit DiscreteFcl(const Assembly& assembly);
  ~DiscreteFcl();

  /// The pairs of a component in hand and one that is not which collide at these poses, one pose a component.
  int colliding_pairs(Span<const ComponentId> in_hand, Span<const Pose> poses) const;

 private:
  class Body;
  std::unique_ptr<Body> body_;
};

/// The two ways in which FCL tests moving meshes.
enum class FclSolver { Naive, ConservativeAdvancement };

/// What a continuous test says of one motion.
struct FirstTouch {
  bool free = true;
  double toi = 1;  ///< As a part of the motion; 1 where free.
};

/// FCL's continuous test of two meshes (continuousCollide() over trees of OBBRSS boxes, a screw motion, times to 1e-4):
/// one stands at the identity, the other goes from `start` to `end`. The naive one looks at ten poses, as is FCL's
/// default.
FirstTouch continuous_fcl(const TriangleMesh& fixed, const TriangleMesh& moving, const Pose& start, const Pose& end,
                          FclSolver solver);

}  // namespace dismantle
