// SPDX-License-Identifier: Apache-2.0
#include "bench/discrete_fcl.h"

#include "bench/fcl_models.h"

#include <fcl/narrowphase/collision.h>
#include <algorithm>

namespace dismantle {

class DiscreteFcl::Body {
 public:
  std::vector<std::shared_ptr<FclModel>> models;  // assembled
};

DiscreteFcl::DiscreteFcl(const Assembly& assembly) : body_(std::make_unique<Body>()) {
  for (const Component& c : assembly.components) body_->models.push_back(make_fcl_model(assembled_mesh(c)));
}

DiscreteFcl::~DiscreteFcl() = default;

int DiscreteFcl::colliding_pairs(Span<const ComponentId> in_hand, Span<const Pose> poses) const {
  int pairs = 0;
  const fcl::CollisionRequestd request;
  for (const ComponentId hand : in_hand) {
    const fcl::Transform3d moving = make_fcl_transform(poses[hand.value]);
    for (std::uint32_t c = 0; c < poses.size(); ++c) {
      if (std::find(in_hand.begin(), in_hand.end(), ComponentId(c)) != in_hand.end()) continue;
      fcl::CollisionResultd result;
      fcl::collide(body_->models[hand.value].get(), moving, body_->models[c].get(), make_fcl_transform(poses[c]),
                   request, result);
      pairs += result.isCollision() ? 1 : 0;
    }
  }
  return pairs;
}

}  // namespace dismantle
