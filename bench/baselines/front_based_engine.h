// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/streams/sweep_engine.h"

#include <memory>

namespace dismantle {

/// The components that a step refits and tests.
enum class FrontBasedWork {
  AllComponents,     ///< As the method is published: it is for deformable models, which move everywhere.
  MovingComponents,  ///< Only moving components are refit, and front nodes of components that do not move against each
                     ///< other are kept. Not published; shows the effect of knowing that components are rigid.
};

/// Makes the engine of front-based multi-core continuous collision detection on the CPU (Tang, Manocha, Tong, MCCD,
/// Graphical Models 2010): the baseline of figure 9 of Du et al. 2015, all components in the assembled state. Every
/// step moves the vertices, refits the hierarchy, sprouts the whole front in one part for each core (FrontParts), and
/// tests the triangle pairs in equal parts by the elementary cubic tests of the features that the triangles represent
/// (representative triangles, which leave no orphans within components), behind the non-penetration filter. The
/// hierarchy (16-DOPs, built by the surface area heuristic) is that of `streams`.
///
/// Pairs that the published method does not know are decided as `streams` does, so that results can be equal: pairs
/// that touch or overlap by the certified test, in one pass; free pairs by the discrete test and the time at which they
/// part.
///
/// Guarantee: free or not, and the remaining overlapping pairs, are those of `streams` with the same options; where
/// every pair is ordinary and the test is elementary, so are contacts and times, bit for bit.
std::unique_ptr<SweepEngine> make_front_based_engine(const Assembly& assembly, const PairStates& pairs,
                                                     const CollisionOptions& options,
                                                     FrontBasedWork work = FrontBasedWork::AllComponents);

}  // namespace dismantle
