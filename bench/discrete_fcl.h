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

}  // namespace dismantle
