// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/collision/motion_engine.h"

#include <memory>

namespace dismantle {

/// What stands for a component in the discrete test.
enum class ObbDetail {
  Boxes,      ///< One oriented box around the whole component: holes and corners are filled.
  Triangles,  ///< A tree of oriented boxes down to the triangles (Gottschalk, Lin, Manocha 1996), tested exactly.
};

/// Collision detection at discrete steps as virtual disassembly systems before Du et al. 2015 had it (section 3.1
/// there): the set in hand goes to a target where nothing intersects it *there*; what is on the way is not looked at.
/// Pairs that are in contact or in each other when assembled are left out, or nothing could be taken apart. Response:
/// Stop. All components in the assembled state; the assembly must outlive the engine.
std::unique_ptr<MotionEngine> make_obb_discrete_engine(const Assembly& assembly, const PairStates& pairs,
                                                       ObbDetail detail);

}  // namespace dismantle
