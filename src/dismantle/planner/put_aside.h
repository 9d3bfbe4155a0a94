// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/plan.h"

#include <vector>

namespace dismantle {

/// Distance that each step of a plan moves along its exit [mm], in the order of the steps: the smallest that is outside
/// the bounding box of the assembly, clear of every later step, and leaves room to take the removed body apart.
/// Established with bounding boxes of everything that moves.
std::vector<double> put_aside(const Assembly& assembly, const Plan& plan);

}  // namespace dismantle
