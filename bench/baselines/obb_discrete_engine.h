// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/engine/motion_engine.h"

#include <memory>

namespace dismantle {

/// The geometry of a component in the discrete test.
enum class ObbDetail {
  Boxes,      ///< One oriented box around the whole component: holes and corners are filled.
  Triangles,  ///< A tree of oriented boxes down to the triangles (Gottschalk, Lin, Manocha 1996), tested exactly.
};

/// Makes the engine of collision detection at discrete steps, as in virtual disassembly systems before Du et al. 2015
/// (section 3.1 there): the moving set goes to a target where nothing intersects it *there*; the path to it is not
/// tested. Pairs that are in contact or overlap in the assembled state are ignored, since otherwise nothing could be
/// taken apart. Response: Stop. All components in the assembled state; the assembly must outlive the engine.
std::unique_ptr<MotionEngine> make_obb_discrete_engine(const Assembly& assembly, const PairStates& pairs,
                                                       ObbDetail detail);

}  // namespace dismantle
