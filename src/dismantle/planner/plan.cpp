// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/plan.h"

namespace dismantle {

std::string_view name_of(PlanTier tier) {
  switch (tier) {
    case PlanTier::Straight:
      return "straight";
    case PlanTier::Helical:
      return "helical";
    case PlanTier::Sliding:
      return "sliding";
    case PlanTier::Sampled:
      return "sampled";
    case PlanTier::StraightTogether:
      return "straight together";
  }
  return "";
}

}  // namespace dismantle
