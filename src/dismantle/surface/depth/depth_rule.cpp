// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/depth_rule.h"

namespace dismantle {

DepthRule DepthRule::of(const SolidShape& solid, double limit, double far_limit, const SolidShape* hole) {
  const bool is_less = far_limit < limit && !solid.thin_places(limit).none();
  DepthRule rule{limit, is_less ? far_limit : limit};
  rule.region = &solid.far_region(limit, rule.far_limit);
  if (!is_less) return rule;
  rule.thin = &solid.thin_places(limit);
  rule.hole = hole;
  if (!rule.thin->everywhere()) rule.wider_region = &solid.shallow_region(limit);
  return rule;
}

}  // namespace dismantle
