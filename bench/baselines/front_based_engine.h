// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/collision/collision_engine.h"

#include <memory>

namespace dismantle {

/// What a step looks at.
enum class FrontBasedWork {
  Everything,  ///< Whatever moves or not: the method is for deformable models, where nothing stands still.
  WhatMoves,   ///< Only what moves is refit, and nodes of components that do not move against each other are kept as
               ///< they are: how the method could be told that components are rigid. To see what that alone is worth.
};

/// Front-based multi-core continuous collision detection on the CPU (Tang, Manocha, Tong, MCCD, Graphical Models 2010):
/// the baseline of figure 9 of Du et al. 2015, all components in the assembled state. Every step moves the vertices,
/// refits the hierarchy, sprouts the whole front in one part a core (FrontParts), and tests the triangle pairs in
/// equal parts by the elementary cubic tests of the features that the triangles stand for (representative triangles,
/// which leave no orphans within components), behind the non-penetration filter. The hierarchy (16-DOPs, built by the
/// surface area heuristic) is that of `streams`.
///
/// What that method does not know, it decides as `streams` does, so that results can be equal: pairs in contact or fit
/// by the certified test, in one pass; embedded pairs by the discrete test and the time at which they part.
///
/// Guarantee: free or not, and the embedded pairs that are left, are those of `streams` with the same options; where
/// every pair is ordinary and the test is elementary, so are contacts and times, bit for bit.
std::unique_ptr<CollisionEngine> make_front_based_engine(const Assembly& assembly, const PairStates& pairs,
                                                         const CollisionOptions& options,
                                                         FrontBasedWork work = FrontBasedWork::Everything);

}  // namespace dismantle
