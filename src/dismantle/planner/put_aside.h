// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/plan.h"

#include <vector>

namespace dismantle {

/// How far each step of a plan goes along its exit [mm], in the order of the steps: as near as it can be, but outside
/// the assembled assembly's box, out of the way of every later step, and with room around it for what is taken out of
/// it. Proven by boxes around what moves.
std::vector<double> put_aside(const Assembly& assembly, const Plan& plan);

}  // namespace dismantle
